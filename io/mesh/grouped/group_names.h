// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What groups of tets and facets are called in files that know names.
#pragma once

#include <string>
#include <vector>

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

}  // namespace mw::io
