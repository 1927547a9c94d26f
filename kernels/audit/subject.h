// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What an audit looks at: a volume, a finished mesh of any tool, and where the box lies.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw::audit {

/// A vertex in physical units, x first.
using Position = std::array<double, 3>;

/// The four vertices of a tet, as rows of the vertex table.
using TetRow = std::array<std::uint64_t, 4>;

/// Dense label of a tet whose raw label does not occur in the volume.
inline constexpr Label kUnknown = 0xfffffffeU;

/// Dense label of the space without tets where labels were left out.
inline constexpr Label kLeftOut = 0xfffffffdU;

/// Which labels of the volume a mesh is to hold, by dense label; empty: all.
using KeptLabels = std::vector<bool>;

[[nodiscard]] inline bool keeps(const KeptLabels& kept, Label label) {
  return kept.empty() || (label < kept.size() && kept[label]);
}

/// The input.  labels: shape.product() dense labels, x fastest.
struct VoxelLabels {
  Index3 shape;
  std::span<const Label> labels;
};

/// A mesh in memory.  tets and labels are parallel; labels are dense in the volume's table, and
/// every value that is no label of the volume counts as kUnknown.
struct AuditMesh {
  std::span<const Position> vertices;
  std::span<const TetRow> tets;
  std::span<const Label> labels;
};

/// Where the volume lies, physical units: the box is [origin, origin + shape * spacing].
struct Frame {
  std::array<double, 3> spacing{1, 1, 1};
  std::array<double, 3> origin{0, 0, 0};
};

}  // namespace mw::audit
