// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/window/other_grid.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "kernels/core/face_sample.h"
#include "kernels/odt/codt.h"

namespace mw::engine {
namespace {

/// Ids of vertices that are made in a window have this bit (steiner_ids()).
constexpr VertexId kMadeInWindow = VertexId{1} << kSteinerBit;
/// Above the number of a corner there are two bits for each axis: in the plane where the volume
/// begins, and beyond the one where it ends.
constexpr VertexId kNumber = (VertexId{1} << kCopyBits) - 1;

/// Gives vertices the ids that they have in a grid.
class Ids {
 public:
  Ids(const WindowGrid& from, const WindowGrid& to)
      : volume_(to.volume()), corners_(volume_ + Index3{1, 1, 1}) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      begins_elsewhere_[axis] = along(to.first(), axis) > 0;
      is_periodic_[axis] = begins_elsewhere_[axis] || along(from.first(), axis) > 0;
    }
  }

  [[nodiscard]] VertexId at(VertexId id, Point place) const {
    const bool is_made = (id & kMadeInWindow) != 0;
    const Index3 in_volume = index_at(is_made ? 0 : id & kNumber, corners_);
    std::array<std::int64_t, 3> corner{in_volume.x, in_volume.y, in_volume.z};
    VertexId copy = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (!is_periodic_[axis]) continue;
      const std::int64_t volume = along(volume_, axis);
      const std::int64_t units = along(place, axis), end = volume * kUnitsPerVoxel;
      if (corner[axis] == volume) corner[axis] = 0;
      if (!begins_elsewhere_[axis]) {
        if (units == end) corner[axis] = volume;
      } else if (units == 0 || units > end) {
        copy |= VertexId{units == 0 ? 1U : 2U} << 2 * axis;
      }
    }
    if (is_made) return copy << kCopyBits | (id & (kMadeInWindow | kNumber));
    return copy << kCopyBits | raster({corner[0], corner[1], corner[2]}, corners_);
  }

 private:
  Index3 volume_, corners_;
  std::array<bool, 3> begins_elsewhere_{}, is_periodic_{};
};

/// Sorts vertices by their ids, and tets and samples by the new rows.
void make_canonical(BlockMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.vertices.size()), row(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return mesh.vertices[a].id < mesh.vertices[b].id;
  });
  std::vector<BlockVertex> vertices;
  vertices.reserve(order.size());
  for (const std::uint32_t v : order) {
    row[v] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(mesh.vertices[v]);
  }
  mesh.vertices = std::move(vertices);
  for (BlockTet& t : mesh.tets) {
    for (std::uint32_t& v : t.vertices) v = row[v];
    std::sort(t.vertices.begin(), t.vertices.end());
  }
  std::sort(mesh.tets.begin(), mesh.tets.end());
  for (BlockSample& s : mesh.samples) {
    for (std::uint32_t& v : s.triangle) v = row[v];
    std::sort(s.triangle.begin(), s.triangle.end());
  }
  mw::make_canonical(mesh.samples, mesh.vertices.size());
}

}  // namespace

BlockMesh in_other_grid(BlockMesh content, const BlockOfGrid& from, const BlockOfGrid& to) {
  if (from.grid.first() == Index3{} && to.grid.first() == Index3{}) return content;
  const Index3 by = to.grid.beyond(to.block) - from.grid.beyond(from.block);
  const Ids ids(from.grid, to.grid);
  for (BlockVertex& v : content.vertices) {
    v.position = moved(v.position, by);
    v.id = ids.at(v.id, v.position);
  }
  for (BlockSample& s : content.samples) {
    s.samples =
        face_samples(lower_voxel(s.samples) + by, axis_of(s.samples), quarters_of(s.samples));
  }
  make_canonical(content);
  return content;
}

}  // namespace mw::engine
