// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Adds up runs of one label along x by label, and counts every face between two voxels in the tile
// that has its lower voxel.
#include "engine/labels/label_regions.h"

#include <algorithm>
#include <limits>
#include <map>
#include <mutex>
#include <unordered_map>

#include "engine/labels/label_scan.h"
#include "engine/labels/reading_tiles.h"
#include "engine/system/crew.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

class RegionCount {
 public:
  /// REQUIRES: labels are those of box, x fastest.
  void add(const Box3& box, std::span<const RawLabel> labels) {
    const auto length = static_cast<std::size_t>(box.shape().x);
    for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
      for (v.y = box.lo.y; v.y < box.hi.y; ++v.y) {
        add_row(v, labels.first(length));
        labels = labels.subspan(length);
      }
    }
  }

  void add(const RegionCount& other) {
    for (const auto& [label, region] : other.regions_) add(region);
  }

  [[nodiscard]] std::vector<LabelRegion> regions() const {
    std::vector<LabelRegion> out;
    out.reserve(regions_.size());
    for (const auto& [label, region] : regions_) out.push_back(region);
    return out;
  }

 private:
  void add_row(Index3 first, std::span<const RawLabel> row) {
    for (std::size_t begin = 0, end = 0; begin < row.size(); begin = end) {
      while (end < row.size() && row[end] == row[begin]) ++end;
      const auto x = first.x + static_cast<std::int64_t>(begin);
      const auto after = first.x + static_cast<std::int64_t>(end);
      add({.label = row[begin],
           .voxels = end - begin,
           .box = {{x, first.y, first.z}, {after, first.y + 1, first.z + 1}}});
    }
  }

  void add(const LabelRegion& more) {
    const auto [found, is_new] = regions_.try_emplace(more.label, more);
    if (is_new) return;
    LabelRegion& region = found->second;
    region.voxels += more.voxels;
    Index3& lo = region.box.lo;
    Index3& hi = region.box.hi;
    const Box3& box = more.box;
    lo = {std::min(lo.x, box.lo.x), std::min(lo.y, box.lo.y), std::min(lo.z, box.lo.z)};
    hi = {std::max(hi.x, box.hi.x), std::max(hi.y, box.hi.y), std::max(hi.z, box.hi.z)};
  }

  std::unordered_map<RawLabel, LabelRegion> regions_;
};

class ContactCount {
 public:
  /// REQUIRES: labels are those of the box `read`: the tile and the voxels next to its far sides.
  void add(const Box3& tile, const Box3& read, std::span<const RawLabel> labels) {
    const Index3 shape = read.shape();
    const std::array<std::int64_t, 3> step{1, shape.x, shape.x * shape.y};
    for (Index3 v = tile.lo; v.z < tile.hi.z; ++v.z) {
      for (v.y = tile.lo.y; v.y < tile.hi.y; ++v.y) {
        for (v.x = tile.lo.x; v.x < tile.hi.x; ++v.x) {
          const auto at = static_cast<std::size_t>(read.offset(v));
          const std::array<bool, 3> inside{v.x + 1 < read.hi.x, v.y + 1 < read.hi.y,
                                           v.z + 1 < read.hi.z};
          for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!inside[axis]) continue;
            const RawLabel other = labels[at + static_cast<std::size_t>(step[axis])];
            if (labels[at] != other) count(labels[at], other, axis);
          }
        }
      }
    }
  }

  [[nodiscard]] std::vector<LabelContact> contacts() const {
    std::vector<LabelContact> out;
    out.reserve(faces_.size());
    for (const auto& [pair, faces] : faces_) out.push_back({pair.first, pair.second, faces});
    return out;
  }

 private:
  using Pair = std::pair<RawLabel, RawLabel>;

  /// The last pair is remembered, since neighbours on an interface are mostly of the same pair.
  void count(RawLabel a, RawLabel b, std::size_t axis) {
    const Pair pair = std::minmax(a, b);
    if (last_ == nullptr || pair != last_pair_) {
      last_ = &faces_[pair];
      last_pair_ = pair;
    }
    ++(*last_)[axis];
  }

  std::map<Pair, std::array<std::uint64_t, 3>> faces_;
  std::array<std::uint64_t, 3>* last_ = nullptr;
  Pair last_pair_;
};

}  // namespace

std::vector<LabelRegion> label_regions(const io::LabelVolume& volume, int threads) {
  const ReadingTiles tiles(volume.info());
  RegionCount count;
  std::mutex counting;
  // Of voxels that are no labels the error names the first.
  const bool is_in_order = volume.info().scaled || io::is_float(volume.info().type);
  const int readers =
      scanner_count(volume, is_in_order ? 1 : threads, std::numeric_limits<std::uint64_t>::max());
  tbb_for_each_index(readers, tiles.count(), [&](Index3 tile) {
    const Box3 box = tiles.box(tile);
    std::vector<RawLabel> labels(static_cast<std::size_t>(box.voxels()));
    volume.read(box, labels);
    RegionCount here;
    here.add(box, labels);
    const std::lock_guard turn(counting);
    count.add(here);
  });
  std::vector<LabelRegion> out = count.regions();
  const RawLabel flip = has_signed_labels(volume.info()) ? RawLabel{1} << 63U : 0;
  std::sort(out.begin(), out.end(), [flip](const LabelRegion& a, const LabelRegion& b) {
    return (a.label ^ flip) < (b.label ^ flip);
  });
  return out;
}

std::vector<LabelContact> label_contacts(const io::LabelVolume& volume, int threads) {
  const ReadingTiles tiles(volume.info());
  const Index3 shape = volume.info().shape;
  ContactCount count;
  std::mutex counting;
  tbb_for_each_index(threads, tiles.count(), [&](Index3 tile) {
    const Box3 box = tiles.box(tile);
    const Box3 read{box.lo,
                    {std::min(box.hi.x + 1, shape.x), std::min(box.hi.y + 1, shape.y),
                     std::min(box.hi.z + 1, shape.z)}};
    std::vector<RawLabel> labels(static_cast<std::size_t>(read.voxels()));
    volume.read(read, labels);
    const std::lock_guard turn(counting);
    count.add(box, read, labels);
  });
  return count.contacts();
}

}  // namespace mw::engine
