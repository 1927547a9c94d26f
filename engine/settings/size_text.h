// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes of edges from text and back, and how users ask for materials by ranges of a value.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/settings/settings.h"
#include "io/mesh/grouped/material_sets.h"

namespace mw::engine {

/// Returns whether a part of such a text names an image of sizes, by its ending.
[[nodiscard]] bool names_image(std::string_view part);

/// A size and its unit.
struct SizeText {
  double edge = 0.0;
  bool in_voxels = false;
};

/// Parses "2.5", in physical units, or "2.5vox", in voxels.
/// ERRORS: mw::Error(kUsage) unless it is positive and finite.
[[nodiscard]] SizeText parse_size(std::string_view text);

/// Parses "7=4,3|5=1,*=2.5": sizes of a label, of the faces between two, and of all other labels;
/// "2.5" is "*=2.5", "3|*" are the faces between 3 and any label, and "*|*" are all faces. "@FILE",
/// alone or between those, is a table of such sizes, or an image.  An empty text gives no sizes.
/// ENSURES: labels and pairs are ascending.
/// ERRORS: mw::Error(kUsage) saying what was expected, for what has two sizes, and where some sizes
///         are in voxels and others are not; those of reading the file, and of parse_size_table().
[[nodiscard]] SizeRules parse_sizes(std::string_view text);

/// Returns the tables that the text names.
[[nodiscard]] std::vector<std::string> size_tables(std::string_view text);

/// Parses lines "label,size" of a table (CsvRecords), with a comma, a semicolon or a tab between
/// the two, where a label is what stands before "=" in the text above; the first line may be a
/// header.
/// ERRORS: mw::Error(kInput) naming file and line.
[[nodiscard]] SizeRules parse_size_table(std::string_view text, std::string_view file);

/// Returns what parse_sizes() reads back as the same, without any table.
[[nodiscard]] std::string format_sizes(const SizeRules& rules);

/// Parses "NAME=N" or "NAME=N:LO:HI".  ERRORS: mw::Error(kUsage) for another form, for fewer than 1
/// or more than io::kMostMaterials materials, and unless LO is below HI.
[[nodiscard]] io::MaterialRule parse_materials(std::string_view text);

}  // namespace mw::engine
