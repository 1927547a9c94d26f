// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every face between two voxels is counted in the tile that has its lower one.
#include "engine/labels/label_contacts.h"

#include <algorithm>
#include <map>

#include "engine/labels/reading_tiles.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

class ContactCount {
 public:
  /// REQUIRES: labels are those of read, which has tile and the voxels behind it.
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

  /// Neighbours on an interface are mostly of the same pair.
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

std::vector<LabelContact> label_contacts(const io::LabelVolume& volume) {
  const ReadingTiles tiles(volume.info());
  const Index3 shape = volume.info().shape;
  ContactCount count;
  std::vector<RawLabel> labels;
  for_each_index(tiles.count(), [&](Index3 tile) {
    const Box3 box = tiles.box(tile);
    const Box3 read{box.lo,
                    {std::min(box.hi.x + 1, shape.x), std::min(box.hi.y + 1, shape.y),
                     std::min(box.hi.z + 1, shape.z)}};
    labels.resize(static_cast<std::size_t>(read.voxels()));
    volume.read(read, labels);
    count.add(box, read, labels);
  });
  return count.contacts();
}

}  // namespace mw::engine
