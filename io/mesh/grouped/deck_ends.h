// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The two ends at which the job of a deck holds a mesh and pulls it.
#pragma once

#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// The sides z_min and z_max of the box, where the mesh reaches both; else what lies in the lowest
/// and in the highest twentieth of the mesh along the box's z.
class DeckEnds {
 public:
  /// Cost: a pass over the nodes.
  explicit DeckEnds(GroupedMesh& mesh);

  [[nodiscard]] bool are_sides() const { return are_sides_; }
  /// REQUIRES (both): !are_sides().
  [[nodiscard]] bool is_low(const Position& node) const { return along(node) <= low_; }
  [[nodiscard]] bool is_high(const Position& node) const { return along(node) >= high_; }
  /// How far the upper end is pulled: 1 % of the mesh's height along the box's z, in that
  /// direction.
  [[nodiscard]] const Position& shift() const { return shift_; }

 private:
  [[nodiscard]] double along(const Position& node) const;

  Position direction_{};  ///< a unit vector
  bool are_sides_ = false;
  double low_ = 0;
  double high_ = 0;
  Position shift_{};
};

}  // namespace mw::io
