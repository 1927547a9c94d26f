// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rounds over tiles, which find where solid voxels meet in an edge or a corner only, and fill.
#include "io/labels/welded_volume.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "kernels/core/assert.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

constexpr std::int64_t kTileEdge = 128;

/// A filled voxel changes only places within this distance, and what they fill.
constexpr std::int64_t kReach = 2;

constexpr std::array<Index3, 3> kSteps{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

using TileKey = std::tuple<std::int64_t, std::int64_t, std::int64_t>;  // z, y, x

void add_tiles_near(const Box3& box, Index3 shape, std::set<TileKey>& tiles) {
  const Box3 near = intersection(box, {{0, 0, 0}, shape});
  const auto tile = [](std::int64_t i) { return i / kTileEdge; };
  for_each_index(Box3{{tile(near.lo.x), tile(near.lo.y), tile(near.lo.z)},
                      {tile(near.hi.x - 1) + 1, tile(near.hi.y - 1) + 1, tile(near.hi.z - 1) + 1}},
                 [&](Index3 t) {
                   tiles.insert({t.z, t.y, t.x});
                 });
}

Box3 voxels_of(const TileKey& key, Index3 shape) {
  const auto& [z, y, x] = key;
  const Index3 lo{x * kTileEdge, y * kTileEdge, z * kTileEdge};
  return intersection({lo, lo + Index3{kTileEdge, kTileEdge, kTileEdge}}, {{0, 0, 0}, shape});
}

Index3 voxel_at(std::int64_t offset, Index3 shape) {
  const std::int64_t row = offset / shape.x;
  return {offset % shape.x, row % shape.y, row / shape.y};
}

}  // namespace

