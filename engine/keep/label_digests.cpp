// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/keep/label_digests.h"

#include <algorithm>
#include <array>
#include <bit>

#include "engine/labels/periodic_labels.h"
#include "engine/labels/reading_tiles.h"
#include "engine/system/crew.h"
#include "kernels/core/index.h"
#include "kernels/distance/label_reach.h"
#include "kernels/start/graded_start.h"

namespace mw::engine {
namespace {

constexpr Index3 kBrickShape{kBrick, kBrick, kBrick};
/// Stands for a label's key outside the volume; the number after it says that it is none (run_of).
constexpr std::uint64_t kOutside = 0;
/// How far around what is seen limits on edges are looked up, in voxels: at the ends of edges and
/// of cells of the start mesh.
constexpr std::int64_t kLimitHalo = 8;
/// How far around a block that is made from voxels allowed cells are looked up.
constexpr std::int64_t kCellHalo = 2;

}  // namespace

LabelDigests::LabelDigests(const PreparedLabels& labels, const LabelKeys& keys,
                           const MeshSettings& settings, const WindowGrid& grid, int threads)
    : labels_(labels),
      keys_(keys),
      grid_(grid),
      bricks_(cells_of({{0, 0, 0}, grid.volume()}, kBrickShape).hi),
      margin_(labels.margin()) {
  if (settings.max_distance) reach_ = LabelReach::search_reach(*settings.max_distance);
  const NeededBricks& needed = labels.needed();
  originals_ = digests_of(
      needed.original, [this](Index3 brick) { return original_of(brick); }, threads);
  if (!labels.is_coarse()) return;
  shapes_ = digests_of(
      needed.shapes, [this](Index3 brick) { return shape_of(brick); }, threads);
}

LabelDigests::Digests LabelDigests::digests_of(const Box3& bricks, const DigestOf& of,
                                               int threads) const {
  Digests out(static_cast<std::size_t>(bricks_.product()));
  tbb_for_each_index(threads, bricks_, [&](Index3 brick) {
    if (bricks.contains(brick)) out[raster(brick, bricks_)] = of(brick);
  });
  return out;
}

Box3 LabelDigests::voxels_of(Index3 brick) const {
  const Index3 lo{brick.x * kBrick, brick.y * kBrick, brick.z * kBrick};
  return intersection({lo, lo + kBrickShape}, {{0, 0, 0}, grid_.volume()});
}

io::ContentDigest LabelDigests::original_of(Index3 brick) const {
  const Box3 voxels = voxels_of(brick);
  const std::optional<Label> only = labels_.only_label(place_of(brick));
  return only ? of_one_label(*only, voxels) : of_voxels(labels_.original(voxels));
}

io::ContentDigest LabelDigests::shape_of(Index3 brick) const {
  const Box3 voxels = voxels_of(brick);
  const std::optional<Label> only = labels_.only_shape(place_of(brick));
  return only ? of_one_label(*only, voxels) : of_voxels(labels_.shape(voxels));
}

io::ContentDigest LabelDigests::of_voxels(const LabelBox& labels) const {
  io::DigestMaker maker;
  add_voxels(labels, maker);
  return maker.finish();
}

/// Returns what of_voxels() does when all of them have that label.
io::ContentDigest LabelDigests::of_one_label(Label label, const Box3& voxels) const {
  const std::array<std::uint64_t, 2> run = run_of(label, static_cast<std::size_t>(voxels.voxels()));
  io::DigestMaker maker;
  maker.add(std::as_bytes(std::span(run)));
  return maker.finish();
}

/// Returns the box of the labels that the distance bound looks at and that the source surface
/// there depends on (WindowVisitor); empty where there is no bound.
Box3 LabelDigests::around(const Box3& content) const {
  if (!reach_ || is_empty(content)) return {};
  return grown(content, *reach_ + (labels_.has_source() ? kSourceHalo : 0));
}

std::array<bool, 3> LabelDigests::repeats() const {
  return {margin_.x > 0, margin_.y > 0, margin_.z > 0};
}

/// Returns the place of a brick among those of the volume with its margin.
Index3 LabelDigests::place_of(Index3 brick) const {
  return brick + Index3{margin_.x / kBrick, margin_.y / kBrick, margin_.z / kBrick};
}

/// Calls use for the parts of a box in the volume and in copies of it, as boxes in the volume.
template <typename Use>
void LabelDigests::each_part(const Box3& box, Use use) const {
  if (is_empty(box)) return;
  each_copy(box, grid_.volume(), repeats(), [&](const Box3& part, Index3 by) {
    use(Box3{part.lo - by, part.hi - by});
  });
}

template <typename Use>
void LabelDigests::each_brick(const Box3& voxels, Use use) const {
  each_part(voxels, [&](const Box3& part) { for_each_index(cells_of(part, kBrickShape), use); });
}

/// Returns the label's key, and twice the place where its run ends, plus 1 outside the volume.
std::array<std::uint64_t, 2> LabelDigests::run_of(Label label, std::size_t end) const {
  const bool is_outside = label == kExterior;
  return {is_outside ? kOutside : keys_.key(label), std::uint64_t{end} * 2 + (is_outside ? 1 : 0)};
}

void LabelDigests::add_voxels(const LabelBox& labels, io::DigestMaker& to) const {
  std::vector<std::uint64_t> runs;
  const std::vector<Label>& all = labels.labels;
  for (auto run = all.begin(); run != all.end();) {
    const auto end = std::find_if(run, all.end(), [&](Label l) { return l != *run; });
    const auto both = run_of(*run, static_cast<std::size_t>(end - all.begin()));
    runs.insert(runs.end(), both.begin(), both.end());
    run = end;
  }
  to.add(std::as_bytes(std::span(runs)));
}

void LabelDigests::add_originals(const Box3& voxels, io::DigestMaker& to) const {
  each_brick(voxels, [&](Index3 brick) {
    const io::ContentDigest& digest = originals_[raster(brick, bricks_)];
    to.add(digest.is_none() ? original_of(brick) : digest);
  });
}

void LabelDigests::add_shapes(const Box3& voxels, io::DigestMaker& to) const {
  each_brick(voxels, [&](Index3 brick) { to.add(shapes_[raster(brick, bricks_)]); });
}

/// Adds which large cells the start mesh of a block may have.
void LabelDigests::add_cells(const Box3& block, io::DigestMaker& to) const {
  const LevelMap& levels = labels_.levels();
  if (levels.cubes() == Index3{}) return;
  const Box3 place{block.lo + margin_, block.hi + margin_};
  const Box3 box =
      intersection(grown(place, kCellHalo), {{0, 0, 0}, grid_.volume() + margin_ + margin_});
  for_each_index(cells_of(box, kBrickShape), [&](Index3 c) { to.add(levels.bits_of(c)); });
}

void LabelDigests::add_limits(const Box3& voxels, io::DigestMaker& to) const {
  if (labels_.sizes() == nullptr || is_empty(voxels)) return;
  std::vector<float> limits;
  each_part(grown(voxels, kLimitHalo), [&](const Box3& part) {
    labels_.sizes()->append_limits({part.lo + margin_, part.hi + margin_}, limits);
  });
  std::vector<std::uint32_t> bits;
  for (const float limit : limits) bits.push_back(std::bit_cast<std::uint32_t>(limit));
  to.add(std::as_bytes(std::span(bits)));
}

bool LabelDigests::all_uniform(const Box3& voxels, bool as_shapes) const {
  bool all = true;
  each_brick(voxels, [&](Index3 brick) {
    const Index3 place = place_of(brick);
    all = all && labels_.only_label(place) && (!as_shapes || labels_.only_shape(place));
  });
  return all;
}

io::ContentDigest LabelDigests::of_bricks(const SeenLabels& seen) const {
  io::DigestMaker maker;
  for (const Index3 block : seen.starts) {
    const Box3 box = grid_.block_box(block), wide = grown(box, kStartHalo);
    add_originals(wide, maker);
    if (labels_.is_coarse()) add_shapes(wide, maker);
    add_cells(box, maker);
  }
  add_originals(around(seen.content), maker);
  add_limits(seen.content, maker);
  return maker.finish();
}

/// Where all bricks have one label each, their digests say as much as the voxels, and are at hand.
io::ContentDigest LabelDigests::exact(const SeenLabels& seen) const {
  const Box3 looked_at = around(seen.content);
  const auto is_plain = [&](Index3 block) {
    return all_uniform(grown(grid_.block_box(block), kStartHalo), true);
  };
  if (all_uniform(looked_at, false) &&
      std::all_of(seen.starts.begin(), seen.starts.end(), is_plain)) {
    return of_bricks(seen);
  }
  io::DigestMaker maker;
  for (const Index3 block : seen.starts) {
    const Box3 box = grid_.block_box(block), wide = grown(box, kStartHalo);
    add_voxels(labels_.original(wide), maker);
    if (labels_.is_coarse()) add_voxels(labels_.shape(wide), maker);
    add_cells(box, maker);
  }
  if (!is_empty(looked_at)) {
    add_voxels(repeated_labels(looked_at, grid_.volume(), repeats(),
                               [this](const Box3& box) { return labels_.original(box); }),
               maker);
  }
  add_limits(seen.content, maker);
  return maker.finish();
}

std::uint64_t label_digest_bytes(Index3 shape) {
  const Index3 bricks = cells_of({{0, 0, 0}, shape}, kBrickShape).hi;
  return static_cast<std::uint64_t>(bricks.product()) * 2 * sizeof(io::ContentDigest);
}

}  // namespace mw::engine
