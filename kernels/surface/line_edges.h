// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The edges of a star around which three labels meet or more.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// The least number of labels around an edge of a line.
inline constexpr int kLabelsOfLine = 3;

/// Finds line edges, which have three labels around them or more, the exterior included.
///
/// A line edge is a *touch* if one of its labels comes up several times around it: that label
/// touches itself there, and so do two others that have no triangle in common at the edge.  Voxels
/// make such edges beside a line that runs across their corners, so that it forks.
class LineEdges {
 public:
  /// Returns the far ends of the line edges at v, ascending.  The span is valid until the next
  /// call. REQUIRES: v free.
  [[nodiscard]] std::span<const LocalVertex> at(const TetMesh& mesh, LocalVertex v);

  /// REQUIRES: v free.
  [[nodiscard]] bool is_touch(const TetMesh& mesh, LocalVertex v, LocalVertex w);

 private:
  /// A label at a triangle (v, w, end), or around the edge from v to `end`.
  struct EdgeLabel {
    LocalVertex end = 0;
    Label label = 0;

    friend auto operator<=>(const EdgeLabel&, const EdgeLabel&) = default;
  };

  std::vector<EdgeLabel> around_;
  std::vector<Label> labels_;
  std::vector<LocalVertex> ends_;
};

}  // namespace mw
