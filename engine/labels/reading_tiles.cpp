// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Chunks, rounded to bricks.
#include "engine/labels/reading_tiles.h"

#include <algorithm>

#include "io/labels/brick_volume.h"

namespace mw::engine {
namespace {

constexpr std::int64_t kBrick = io::BrickVolume::kEdge;
/// Of volumes without chunks: long rows, 2 MiB of labels.
constexpr Index3 kPlainTile{1024, kBrick, kBrick};

std::int64_t whole_bricks(std::int64_t voxels) {
  return (voxels + kBrick - 1) / kBrick * kBrick;
}

/// Half as many bricks, at least one.
std::int64_t halved(std::int64_t voxels) {
  return std::max(kBrick, whole_bricks(voxels / 2));
}

}  // namespace

ReadingTiles::ReadingTiles(const io::VolumeInfo& volume) : shape_(volume.shape) {
  const auto edge = [](std::int64_t chunk, std::int64_t plain, std::int64_t extent) {
    return std::min(whole_bricks(chunk > 0 ? chunk : plain), whole_bricks(extent));
  };
  edges_ = {edge(volume.chunk.x, kPlainTile.x, shape_.x),
            edge(volume.chunk.y, kPlainTile.y, shape_.y),
            edge(volume.chunk.z, kPlainTile.z, shape_.z)};
  // The slowest axis first: what is left of a chunk is then read while it is still kept.
  for (std::int64_t* axis : {&edges_.z, &edges_.y, &edges_.x}) {
    while (edges_.product() > kMaxVoxels && *axis > kBrick) *axis = halved(*axis);
  }
}

Index3 ReadingTiles::count() const {
  const auto along = [](std::int64_t n, std::int64_t edge) { return (n + edge - 1) / edge; };
  return {along(shape_.x, edges_.x), along(shape_.y, edges_.y), along(shape_.z, edges_.z)};
}

Box3 ReadingTiles::box(Index3 tile) const {
  const Index3 lo{tile.x * edges_.x, tile.y * edges_.y, tile.z * edges_.z};
  return intersection({lo, lo + edges_}, {{0, 0, 0}, shape_});
}

}  // namespace mw::engine
