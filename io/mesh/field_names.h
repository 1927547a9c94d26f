// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Arrays of mesh files that are about labels: the labels of cells, and names as three arrays of
// field data, which VTK and ParaView show; names of values.
#pragma once

#include <string>
#include <vector>

#include "io/mesh/mesh_data.h"
#include "io/names/label_names.h"

namespace mw::io {

/// The labels, among the names of integer cell arrays: `label`, else `Label`, `labels`, `material`
/// or `medit:ref`, else the only one, else null.
[[nodiscard]] const std::string* choose_label(const std::vector<std::string>& names);

inline constexpr const char* kLabelId = "label_id";  ///< as the cell array of labels
inline constexpr const char* kLabelName =
    "label_name";  ///< strings, or bytes with a NUL behind each
inline constexpr const char* kLabelColour = "label_colour";  ///< 4 x u8

/// Cells between the two sides of an interface: the number of the interface, 0 of tets; and by
/// interface the labels on its two sides.
inline constexpr const char* kCohesive = "cohesive";
inline constexpr const char* kCohesiveLabels = "cohesive_labels";

/// The arrays of a file, one row a label.
struct FieldNames {
  std::vector<std::uint64_t> ids;
  std::vector<std::string> names;
  std::vector<std::uint64_t> colours;  ///< four a label, 0 0 0 0 where unknown; or empty
};

[[nodiscard]] inline Colour field_colour(const LabelName& row) {
  return row.colour.value_or(Colour{});
}

/// ERRORS: mw::Error(kInput) naming the file when the arrays are not of the same length.
[[nodiscard]] LabelNames names_of(const FieldNames& fields, std::string_view file);

/// The most columns of values that are read of a mesh; the first ones in its file are.
inline constexpr std::size_t kMostValues = 64;

/// Names for MeshHeader::values from those of a file's arrays: a letter and up to 30 letters,
/// digits and '_', with '_' for all else ("Stress XX" is "Stress_XX").
/// ENSURES: no two are the same in small letters, and none is "label": those that would be get _2,
/// _3 and so on.  Names that are such already stay.
[[nodiscard]] std::vector<std::string> value_names(const std::vector<std::string>& arrays);

/// Gives the values such names.
void name_values(std::vector<TetValues>& values);

}  // namespace mw::io
