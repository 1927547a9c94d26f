// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Faces from the eight voxels around a corner.
#include "kernels/audit/distance/input.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "kernels/core/error.h"

namespace mw::audit {
namespace {

void require_countable(Index3 shape) {
  if (std::max({shape.x, shape.y, shape.z}) <= kMaxAxisVoxels) return;
  throw Error(ErrorKind::kResource,
              "audit: more than 2^20 voxels along an axis; audit parts, or without the distance");
}

bool is_interface(Label a, Label b) {
  return a != b && a != kExterior && b != kExterior;
}

/// Joins the curve_position of the voxel above and the axis, which together sort and name a face.
std::vector<std::uint64_t> face_keys(const VoxelLabels& volume) {
  std::vector<std::uint64_t> keys;
  const Box3 all{{0, 0, 0}, volume.shape + Index3{1, 1, 1}};
  visit_interface_faces(volume, all, [&](const VoxelFace& face, const LabelPair&) {
    keys.push_back(curve_position(face.upper) << 2 | face.axis);
  });
  return keys;
}

/// Gathers every third bit of the key, from bit 0 on.
std::uint32_t gathered(std::uint64_t key) {
  key &= 0x1249249249249249ULL;
  key = (key | key >> 2) & 0x10c30c30c30c30c3ULL;
  key = (key | key >> 4) & 0x100f00f00f00f00fULL;
  key = (key | key >> 8) & 0x001f0000ff0000ffULL;
  key = (key | key >> 16) & 0x001f00000000ffffULL;
  return static_cast<std::uint32_t>(key | key >> 32);
}

VoxelFace face_of(std::uint64_t key) {
  const std::uint64_t position = key >> 2;
  return {{gathered(position), gathered(position >> 1), gathered(position >> 2)},
          static_cast<std::uint32_t>(key & 3U)};
}

}  // namespace

Extent extent_of(const VoxelFace& face) {
  Extent out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.lo[k] = face.upper[k];
    out.hi[k] = face.upper[k] + (k == face.axis ? 0.0 : 1.0);
  }
  return out;
}

LabelPair labels_of(const VoxelFace& face, const VoxelLabels& volume) {
  const Index3 s = volume.shape;
  const std::int64_t above =
      (std::int64_t{face.upper[2]} * s.y + face.upper[1]) * s.x + face.upper[0];
  const std::array<std::int64_t, 3> step{1, s.x, s.x * s.y};
  return {volume.labels[static_cast<std::size_t>(above - step[face.axis])],
          volume.labels[static_cast<std::size_t>(above)]};
}

std::vector<VoxelFace> interface_faces(const VoxelLabels& volume) {
  require_countable(volume.shape);
  std::vector<std::uint64_t> keys = face_keys(volume);
  if (keys.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kResource,
                "audit: 2^32 faces between labels; audit parts, or without the distance");
  }
  std::sort(keys.begin(), keys.end());
  std::vector<VoxelFace> faces;
  faces.reserve(keys.size());
  for (const std::uint64_t key : keys) faces.push_back(face_of(key));
  return faces;
}

std::array<const Label*, 4> MixedCorners::rows(std::int64_t y, std::int64_t z) const {
  const Index3 s = volume_.shape;
  std::array<const Label*, 4> out{};
  for (std::int64_t i = 0; i < 4; ++i) {
    const std::int64_t v = std::clamp(y - 1 + (i & 1), std::int64_t{0}, s.y - 1);
    const std::int64_t w = std::clamp(z - 1 + (i >> 1), std::int64_t{0}, s.z - 1);
    out[static_cast<std::size_t>(i)] = volume_.labels.data() + (w * s.y + v) * s.x;
  }
  return out;
}

