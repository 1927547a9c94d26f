// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Follows an object through a volume, as a flood from cell to cell.
#include "io/volume/object/object_cells.h"

#include <algorithm>
#include <array>
#include <mutex>

#include "io/file/errors.h"
#include "io/volume/volume_readers.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

constexpr int kCellBits = 21;  // kMaxAxisVoxels cells along each axis fit
constexpr std::int64_t kDefaultCell = 64;
constexpr std::int64_t kMinCell = 16, kMaxCell = 128;

std::int64_t cell_edge(std::int64_t chunk) {
  return chunk >= kMinCell && chunk <= kMaxCell ? chunk : kDefaultCell;
}

bool is_one_of(const ObjectLabels& labels, RawLabel label) {
  return std::binary_search(labels.begin(), labels.end(), label);
}

/// Which neighbours of a cell an object touches: bit (1 + x) + 3 (1 + y) + 9 (1 + z) for the one at
/// (x, y, z), each -1, 0 or 1.
using Touched = std::array<bool, 27>;

/// Marks the neighbours on the sides of the cell at which the voxel is.
void touch(const Box3& cell, Index3 v, Touched& touched) {
  const auto side = [](std::int64_t at, std::int64_t lo, std::int64_t hi, int sign) {
    return sign == 0 || at == (sign < 0 ? lo : hi - 1);
  };
  std::size_t bit = 0;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x, ++bit) {
        if (side(v.x, cell.lo.x, cell.hi.x, x) && side(v.y, cell.lo.y, cell.hi.y, y) &&
            side(v.z, cell.lo.z, cell.hi.z, z)) {
          touched[bit] = true;
        }
      }
    }
  }
}

bool is_at_side(const Box3& cell, Index3 v) {
  return v.x == cell.lo.x || v.y == cell.lo.y || v.z == cell.lo.z || v.x == cell.hi.x - 1 ||
         v.y == cell.hi.y - 1 || v.z == cell.hi.z - 1;
}

/// What a cell holds of an object.
struct CellContent {
  Box3 box{};  ///< around the object's voxels; empty: none
  Touched touched{};
  std::set<RawLabel> labels;
};

CellContent look_at(const LabelVolume& volume, const Box3& cell, const ObjectLabels& labels) {
  std::vector<RawLabel> voxels(static_cast<std::size_t>(cell.voxels()));
  volume.read(cell, voxels);
  CellContent out;
  bool is_first = true, has_last = false;
  RawLabel last = 0;
  std::size_t at = 0;
  for_each_index(cell, [&](Index3 v) {
    const RawLabel label = voxels[at++];
    if (at == 1 || label != last) {
      has_last = is_one_of(labels, label);
      if (has_last) out.labels.insert(label);
      last = label;
    }
    if (!has_last) return;
    const Box3 one{v, v + Index3{1, 1, 1}};
    out.box = is_first ? one : hull(out.box, one);
    is_first = false;
    if (is_at_side(cell, v)) touch(cell, v, out.touched);
  });
  return out;
}

}  // namespace

std::string listed(const ObjectLabels& labels) {
  std::string out;
  for (const RawLabel label : labels) {
    out += out.empty() ? "" : ", ";
    const auto with_sign = static_cast<std::int64_t>(label);
    out += with_sign < 0 ? text(with_sign, " (or ", label, ")") : text(label);
  }
  return out;
}

ObjectCells::ObjectCells(Index3 shape, Index3 size) : shape_(shape), size_(size) {}

Box3 ObjectCells::voxels(Index3 cell) const {
  const Index3 lo{cell.x * size_.x, cell.y * size_.y, cell.z * size_.z};
  return intersection({lo, lo + size_}, {{0, 0, 0}, shape_});
}

std::uint64_t ObjectCells::key(Index3 cell) const {
  const auto bits = [](std::int64_t i) { return static_cast<std::uint64_t>(i); };
  return bits(cell.z) << 2 * kCellBits | bits(cell.y) << kCellBits | bits(cell.x);
}

Index3 ObjectCells::take_first() {
  MW_ASSERT(!cells_.empty());
  const std::uint64_t first = *cells_.begin();
  cells_.erase(cells_.begin());
  const auto axis = [&](int shift) {
    return static_cast<std::int64_t>(first >> shift & ((std::uint64_t{1} << kCellBits) - 1));
  };
  return {axis(0), axis(kCellBits), axis(2 * kCellBits)};
}

Index3 cell_size(const VolumeInfo& info) {
  return {cell_edge(info.chunk.x), cell_edge(info.chunk.y), cell_edge(info.chunk.z)};
}

int cell_readers(const LabelVolume& volume, std::uint64_t memory) {
  if (!volume.info().is_far) return 1;
  const auto voxels = static_cast<std::uint64_t>(cell_size(volume.info()).product());
  return readers_that_fit(volume, kFarReaders,
                          {.each = voxels * sizeof(RawLabel), .memory = memory});
}

