// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What groups of tets and facets are called in files that know names, and their numbers in the
// others.
#pragma once

#include <string>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// "x_min", "x_max" and so on; "outer"; "interface".
[[nodiscard]] const char* side_name(Side side);

/// "7", or "-7" of a signed label.
[[nodiscard]] std::string label_digits(const LabelTable& table, Label rank);

/// Names for people: those of labels.
class GroupNames {
 public:
  explicit GroupNames(const GroupedMesh& mesh);

  /// The label's name; "label_7" where it has none, "name (7)" where another has the same.
  [[nodiscard]] const std::string& volume(Label rank) const { return volumes_[rank]; }
  /// Of an interface the names of both, lower label first, as "liver|kidney"; of others the side.
  /// So all groups of one side have the same name, whatever their label.
  [[nodiscard]] std::string facets(const FacetGroup& group) const;

 private:
  std::vector<std::string> volumes_;
};

/// Names for programs that allow letters, digits and '_' alone: "LABEL_7", "FACE_1_2", "X_MIN",
/// "OUTER".  A negative label is "M7".
[[nodiscard]] std::string plain_volume_name(const LabelTable& table, Label rank);
[[nodiscard]] std::string plain_facet_name(const LabelTable& table, const FacetGroup& group);

/// A run of facets under one number.
struct NumberedFacets {
  std::int64_t number = 0;
  std::string name;  ///< see GroupNames::facets
  Side side = Side::kInterface;
  Label first = kExterior;  ///< of an interface its labels, by rank; else kExterior
  Label second = kExterior;
  RowRange facets;
};

/// Sides of the box have the numbers 1 to 6 (x_min, x_max, y_min, y_max, z_min, z_max), the outer
/// surface has 7, whatever the mesh; all labels share them.  Interfaces have 8 and more, ascending
/// by their two labels.
/// ENSURES: in the order of the facets, which all are in one run.
[[nodiscard]] std::vector<NumberedFacets> number_facets(const GroupedMesh& mesh);

/// The table beside a mesh: M.facets.csv of M.xdmf.
[[nodiscard]] std::filesystem::path facet_table_path(const std::filesystem::path& mesh);

/// Its content: columns number, name, side, first, second; the last two are the labels of an
/// interface and else empty.  The file is to be committed with the mesh (commit_together.h).
/// ERRORS: see AtomicFile.
void append_facet_table(AtomicFile& file, const LabelTable& table,
                        const std::vector<NumberedFacets>& facets);

}  // namespace mw::io
