// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Five tetrahedra a voxel, and the quadrics of voxel corners.
#include "kernels/lattice/dense_start.h"

#include <algorithm>

namespace mw {
namespace {

/// The eight voxels around a corner, x fastest, from the lower to the higher side of each axis.
using Octant = std::array<Label, 8>;

Octant voxels_around(const LabelBox& labels, Index3 corner) {
  Octant out;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto bit = [i](unsigned axis) { return static_cast<std::int64_t>(i >> axis & 1U); };
    out[i] = labels.at(corner + Index3{bit(0) - 1, bit(1) - 1, bit(2) - 1});
  }
  return out;
}

Quadric corner_quadric(const Octant& around, const QuadricWeights& weights) {
  Quadric q;
  bool inner = true;
  for (std::size_t i = 0; i < 8; ++i) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const std::size_t j = i | std::size_t{1} << axis;
      if (i == j || around[i] == around[j]) continue;
      inner = false;
      if (around[i] != kExterior && around[j] != kExterior) {
        q.add_axis_plane(static_cast<int>(axis), weights.plane);
      }
    }
  }
  q.add_point(inner ? weights.inner_point : weights.boundary_point);
  return q;
}

/// Rows of voxel corners in a block's vertex list, and their global ids.
class Corners {
 public:
  Corners(const Box3& block, Index3 volume)
      : block_(block), size_(block.shape() + Index3{1, 1, 1}), volume_(volume) {}

  [[nodiscard]] Index3 size() const { return size_; }
  [[nodiscard]] std::uint32_t row(Index3 c) const {
    const Index3 d = c - block_.lo;
    return static_cast<std::uint32_t>((d.z * size_.y + d.y) * size_.x + d.x);
  }
  [[nodiscard]] VertexId id(Index3 c) const {
    return static_cast<VertexId>((c.z * (volume_.y + 1) + c.y) * (volume_.x + 1) + c.x);
  }

 private:
  Box3 block_;
  Index3 size_;
  Index3 volume_;
};

Index3 corner_of(Index3 voxel, unsigned i) {
  return voxel + Index3{i & 1U, i >> 1 & 1U, i >> 2 & 1U};
}

void add_sorted(BlockMesh& mesh, std::array<std::uint32_t, 4> rows, Label label) {
  std::sort(rows.begin(), rows.end());
  mesh.tets.push_back({rows, label});
}

void split_voxel(BlockMesh& mesh, const Corners& corners, Index3 voxel, Label label) {
  const auto parity = static_cast<unsigned>((voxel.x + voxel.y + voxel.z) & 1);
  std::array<std::uint32_t, 4> centre{};
  std::size_t found = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const unsigned bits = (i & 1U) ^ (i >> 1 & 1U) ^ (i >> 2);
    if ((bits ^ parity) == 0) {
      centre[found++] = corners.row(corner_of(voxel, i));
      continue;
    }
    add_sorted(mesh,
               {corners.row(corner_of(voxel, i)), corners.row(corner_of(voxel, i ^ 1U)),
                corners.row(corner_of(voxel, i ^ 2U)), corners.row(corner_of(voxel, i ^ 4U))},
               label);
  }
  add_sorted(mesh, centre, label);
}

template <typename Visit>
void each_index(Index3 lo, Index3 hi, Visit visit) {
  for (Index3 i = lo; i.z < hi.z; ++i.z) {
    for (i.y = lo.y; i.y < hi.y; ++i.y) {
      for (i.x = lo.x; i.x < hi.x; ++i.x) visit(i);
    }
  }
}

Index3 unit(unsigned axis) { return {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0}; }

bool is_odd(Index3 corner) { return ((corner.x + corner.y + corner.z) & 1) != 0; }

/// The four samples of the face above `lower` along `axis`.  Each goes to the start triangle of the
/// odd corner in its quarter; those on the diagonal to that of the first odd corner.
void sample_face(std::vector<BlockSample>& samples, const Corners& corners, Index3 lower,
                 unsigned axis, Label side, Index3 volume) {
  const Index3 first = unit(axis == 0 ? 1 : 0), second = unit(axis == 2 ? 1 : 2);
  const Index3 origin = lower + unit(axis);
  const std::array<Index3, 4> corner{origin, origin + first, origin + second,
                                     origin + first + second};
  const unsigned first_odd = is_odd(corner[0]) ? 0 : 1;
  for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
    const unsigned odd = is_odd(corner[quarter]) ? quarter : first_odd;
    std::array<std::uint32_t, 3> rows{corners.row(corner[odd]), corners.row(corner[odd ^ 1U]),
                                      corners.row(corner[odd ^ 2U])};
    std::sort(rows.begin(), rows.end());
    samples.push_back({rows, side, face_sample(lower, axis, quarter, volume)});
  }
}

Point lattice_point(Index3 corner) {
  return {static_cast<std::int32_t>(corner.x * kUnitsPerVoxel),
          static_cast<std::int32_t>(corner.y * kUnitsPerVoxel),
          static_cast<std::int32_t>(corner.z * kUnitsPerVoxel)};
}

}  // namespace

BlockMesh dense_start(const LabelBox& labels, const Box3& block, Index3 volume,
                      const QuadricWeights& weights) {
  const Corners corners(block, volume);
  BlockMesh mesh;
  mesh.vertices.reserve(static_cast<std::size_t>(corners.size().product()));
  mesh.tets.reserve(static_cast<std::size_t>(block.voxels()) * 5);
  each_index(block.lo, block.hi + Index3{1, 1, 1}, [&](Index3 c) {
    mesh.vertices.push_back(
        {corners.id(c), lattice_point(c), corner_quadric(voxels_around(labels, c), weights)});
  });
  each_index(block.lo, block.hi,
             [&](Index3 v) { split_voxel(mesh, corners, v, labels.at(v)); });
  std::sort(mesh.tets.begin(), mesh.tets.end());
  return mesh;
}

std::vector<BlockSample> interface_samples(const LabelBox& labels, const Box3& block,
                                           Index3 volume) {
  const Corners corners(block, volume);
  std::vector<BlockSample> samples;
  each_index(block.lo, block.hi, [&](Index3 v) {
    const Label here = labels.at(v);
    for (unsigned axis = 0; axis < 3; ++axis) {
      const Label above = labels.at(v + unit(axis)), below = labels.at(v - unit(axis));
      if (above != kExterior && here < above) {
        sample_face(samples, corners, v, axis, here, volume);
      }
      if (below != kExterior && here < below) {
        sample_face(samples, corners, v - unit(axis), axis, here, volume);
      }
    }
  });
  std::sort(samples.begin(), samples.end());
  return samples;
}

}  // namespace mw