/// A tile of the volume and the voxels around it, in which it finds what is to be filled.
class WeldedVolume::Tile {
 public:
  Tile(const WeldedVolume& volume, const Box3& tile)
      : volume_(volume),
        all_{{0, 0, 0}, volume.info().shape},
        tile_(tile),
        box_(intersection({tile.lo - Index3{1, 1, 1}, tile.hi + Index3{2, 2, 2}}, all_)),
        labels_(static_cast<std::size_t>(box_.voxels())),
        solid_(labels_.size()) {
    volume.read(box_, labels_);
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const bool is_known = i > 0 && labels_[i] == labels_[i - 1];
      solid_[i] = is_known ? solid_[i - 1] : volume.givers_.contains(labels_[i]) ? 0 : 1;
    }
  }

  [[nodiscard]] bool has_solid() const { return std::ranges::find(solid_, 1) != solid_.end(); }

  /// Marks the givers that are in the tile or around it, by their rank.
  void see_givers(std::vector<char>& seen) const {
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      if (solid_[i] == 0) seen[volume_.givers_.dense(labels_[i])] = 1;
    }
  }

  /// Finds what the places whose first voxel is in this layer of the tile fill.
  void find(std::int64_t z, std::vector<Filled>& out) const {
    const Box3 layer{{tile_.lo.x, tile_.lo.y, z}, {tile_.hi.x, tile_.hi.y, z + 1}};
    for_each_index(layer, [&](Index3 v) {
      if (is_uniform(v)) return;
      at_edge(v, kSteps[0], kSteps[1], out);
      at_edge(v, kSteps[0], kSteps[2], out);
      at_edge(v, kSteps[1], kSteps[2], out);
      at_corner(v, out);
    });
  }

 private:
  [[nodiscard]] std::size_t row(Index3 v) const { return static_cast<std::size_t>(box_.offset(v)); }
  [[nodiscard]] bool is_solid(Index3 v) const { return box_.contains(v) && solid_[row(v)] != 0; }

  /// True if the eight voxels from v on are all solid or all givers', as most are.
  [[nodiscard]] bool is_uniform(Index3 v) const {
    if (!box_.contains(v + Index3{1, 1, 1})) return false;
    const std::int64_t width = box_.shape().x, layer = width * box_.shape().y;
    const char* const first = solid_.data() + row(v);
    const char* const last = first + layer;
    const int count = first[0] + first[1] + first[width] + first[width + 1] + last[0] + last[1] +
                      last[width] + last[width + 1];
    return count == 0 || count == 8;
  }

  /// Fills one voxel if the four around the edge between v and v + a + b are a place.
  void at_edge(Index3 v, Index3 a, Index3 b, std::vector<Filled>& out) const {
    if (!all_.contains(v + a + b)) return;
    const bool first = is_solid(v), other = is_solid(v + a);
    if (first == other || is_solid(v + a + b) != first || is_solid(v + b) != other) return;
    const Index3 one = first ? v + a : v, two = first ? v + b : v + a + b;
    fill(solid_neighbours(two) > solid_neighbours(one) ? two : one, out);
  }

  /// Fills two voxels if the eight around the corner between v and v + (1, 1, 1) are a place: those
  /// on the way from one solid voxel to the other, first along z, then along y.
  void at_corner(Index3 v, std::vector<Filled>& out) const {
    if (!all_.contains(v + Index3{1, 1, 1})) return;
    int count = 0;
    std::array<Index3, 2> solid{};
    for (int i = 0; i < 8 && count <= 2; ++i) {
      const Index3 w = v + Index3{i & 1, i >> 1 & 1, i >> 2 & 1};
      if (!is_solid(w)) continue;
      if (count < 2) solid[static_cast<std::size_t>(count)] = w;
      ++count;
    }
    const Index3 a = solid[0], b = solid[1];
    if (count != 2 || a.x == b.x || a.y == b.y || a.z == b.z) return;
    fill({a.x, a.y, b.z}, out);
    fill({a.x, b.y, b.z}, out);
  }

  [[nodiscard]] int solid_neighbours(Index3 v) const {
    int count = 0;
    for (const Index3 step : kSteps) {
      count += (is_solid(v - step) ? 1 : 0) + (is_solid(v + step) ? 1 : 0);
    }
    return count;
  }

  /// Adds v with the label that it takes.  REQUIRES: a neighbour of v across a face is solid.
  void fill(Index3 v, std::vector<Filled>& out) const {
    std::array<RawLabel, 6> around{};
    std::size_t count = 0;
    for (const Index3 step : kSteps) {
      for (const Index3 w : {v - step, v + step}) {
        if (is_solid(w)) around[count++] = labels_[row(w)];
      }
    }
    out.push_back({all_.offset(v), most_frequent(std::span<const RawLabel>(around).first(count))});
  }

  [[nodiscard]] RawLabel most_frequent(std::span<const RawLabel> labels) const {
    const auto rank = [&](RawLabel label) {
      const std::ptrdiff_t rare = -std::count(labels.begin(), labels.end(), label);
      // With the sign flipped, signed labels are in their order.
      constexpr RawLabel kSign = RawLabel{1} << 63U;
      return std::pair(rare, volume_.givers_.is_signed() ? label ^ kSign : label);
    };
    return *std::min_element(labels.begin(), labels.end(),
                             [&](RawLabel a, RawLabel b) { return rank(a) < rank(b); });
  }

  const WeldedVolume& volume_;
  Box3 all_;
  Box3 tile_;
  Box3 box_;
  std::vector<RawLabel> labels_;
  std::vector<char> solid_;
};

/// What one round fills, while tiles are looked at.
class WeldedVolume::Round {
 public:
  /// REQUIRES: `filled` voxels of earlier rounds are held too.
  Round(std::size_t filled, std::uint64_t memory)
      : filled_(filled), memory_(memory), slack_(memory / sizeof(Filled) / 8) {}

  /// Takes what a tile fills.  A voxel may be found many times, so that what was found is put in
  /// order layer by layer, whenever it has grown by an eighth of the limit.
  void add(const Tile& tile, const Box3& voxels) {
    for (std::int64_t z = voxels.lo.z; z < voxels.hi.z; ++z) {
      tile.find(z, found_);
      if (found_.size() > ordered_ + slack_) put_in_order();
    }
  }
  /// Returns all, ascending and each voxel once.
  [[nodiscard]] std::vector<Filled> take() && {
    put_in_order();
    return std::move(found_);
  }

