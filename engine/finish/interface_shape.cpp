// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Interfaces at ranges of vertices, each a tile of the mesh in memory.
#include "engine/finish/interface_shape.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "engine/connect/row_ranges.h"
#include "kernels/audit/mesh_stars.h"
#include "kernels/core/sort_distinct.h"

namespace mw::engine {
namespace {

template <typename Value>
std::uint64_t number_in(const std::vector<Value>& ascending, Value value) {
  return static_cast<std::uint64_t>(std::lower_bound(ascending.begin(), ascending.end(), value) -
                                    ascending.begin());
}

/// The tets that may be beside an interface at a vertex of a range.
class RangeTile {
 public:
  RangeTile(io::ScratchMesh& mesh, const RangeTets& wanted)
      : range_(wanted.range), tets_(wanted.tets.size()), labels_(wanted.tets.size()) {
    read_tets(mesh, wanted.tets, tets_, labels_);
    for (io::TetRows& tet : tets_) {
      for (std::uint64_t& row : tet) {
        row = mesh.first_of(row);
        rows_.push_back(row);
      }
    }
    sort_distinct(rows_);
    number_labels();
    keep_near_interfaces();
    take_places(mesh);
  }

  [[nodiscard]] audit::ShapeMeter measured() const {
    const audit::MeshTile tile{.mesh = {.vertices = places_, .tets = tets_, .labels = dense_},
                               .vertex_ids = rows_,
                               .tet_ids = {},
                               .owned = owned_};
    return audit::measure_shape(audit::MeshStars(tile));
  }

 private:
  /// Numbers labels in their order, and vertices in that of their rows.
  void number_labels() {
    std::vector<RawLabel> raw = labels_;
    sort_distinct(raw);
    for (const RawLabel label : labels_) {
      dense_.push_back(static_cast<Label>(number_in(raw, label)));
    }
    for (io::TetRows& tet : tets_) {
      for (std::uint64_t& row : tet) row = number_in(rows_, row);
    }
  }

  /// Leaves tets out that have no triangle whose corners all have two labels.
  void keep_near_interfaces() {
    constexpr std::uint64_t kNone = ~std::uint64_t{0};
    std::vector<std::uint64_t> first(rows_.size(), kNone);
    std::vector<bool> has_two(rows_.size());
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      for (const std::uint64_t v : tets_[t]) {
        if (first[v] == kNone) first[v] = dense_[t];
        if (first[v] != dense_[t]) has_two[v] = true;
      }
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      const auto corners = std::count_if(tets_[t].begin(), tets_[t].end(),
                                         [&](std::uint64_t v) { return has_two[v]; });
      if (corners < 3) continue;
      tets_[kept] = tets_[t];
      dense_[kept++] = dense_[t];
    }
    tets_.resize(kept);
    dense_.resize(kept);
  }

  void take_places(io::ScratchMesh& mesh) {
    io::CornerReader reader(mesh);
    places_.resize(rows_.size());
    for (const io::TetRows& tet : tets_) {
      const auto corners =
          reader.corners({rows_[tet[0]], rows_[tet[1]], rows_[tet[2]], rows_[tet[3]]});
      for (std::size_t i = 0; i < tet.size(); ++i) places_[tet[i]] = corners[i];
    }
    for (const std::uint64_t row : rows_) owned_.push_back(row / kRowsARange == range_ ? 1 : 0);
  }

  std::uint64_t range_;
  std::vector<io::TetRows> tets_;  ///< rows of the mesh, then numbers of vertices here
  std::vector<RawLabel> labels_;
  std::vector<Label> dense_;
  std::vector<std::uint64_t> rows_;  ///< of the vertices here, ascending
  std::vector<audit::Position> places_;
  std::vector<std::uint8_t> owned_;
};

void sort_tets(io::ScratchMesh& mesh, const TetWork& work, RowRanges& ranges) {
  each_tet_range<std::vector<RangeTet>>(
      mesh, work,
      [&](const TetRange& range, io::CornerReader&) {
        std::vector<RangeTet> out;
        for (std::size_t t = 0; t < range.tets.size(); ++t) {
          io::TetRows rows = range.tets[t];
          for (std::uint64_t& row : rows) row = mesh.first_of(row);
          add_ranges(range.first + t, rows, out);
        }
        return out;
      },
      [&](std::vector<RangeTet>&& found) { ranges.add(found); });
}

}  // namespace

audit::ShapeReport interface_shape(io::ScratchMesh& mesh, std::size_t sort_bytes,
                                   const TetWork& work) {
  mesh.find_doubles(sort_bytes);
  // A tile takes twice as much as a range of tets.
  const WorkInOrder how{.threads = work.how.threads,
                        .at_once = std::max<std::size_t>(1, work.how.at_once / 2)};
  RowRanges ranges(mesh.folder(), sort_bytes);
  sort_tets(mesh, {.how = how, .between = work.between}, ranges);
  audit::ShapeMeter meter;
  items_in_order<RangeTets, audit::ShapeMeter>(
      how, [&] { return ranges.next(); },
      [&](RangeTets&& wanted) { return RangeTile(mesh, wanted).measured(); },
      [&](audit::ShapeMeter&& of_range) {
        work.between();
        meter.add(of_range);
      });
  return meter.report();
}

}  // namespace mw::engine
