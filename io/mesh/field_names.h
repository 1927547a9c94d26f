// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Arrays of mesh files: the labels of cells, the names of labels as three arrays of field data,
// which VTK and ParaView show, and the names of values.
#pragma once

#include <string>
#include <vector>

#include "io/mesh/mesh_data.h"
#include "io/names/label_names.h"

namespace mw::io {

/// Returns which of these integer cell arrays holds the labels: `label`, else `Label`, `labels`,
/// `material` or `medit:ref`, else the only array; null where there is none of these.
[[nodiscard]] const std::string* choose_label(const std::vector<std::string>& names);

inline constexpr const char* kLabelId = "label_id";  ///< labels, of the type of the cell array
inline constexpr const char* kLabelName =
    "label_name";  ///< strings, or bytes with a NUL behind each
inline constexpr const char* kLabelColour = "label_colour";  ///< 4 x u8

/// The cell array with the number of its interface for each wedge, and 0 for tets, and the field
/// array with the labels on the two sides of each interface.
inline constexpr const char* kCohesive = "cohesive";
inline constexpr const char* kCohesiveLabels = "cohesive_labels";

/// The arrays of names in a file, with one row for each label.
struct FieldNames {
  std::vector<std::uint64_t> ids;
  std::vector<std::string> names;
  std::vector<std::uint64_t> colours;  ///< four a label, 0 0 0 0 where unknown; may be empty
};

[[nodiscard]] inline Colour field_colour(const LabelName& row) {
  return row.colour.value_or(Colour{});
}

/// ERRORS: mw::Error(kInput) naming the file when the arrays are not of the same length.
[[nodiscard]] LabelNames names_of(const FieldNames& fields, std::string_view file);

/// The most columns of values that are read from a mesh, the first ones of its file.
inline constexpr std::size_t kMostValues = 64;

/// Returns names for MeshHeader::values from those of a file's arrays: a letter and up to 30
/// letters, digits and '_', with '_' for all else ("Stress XX" becomes "Stress_XX").
/// ENSURES: no two are the same in small letters, and none is "label": those that would be get _2,
/// _3 and so on.  Names that keep these rules stay as they are.
[[nodiscard]] std::vector<std::string> value_names(const std::vector<std::string>& arrays);

/// Gives the values such names.
void name_values(std::vector<TetValues>& values);

}  // namespace mw::io