 private:
  void put_in_order() {
    const auto same = [](const Filled& a, const Filled& b) { return a.at == b.at; };
    std::sort(found_.begin(), found_.end(),
              [](const Filled& a, const Filled& b) { return a.at < b.at; });
    found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
    ordered_ = found_.size();
    if ((filled_ + ordered_) * sizeof(Filled) <= memory_) return;
    throw Error(
        ErrorKind::kResource,
        text("--weld: ", filled_ + ordered_,
             " voxels and more would be filled, which takes more than ", size_words(memory_),
             ", a quarter of --memory: raise it, or drop specks first (--drop-specks)"));
  }

  std::size_t filled_;
  std::uint64_t memory_;
  std::size_t slack_;
  std::vector<Filled> found_;
  std::size_t ordered_ = 0;  ///< how many were left when they were last put in order
};

WeldedVolume::WeldedVolume(const LabelVolume& volume, const std::vector<RawLabel>& givers,
                           std::uint64_t memory)
    : VolumeView(volume), givers_(givers, has_signed_labels(volume.info())) {
  const Index3 shape = info().shape;
  std::set<TileKey> tiles;
  add_tiles_near({{0, 0, 0}, shape}, shape, tiles);
  std::vector<char> seen(givers_.size());
  for (bool is_first = true; !tiles.empty(); is_first = false) {
    Round round(filled_.size(), memory);
    for (const TileKey& key : tiles) {
      const Box3 voxels = voxels_of(key, shape);
      const Tile tile(*this, voxels);
      if (is_first) tile.see_givers(seen);
      if (is_first && tile.has_solid()) facts_.has_solid = true;
      round.add(tile, voxels);
    }
    if (is_first) check_givers(seen);
    tiles.clear();
    const std::vector<Filled> found = std::move(round).take();
    const Index3 reach{kReach, kReach, kReach};
    for (const Filled& f : found) {
      const Index3 v = voxel_at(f.at, shape);
      add_tiles_near({v - reach, v + reach + Index3{1, 1, 1}}, shape, tiles);
    }
    keep(found);
  }
}

void WeldedVolume::check_givers(const std::vector<char>& seen) const {
  const auto missing = std::find(seen.begin(), seen.end(), 0);
  if (missing == seen.end()) return;
  const RawLabel label = givers_.raw(static_cast<Label>(missing - seen.begin()));
  fail_usage("--weld: the volume has no label " + label_text(label, givers_.is_signed()) +
             "; mwmesh info lists its labels");
}

void WeldedVolume::keep(const std::vector<Filled>& found) {
  if (!found.empty()) ++facts_.rounds;
  facts_.voxels += found.size();
  const auto middle = static_cast<std::ptrdiff_t>(filled_.size());
  filled_.insert(filled_.end(), found.begin(), found.end());
  std::inplace_merge(filled_.begin(), filled_.begin() + middle, filled_.end(),
                     [](const Filled& a, const Filled& b) { return a.at < b.at; });
}

void WeldedVolume::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  below().read(box, out);
  if (filled_.empty() || out.empty()) return;
  const Box3 all{{0, 0, 0}, info().shape};
  const std::int64_t width = box.shape().x;
  const auto before = [](const Filled& f, std::int64_t at) { return f.at < at; };
  for (Index3 first = box.lo; first.z < box.hi.z; ++first.z) {
    for (first.y = box.lo.y; first.y < box.hi.y; ++first.y) {
      const std::int64_t begin = all.offset(first);
      const auto to = static_cast<std::size_t>(box.offset(first));
      auto f = std::lower_bound(filled_.begin(), filled_.end(), begin, before);
      for (; f != filled_.end() && f->at < begin + width; ++f) {
        out[to + static_cast<std::size_t>(f->at - begin)] = f->label;
      }
    }
  }
}

}  // namespace mw::io