MixedCorner MixedCorners::corner(Index3 at, const std::array<const Label*, 4>& rows) const {
  const Box3 box{{0, 0, 0}, volume_.shape};
  MixedCorner out{{static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y),
                   static_cast<std::uint32_t>(at.z)},
                  {}};
  for (std::int64_t i = 0; i < 8; ++i) {
    const Index3 voxel{at.x - 1 + (i & 1), at.y - 1 + (i >> 1 & 1), at.z - 1 + (i >> 2)};
    out.around[static_cast<std::size_t>(i)] =
        box.contains(voxel) ? rows[static_cast<std::size_t>(i >> 1)][voxel.x] : kExterior;
  }
  return out;
}

CloseFaces::Voxel CloseFaces::voxel_of(const VoxelPoint& p) const {
  const Voxel shape{volume_.shape.x, volume_.shape.y, volume_.shape.z};
  Voxel out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double last = static_cast<double>(shape[k] - 1);
    out[k] = static_cast<std::int64_t>(std::clamp(p[k], 0.0, last));
  }
  return out;
}

CloseFaces::Block CloseFaces::block_around(const Voxel& voxel) const {
  const Index3 s = volume_.shape;
  const Box3 box{{0, 0, 0}, s};
  const Box3 around{{voxel[0] - 1, voxel[1] - 1, voxel[2] - 1},
                    {voxel[0] + 2, voxel[1] + 2, voxel[2] + 2}};
  const bool is_inside = intersection(around, box) == around;
  const Label* const first =
      is_inside ? volume_.labels.data() + box.offset(around.lo) : volume_.labels.data();
  Block out{};
  for (std::int64_t i = 0; i < 27; ++i) {
    const Index3 step{i % 3, i / 3 % 3, i / 9};
    Label& label = out[static_cast<std::size_t>(i)];
    if (is_inside) {
      label = first[(step.z * s.y + step.y) * s.x + step.x];
      continue;
    }
    const Index3 v = around.lo + step;
    label = box.contains(v) ? volume_.labels[static_cast<std::size_t>(box.offset(v))] : kExterior;
  }
  return out;
}

/// From a point of the middle voxel, faces outside the block are at least a voxel away.  A point
/// outside the box is no nearer to anything in the box, which is convex, than the point of the box
/// that is nearest to it; and that one lies in the middle voxel.
std::array<CloseFaces::Near, 2> CloseFaces::nearest(const VoxelPoint& p,
                                                    const LabelPair& labels) const {
  const Voxel voxel = voxel_of(p);
  const Block block = block_around(voxel);
  const auto square = [](double x) { return x * x; };
  std::array<std::array<double, 3>, 3> to_slab{};   // squared distances to voxels along each axis
  std::array<std::array<double, 2>, 3> to_plane{};  // and to the planes between them
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = p[k] - static_cast<double>(voxel[k]);
    to_plane[k] = {square(at), square(at - 1)};
    to_slab[k] = {square(std::max(at, 0.0)), square(std::max({-at, at - 1, 0.0})),
                  square(std::max(1 - at, 0.0))};
  }
  constexpr std::array<std::size_t, 3> kStep{1, 3, 9};
  std::array<Near, 2> out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (std::size_t i = 0; i < 18; ++i) {
      const std::size_t plane = i / 9;
      const std::size_t below = plane * kStep[axis] + i % 3 * kStep[u] + i / 3 % 3 * kStep[v];
      const Label a = block[below];
      const Label b = block[below + kStep[axis]];
      if (!is_interface(a, b)) continue;
      const double squared = to_plane[axis][plane] + to_slab[u][i % 3] + to_slab[v][i / 3 % 3];
      for (std::size_t n = 0; n < 2; ++n) {
        if ((a != labels[n] && b != labels[n]) || squared >= out[n].squared) continue;
        out[n].squared = squared;
        out[n].face.lo[axis] = out[n].face.hi[axis] =
            static_cast<double>(voxel[axis]) + static_cast<double>(plane);
        for (const auto& [k, position] : {std::pair{u, i % 3}, std::pair{v, i / 3 % 3}}) {
          out[n].face.lo[k] = static_cast<double>(voxel[k]) + static_cast<double>(position) - 1;
          out[n].face.hi[k] = out[n].face.lo[k] + 1;
        }
      }
    }
  }
  return out;
}

}  // namespace mw::audit
