// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rounds chunks to bricks, cuts what is read into bricks, and shares a read among threads.
#include "engine/labels/reading_tiles.h"

#include <algorithm>

#include "engine/labels/label_scan.h"
#include "engine/system/crew.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

/// The tile of volumes without chunks: long rows, 2 MiB of labels.
constexpr Index3 kPlainTile{1024, kBrick, kBrick};

std::int64_t whole_bricks(std::int64_t voxels) {
  return (voxels + kBrick - 1) / kBrick * kBrick;
}

/// Returns the edge of half as many bricks, at least one.
std::int64_t halved(std::int64_t voxels) {
  return std::max(kBrick, whole_bricks(voxels / 2));
}

int sharers(const io::LabelVolume& volume, std::uint64_t memory) {
  const io::VolumeInfo& info = volume.info();
  const bool is_in_order = info.scaled || is_float(info.type);
  return info.is_far && !is_in_order ? scanner_count(volume, 1, memory) : 1;
}

}  // namespace

ReadingTiles::ReadingTiles(const io::VolumeInfo& volume) : shape_(volume.shape) {
  const auto edge = [](std::int64_t chunk, std::int64_t plain, std::int64_t extent) {
    return std::min(whole_bricks(chunk > 0 ? chunk : plain), whole_bricks(extent));
  };
  edges_ = {edge(volume.chunk.x, kPlainTile.x, shape_.x),
            edge(volume.chunk.y, kPlainTile.y, shape_.y),
            edge(volume.chunk.z, kPlainTile.z, shape_.z)};
  // The slowest axis is halved first: the rest of a chunk is then read while it is still kept.
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

Box3 ReadingTiles::over(const Box3& box) const {
  const auto after = [](std::int64_t voxel, std::int64_t edge) {
    return (voxel + edge - 1) / edge;
  };
  return {{box.lo.x / edges_.x, box.lo.y / edges_.y, box.lo.z / edges_.z},
          {after(box.hi.x, edges_.x), after(box.hi.y, edges_.y), after(box.hi.z, edges_.z)}};
}

std::vector<Box3> ReadingTiles::boxes(const SequencePart& part) const {
  std::vector<Box3> out;
  const std::int64_t all = count().product();
  std::int64_t number = 0;
  for_each_index(count(), [&](Index3 tile) {
    if (number >= part.begin(all) && number < part.end(all)) out.push_back(box(tile));
    ++number;
  });
  return out;
}

Box3 bricks_over(const Box3& voxels) {
  const auto after = [](std::int64_t voxel) { return (voxel + kBrick - 1) / kBrick; };
  return {{voxels.lo.x / kBrick, voxels.lo.y / kBrick, voxels.lo.z / kBrick},
          {after(voxels.hi.x), after(voxels.hi.y), after(voxels.hi.z)}};
}

void cut_brick(const LabelBox& from, const Box3& brick, std::vector<Label>& out) {
  out.clear();
  for (Index3 v = brick.lo; v.z < brick.hi.z; ++v.z) {
    for (v.y = brick.lo.y; v.y < brick.hi.y; ++v.y) {
      const auto row = from.labels.begin() + from.box.offset({brick.lo.x, v.y, v.z});
      out.insert(out.end(), row, row + brick.shape().x);
    }
  }
}

void for_each_brick(const LabelBox& tile, const OnBrick& visit) {
  std::vector<Label> one;
  for_each_index(bricks_over(tile.box), [&](Index3 brick) {
    const Index3 lo{brick.x * kBrick, brick.y * kBrick, brick.z * kBrick};
    const Box3 box = intersection({lo, lo + Index3{kBrick, kBrick, kBrick}}, tile.box);
    cut_brick(tile, box, one);
    visit(brick, box, one);
  });
}

SharedReads::SharedReads(const io::LabelVolume& volume, std::uint64_t memory)
    : VolumeView(volume), readers_(sharers(volume, memory)) {}

void SharedReads::read(const Box3& box, std::span<RawLabel> out) const {
  const int readers = readers_;
  const ReadingTiles tiles(info());
  const Box3 over = readers > 1 ? tiles.over(box) : Box3{};
  if (over.voxels() <= 1) return below().read(box, out);
  tbb_for_each_index(readers, over.shape(), [&](Index3 i) {
    const Box3 part = intersection(tiles.box(over.lo + i), box);
    std::vector<RawLabel> labels(static_cast<std::size_t>(part.voxels()));
    below().read(part, labels);
    copy_box<RawLabel>(part, part, labels, box, out);
  });
}

}  // namespace mw::engine
