// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Three passes over bricks: read, coarsen, find the large cells.
#include "engine/labels/prepared_labels.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "engine/labels/reading_tiles.h"
#include "engine/system/tbb_for.h"
#include "kernels/core/for_each_index.h"
#include "kernels/start/carrier_faces.h"
#include "kernels/start/coarsen.h"

namespace mw::engine {
namespace {

constexpr std::int64_t kBrick = io::BrickVolume::kEdge;
/// Bricks along an axis of a tile that is coarsened at once; the halo is one brick.
constexpr std::int64_t kBricksPerTile = 4;
static_assert(kCoarsenHalo <= kBrick);
static_assert(LevelMap::kCube == kBrick);

Box3 clipped(const Box3& box, Index3 shape) {
  return intersection(box, {{0, 0, 0}, shape});
}

Index3 scaled(Index3 v, std::int64_t by) {
  return {v.x * by, v.y * by, v.z * by};
}

LabelBox read(const io::BrickVolume& volume, const Box3& box) {
  LabelBox out{box, std::vector<Label>(static_cast<std::size_t>(box.voxels()))};
  volume.read(box, out.labels);
  return out;
}

/// Copies the voxels of a brick out of a larger box.
void cut_brick(const LabelBox& from, const Box3& brick, std::vector<Label>& out) {
  out.clear();
  for (Index3 v = brick.lo; v.z < brick.hi.z; ++v.z) {
    for (v.y = brick.lo.y; v.y < brick.hi.y; ++v.y) {
      const auto row = from.labels.begin() + from.box.offset({brick.lo.x, v.y, v.z});
      out.insert(out.end(), row, row + brick.shape().x);
    }
  }
}

/// True when each of the bricks has one label, though not all the same.
bool all_uniform(const io::BrickVolume& volume, const Box3& bricks) {
  bool uniform = true;
  for_each_index(clipped(bricks, volume.bricks()),
                 [&](Index3 b) { uniform = uniform && volume.uniform_label(b).has_value(); });
  return uniform;
}

/// What settings ask of edges, in lengths of the metric.
SizeField size_field(const io::DenseVolume& volume, const SizeSettings& sizes) {
  if (sizes.labels.empty()) return {};
  const auto& spacing = volume.info().space.spacing;
  const double unit = *std::min_element(spacing.begin(), spacing.end());
  std::vector<double> limits(volume.table().size(), SizeField::kNoLimit);
  for (const LabelSize& s : sizes.labels) {
    limits[volume.table().dense(s.label)] = s.longest_edge / unit;
  }
  return {volume.info().shape, Metric(spacing), std::move(limits), sizes.gradation};
}

std::optional<InnerDemand> inner_demand(const io::LabelTable& table, const SizeSettings& sizes) {
  if (!sizes.inner_vertices) return std::nullopt;
  std::vector<bool> wanted(table.size(), sizes.labels.empty());
  for (const LabelSize& s : sizes.labels) wanted[table.dense(s.label)] = true;
  return InnerDemand(std::move(wanted));
}

}  // namespace

PreparedLabels::PreparedLabels(const io::DenseVolume& volume, const MeshSettings& settings,
                               int threads, const std::filesystem::path& folder)
    : original_(volume.info().shape, volume.table().size(), folder),
      faces_(volume.info().shape),
      sizes_(size_field(volume, settings.sizes)),
      inner_(inner_demand(volume.table(), settings.sizes)),
      label_voxels_(volume.table().size()) {
  read_bricks(volume, threads);
  volume.raw().drop_buffers();  // it is not read again
  if (sizes_.limits()) sizes_.spread();
  // Coarsening keeps the topology of labels, not that of interfaces.
  if (settings.start == StartMesh::kCoarse && settings.topology == KeptTopology::kLabels) {
    coarse_.emplace(original_.shape(), volume.table().size(), folder);
    coarsen_tiles(settings.max_distance.value_or(kMaxCoarseDistance), threads);
  }
  if (settings.start != StartMesh::kDense) find_levels(threads);
}

LabelBox PreparedLabels::original(const Box3& box) const {
  return read(original_, box);
}

LabelBox PreparedLabels::shape(const Box3& box) const {
  return read(shapes(), box);
}

void PreparedLabels::read_bricks(const io::DenseVolume& volume, int threads) {
  const ReadingTiles tiles(volume.info());
  tbb_for_each_index(threads, tiles.count(),
                     [&](Index3 tile) { read_tile(volume, tiles.box(tile)); });
}

void PreparedLabels::read_tile(const io::DenseVolume& volume, const Box3& tile) {
  LabelBox labels{tile, std::vector<Label>(static_cast<std::size_t>(tile.voxels()))};
  volume.read(tile, labels.labels);
  const auto bricks = [](std::int64_t voxels) { return (voxels + kBrick - 1) / kBrick; };
  const Index3 first{tile.lo.x / kBrick, tile.lo.y / kBrick, tile.lo.z / kBrick};
  const Index3 last{bricks(tile.hi.x), bricks(tile.hi.y), bricks(tile.hi.z)};
  std::vector<Label> one;
  for_each_index(Box3{first, last}, [&](Index3 brick) {
    cut_brick(labels, original_.box_of(brick), one);
    original_.write(brick, one);
    count(brick, one);
    faces_.count(labels, brick, original_.uniform_label(brick).has_value());
    if (sizes_.limits()) sizes_.add(original_.box_of(brick), one);
  });
}

/// Sums of whole numbers: the same whichever thread adds first.
void PreparedLabels::count(Index3 brick, std::span<const Label> voxels) {
  const auto add = [&](Label label, std::uint64_t more) {
    std::atomic_ref(label_voxels_[label]).fetch_add(more, std::memory_order_relaxed);
  };
  const std::optional<Label> only = original_.uniform_label(brick);
  if (only) return add(*only, voxels.size());
  for (auto run = voxels.begin(); run != voxels.end();) {
    const auto end = std::find_if(run, voxels.end(), [&](Label l) { return l != *run; });
    add(*run, static_cast<std::uint64_t>(end - run));
    run = end;
  }
}

void PreparedLabels::coarsen_tiles(double max_distance, int threads) {
  const Index3 bricks = original_.bricks();
  const auto tiles_along = [](std::int64_t n) { return (n + kBricksPerTile - 1) / kBricksPerTile; };
  const Index3 tiles{tiles_along(bricks.x), tiles_along(bricks.y), tiles_along(bricks.z)};
  tbb_for_each_index(threads, tiles, [&](Index3 t) {
    const Index3 lo = scaled(t, kBricksPerTile);
    coarsen_tile(clipped({lo, lo + scaled({1, 1, 1}, kBricksPerTile)}, bricks), max_distance);
  });
}

void PreparedLabels::coarsen_tile(const Box3& bricks, double max_distance) {
  std::vector<Label> one;
  if (all_uniform(original_, grown(bricks, 1))) {
    for_each_index(bricks, [&](Index3 b) {
      one.assign(static_cast<std::size_t>(original_.box_of(b).voxels()),
                 original_.uniform_label(b).value());
      coarse_->write(b, one);
    });
    return;
  }
  const Box3 tile =
      clipped({scaled(bricks.lo, kBrick), scaled(bricks.hi, kBrick)}, original_.shape());
  const LabelBox before = read(original_, grown(tile, kCoarsenHalo));
  LabelBox after = before;
  coarsen(before, after, tile, original_.shape(), max_distance);
  for_each_index(bricks, [&](Index3 brick) {
    cut_brick(after, original_.box_of(brick), one);
    coarse_->write(brick, one);
  });
}

/// Do sizes allow the largest cells in all of these cubes?
bool PreparedLabels::all_may_be_large(const Box3& cubes) const {
  bool all = true;
  for_each_index(cubes, [&](Index3 c) { all = all && sizes_.allows_cell(scaled(c, kBrick), 4); });
  return all;
}

void PreparedLabels::find_levels(int threads) {
  const Index3 volume = original_.shape();
  levels_ = LevelMap(volume);
  const auto is_whole = [&](Index3 cube) {
    return shapes().box_of(cube).voxels() == kBrick * kBrick * kBrick;
  };
  tbb_for_each_index(threads, levels_.cubes(), [&](Index3 cube) {
    const Box3 around = clipped(grown({cube, cube + Index3{1, 1, 1}}, 1), levels_.cubes());
    if (is_whole(around.lo) && is_whole(around.hi - Index3{1, 1, 1}) &&
        all_uniform(shapes(), around) && all_may_be_large(around)) {
      levels_.set_eighths(cube, 0xff);
      return;
    }
    const Box3 box{scaled(cube, kBrick), scaled(cube + Index3{1, 1, 1}, kBrick)};
    levels_.set_eighths(
        cube, LevelMap::allowed_eighths(shape(grown(box, LevelMap::kHalo)), volume, cube, sizes()));
  });
  levels_.find_cubes([&](Index3 cube) {
    return is_whole(cube) && shapes().uniform_label(cube).has_value() &&
           sizes_.allows_cell(scaled(cube, kBrick), 4);
  });
}

}  // namespace mw::engine
