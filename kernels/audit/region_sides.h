// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The boundary triangles of all labels of a mesh.
#pragma once

#include "kernels/audit/mesh_stars.h"

namespace mw::audit {

/// A triangle of a label's boundary: one tet of the label on it.
struct RegionSide {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t tet = 0;
};

/// Those with a vertex that the tile owns, and which of them are at each vertex.
class RegionSides {
 public:
  /// Labels below exterior are looked at.  Cost: one sort of the triangles at each vertex.
  RegionSides(const MeshStars& stars, Label exterior);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(all_.size()); }
  [[nodiscard]] const RegionSide& operator[](std::uint32_t side) const { return all_[side]; }
  [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    return std::span(at_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }

 private:
  void sort_by_vertex();

  std::vector<RegionSide> all_;
  std::vector<std::uint64_t> begin_;
  std::vector<std::uint32_t> at_;
};

}  // namespace mw::audit
