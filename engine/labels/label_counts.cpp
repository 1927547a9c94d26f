// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums over bricks by many threads.
#include "engine/labels/label_counts.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "engine/labels/reading_tiles.h"
#include "engine/system/crew.h"
#include "kernels/core/assert.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

std::optional<Label> only_label(std::span<const Label> voxels) {
  const Label first = voxels[0];
  const bool is_only =
      std::all_of(voxels.begin(), voxels.end(), [&](Label l) { return l == first; });
  return is_only ? std::optional(first) : std::nullopt;
}

}  // namespace

/// Sums of whole numbers do not depend on which thread adds first.
void LabelCounts::count(Index3 brick, std::span<const Label> mine, std::optional<Label> only) {
  if (!only) faces.count(brick, mine);
  const auto add = [&](Label label, std::uint64_t more) {
    std::atomic_ref(voxels[label]).fetch_add(more, std::memory_order_relaxed);
  };
  if (only) return add(*only, mine.size());
  for (auto run = mine.begin(); run != mine.end();) {
    const auto end = std::find_if(run, mine.end(), [&](Label l) { return l != *run; });
    add(*run, static_cast<std::uint64_t>(end - run));
    run = end;
  }
}

LabelCounts counts_of_part(const io::DenseVolume& volume, int threads, const SequencePart& part) {
  LabelCounts out(volume.info().shape, volume.table().size());
  const std::vector<Box3> tiles = ReadingTiles(volume.info()).boxes(part);
  const Index3 count{static_cast<std::int64_t>(tiles.size()), 1, 1};
  tbb_for_each_index(threads, count, [&](Index3 at) {
    const LabelBox tile = read_labels(volume, tiles[static_cast<std::size_t>(at.x)]);
    for_each_brick(tile, [&](Index3 brick, const Box3& /*box*/, std::span<const Label> voxels) {
      out.count(brick, voxels, only_label(voxels));
    });
  });
  return out;
}

namespace {

/// The finaliser of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): every bit reaches every bit.
std::uint64_t mixed(std::uint64_t v) {
  v = (v ^ v >> 30) * 0xBF58476D1CE4E5B9ULL;
  v = (v ^ v >> 27) * 0x94D049BB133111EBULL;
  return v ^ v >> 31;
}

std::uint64_t sum_over(const Box3& box, std::span<const RawLabel> labels, Index3 volume) {
  const Box3 all{{0, 0, 0}, volume};
  std::uint64_t sum = 0;
  std::size_t next = 0;
  for_each_index(box, [&](Index3 voxel) {
    const auto position = static_cast<std::uint64_t>(all.offset(voxel));
    sum += mixed(mixed(labels[next++] + 1) + position);
  });
  return sum;
}

}  // namespace

void FingerprintVolume::read(const Box3& box, std::span<RawLabel> out) const {
  below().read(box, out);
  sum_ += sum_over(box, out, info().shape);
}

std::uint64_t FingerprintVolume::of(const Box3& box) const {
  std::vector<RawLabel> labels(static_cast<std::size_t>(box.voxels()));
  below().read(box, labels);
  return sum_over(box, labels, info().shape);
}

std::string FingerprintVolume::text() const {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx",
                static_cast<unsigned long long>(sum_.load()));
  return digits.data();
}

namespace {

static_assert(3 * kBrick * kBrick * kBrick <= 0xffff);

std::int64_t bricks_along(std::int64_t voxels) {
  return (voxels + kBrick - 1) / kBrick;
}

/// Counts the faces between a voxel of an array of this shape and those above it along each axis.
std::uint32_t faces_above(const Label* voxel, Index3 at, Index3 shape) {
  const Label label = *voxel;
  return (at.x + 1 < shape.x && voxel[1] != label ? 1U : 0U) +
         (at.y + 1 < shape.y && voxel[shape.x] != label ? 1U : 0U) +
         (at.z + 1 < shape.z && voxel[shape.x * shape.y] != label ? 1U : 0U);
}

}  // namespace

BoundaryFaces::BoundaryFaces(Index3 volume)
    : volume_(volume),
      bricks_{bricks_along(volume.x), bricks_along(volume.y), bricks_along(volume.z)},
      faces_(static_cast<std::size_t>(bricks_.product())) {}

void BoundaryFaces::count(Index3 brick, std::span<const Label> voxels) {
  const Index3 shape = box_of(brick).shape();
  MW_ASSERT(static_cast<std::int64_t>(voxels.size()) == shape.product());
  std::uint32_t faces = 0;
  const Label* voxel = voxels.data();
  for_each_index(shape, [&](Index3 at) { faces += faces_above(voxel++, at, shape); });
  faces_[row(brick)] = static_cast<std::uint16_t>(faces);
}

void BoundaryFaces::add(std::size_t first, std::span<const std::uint16_t> counts) {
  for (const std::uint16_t more : counts) {
    faces_[first] = static_cast<std::uint16_t>(faces_[first] + more);
    ++first;
  }
}

double BoundaryFaces::in(const Box3& box) const {
  const auto below = [](std::int64_t voxel) { return voxel / kBrick; };
  const Box3 inside = intersection(box, {{0, 0, 0}, volume_});
  if (is_empty(inside)) return 0;
  const Box3 touched{
      {below(inside.lo.x), below(inside.lo.y), below(inside.lo.z)},
      {bricks_along(inside.hi.x), bricks_along(inside.hi.y), bricks_along(inside.hi.z)}};
  double faces = 0;
  for_each_index(touched, [&](Index3 brick) {
    const Box3 whole = box_of(brick);
    const auto part = static_cast<double>(intersection(whole, inside).voxels());
    faces += faces_[row(brick)] * part / static_cast<double>(whole.voxels());
  });
  return faces;
}

Box3 BoundaryFaces::box_of(Index3 brick) const {
  const Index3 lo{brick.x * kBrick, brick.y * kBrick, brick.z * kBrick};
  return intersection({lo, lo + Index3{kBrick, kBrick, kBrick}}, {{0, 0, 0}, volume_});
}

}  // namespace mw::engine
