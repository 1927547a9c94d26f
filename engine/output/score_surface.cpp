// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The nearest point where the scores of two labels are equal.
#include "engine/output/score_surface.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

constexpr std::int64_t kTileEdge = 32;
/// Tiles of 35^3 voxels that are kept.
constexpr std::size_t kTiles = 24;
/// How far a node may be from its interface, in voxels: as far as straight tets cut corners.
constexpr double kReach = 1.5;

Index3 nearest_inside(Index3 voxel, const Box3& box) {
  return {std::clamp(voxel.x, box.lo.x, box.hi.x - 1), std::clamp(voxel.y, box.lo.y, box.hi.y - 1),
          std::clamp(voxel.z, box.lo.z, box.hi.z - 1)};
}

}  // namespace

/// The score of one label less that of another one.
class ScoreSurface::Difference : public CubicField {
 public:
  Difference(ScoreSurface& surface, RawLabel one, RawLabel other)
      : surface_(surface), one_(one), other_(other) {}

  [[nodiscard]] CubicValues values_from(Index3 first) const override {
    CubicValues out = surface_.scores_from(one_, first);
    const CubicValues others = surface_.scores_from(other_, first);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] -= others[i];
    return out;
  }

 private:
  ScoreSurface& surface_;
  RawLabel one_;
  RawLabel other_;
};

ScoreSurface::ScoreSurface(const io::DenseVolume& volume)
    : volume_(volume.raw()), scores_(*volume.raw().scores()) {
  MW_ASSERT(scores_.shape() == volume_.info().shape);
}

std::optional<io::Vector3> ScoreSurface::nearest(const io::Vector3& place, RawLabel one,
                                                 RawLabel other) {
  if (one >= scores_.labels() || other >= scores_.labels()) return std::nullopt;
  const io::VolumeSpace& space = volume_.info().space;
  const io::Vector3 corner = io::to_corner(space, place);
  const Vec3 voxel(space.spacing[0], space.spacing[1], space.spacing[2]);
  const std::optional<Vec3> found = find_zero(Difference(*this, one, other),
                                              Vec3(corner[0], corner[1], corner[2]), voxel, kReach);
  if (!found || !is_of(*found, one, other)) return std::nullopt;
  return io::to_world(space, {(*found)[0], (*found)[1], (*found)[2]});
}

bool ScoreSurface::is_of(const Vec3& point, RawLabel one, RawLabel other) {
  const auto floor = [&](int k) { return static_cast<std::int64_t>(std::floor(point[k])); };
  const Index3 voxel = nearest_inside({floor(0), floor(1), floor(2)}, {{0, 0, 0}, scores_.shape()});
  const Tile& tile = tile_at(kLabelsThemselves, voxel);
  const double label = tile.numbers[static_cast<std::size_t>(tile.box.offset(voxel))];
  return label == static_cast<double>(one) || label == static_cast<double>(other);
}

CubicValues ScoreSurface::scores_from(RawLabel label, Index3 first) {
  const Box3 all{{0, 0, 0}, scores_.shape()};
  const Tile& tile = tile_at(label, nearest_inside(first + Index3{1, 1, 1}, all));
  CubicValues out;
  std::size_t next = 0;
  for (std::int64_t z = 0; z < 4; ++z) {
    for (std::int64_t y = 0; y < 4; ++y) {
      for (std::int64_t x = 0; x < 4; ++x) {
        const Index3 voxel = nearest_inside(first + Index3{x, y, z}, all);
        out[next++] = tile.numbers[static_cast<std::size_t>(tile.box.offset(voxel))];
      }
    }
  }
  return out;
}

/// Returns the tile that has a voxel and its neighbours, one below and two above along each axis.
const ScoreSurface::Tile& ScoreSurface::tile_at(RawLabel label, Index3 voxel) {
  const Index3 shape = scores_.shape();
  const Index3 tile{voxel.x / kTileEdge, voxel.y / kTileEdge, voxel.z / kTileEdge};
  const Index3 tiles{shape.x / kTileEdge + 1, shape.y / kTileEdge + 1, shape.z / kTileEdge + 1};
  const TileId id{label, Box3{{0, 0, 0}, tiles}.offset(tile)};
  if (const auto found = tiles_.find(id); found != tiles_.end()) return found->second;
  if (order_.size() == kTiles) {
    tiles_.erase(order_.front());
    order_.pop_front();
  }
  const Index3 lo{tile.x * kTileEdge, tile.y * kTileEdge, tile.z * kTileEdge};
  const Index3 edge{kTileEdge + 2, kTileEdge + 2, kTileEdge + 2};
  Tile read{.box = intersection({lo - Index3{1, 1, 1}, lo + edge}, {{0, 0, 0}, shape})};
  const auto count = static_cast<std::size_t>(read.box.voxels());
  read.numbers.resize(count);
  if (label == kLabelsThemselves) {
    std::vector<RawLabel> labels(count);
    volume_.read(read.box, labels);
    std::ranges::transform(labels, read.numbers.begin(),
                           [](RawLabel each) { return static_cast<double>(each); });
  } else {
    scores_.read_scores(label, read.box, read.numbers);
  }
  order_.push_back(id);
  return tiles_.emplace(id, std::move(read)).first->second;
}

}  // namespace mw::engine