FoundObject follow_object(const LabelVolume& volume, const ObjectLabels& labels, ObjectCells seeds,
                          const Box3& bounds, const CellReaders& readers) {
  FoundObject out{ObjectCells(volume.info().shape, seeds.size()), {}};
  ObjectCells visited(volume.info().shape, seeds.size());
  const Box3 all = seeds.met_by(bounds);
  std::set<RawLabel> found;
  const auto add = [&](Index3 cell, const CellContent& content) {
    if (is_empty(content.box)) return;
    out.box = out.cells.count() == 0 ? content.box : hull(out.box, content.box);
    out.cells.add(cell);
    found.insert(content.labels.begin(), content.labels.end());
    std::size_t bit = 0;
    for_each_index(grown({cell, cell + Index3{1, 1, 1}}, 1), [&](Index3 next) {
      if (content.touched[bit++] && all.contains(next) && !visited.has(next)) seeds.add(next);
    });
  };
  std::vector<Index3> cells;
  while (seeds.count() > 0) {
    cells.clear();
    while (seeds.count() > 0 && cells.size() < static_cast<std::size_t>(readers.count)) {
      cells.push_back(seeds.take_first());
      visited.add(cells.back());
    }
    std::vector<CellContent> contents(cells.size());
    const Index3 count{static_cast<std::int64_t>(cells.size()), 1, 1};
    readers.at_once(readers.count, count, [&](Index3 index) {
      const auto i = static_cast<std::size_t>(index.x);
      const Box3 voxels = intersection(seeds.voxels(cells[i]), bounds);
      if (!is_empty(voxels)) contents[i] = look_at(volume, voxels, labels);
    });
    for (std::size_t i = 0; i < cells.size(); ++i) add(cells[i], contents[i]);
  }
  ObjectLabels missing;
  std::set_difference(labels.begin(), labels.end(), found.begin(), found.end(),
                      std::back_inserter(missing));
  if (missing.empty()) return out;
  throw Error(ErrorKind::kInput,
              text("--object: labels that a coarser scale has are not where it has them: ",
                   listed(missing), "; give --crop and --labels instead"));
}

Box3 bounds_in_copy(const VolumeInfo& copy, Index3 shape, const Box3& bounds) {
  const auto low = [](std::int64_t at, std::int64_t coarse, std::int64_t fine) {
    return std::max<std::int64_t>(at * coarse / fine - 1, 0);
  };
  const auto high = [](std::int64_t at, std::int64_t coarse, std::int64_t fine) {
    return std::min((at * coarse + fine - 1) / fine + 1, coarse);
  };
  const Index3 c = copy.shape;
  return {{low(bounds.lo.x, c.x, shape.x), low(bounds.lo.y, c.y, shape.y),
           low(bounds.lo.z, c.z, shape.z)},
          {high(bounds.hi.x, c.x, shape.x), high(bounds.hi.y, c.y, shape.y),
           high(bounds.hi.z, c.z, shape.z)}};
}

ObjectLabels scan_for_object(const LabelVolume& copy, const ObjectScan& scan,
                             const std::function<void(const Box3&)>& visit,
                             const CellReaders& readers) {
  const Index3 coarse = copy.info().shape, shape = scan.shape;
  const auto first = [](std::int64_t at, std::int64_t fine, std::int64_t all) {
    return std::max<std::int64_t>(at - 1, 0) * fine / all;
  };
  const auto past = [](std::int64_t at, std::int64_t fine, std::int64_t all) {
    return std::min((at + 2) * fine / all + 1, fine);
  };
  const Box3 looked_at = bounds_in_copy(copy.info(), shape, scan.bounds);
  const ObjectCells tiles(coarse, cell_size(copy.info()));
  const Box3 over = tiles.met_by(looked_at);
  std::set<RawLabel> seen;
  std::mutex visiting;
  readers.at_once(readers.count, over.shape(), [&](Index3 tile) {
    const Box3 box = intersection(tiles.voxels(over.lo + tile), looked_at);
    std::vector<RawLabel> voxels(static_cast<std::size_t>(box.voxels()));
    copy.read(box, voxels);
    const std::lock_guard turn(visiting);
    std::size_t at = 0;
    for_each_index(box, [&](Index3 v) {
      const RawLabel label = voxels[at++];
      if (!is_one_of(scan.labels, label)) return;
      seen.insert(label);
      visit(intersection({{first(v.x, shape.x, coarse.x), first(v.y, shape.y, coarse.y),
                           first(v.z, shape.z, coarse.z)},
                          {past(v.x, shape.x, coarse.x), past(v.y, shape.y, coarse.y),
                           past(v.z, shape.z, coarse.z)}},
                         scan.bounds));
    });
  });
  return {seen.begin(), seen.end()};
}

}  // namespace mw::io
