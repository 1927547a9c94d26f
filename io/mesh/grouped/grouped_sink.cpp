// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The sorts that turn a stream of tets into a grouped mesh.
#include "io/mesh/grouped/grouped_sink.h"

#include <algorithm>

#include "io/file/errors.h"
#include "kernels/core/assert.h"
#include "kernels/core/tet_nodes.h"
#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

std::array<std::uint64_t, 3> facet_rows(const TetRows& tet, std::uint64_t opposite) {
  const auto& corners = kTetFacets[opposite];
  return {tet[corners[0]], tet[corners[1]], tet[corners[2]]};
}

}  // namespace

GroupedSink::GroupedSink(const std::filesystem::path& folder, WriteGrouped write, Element element,
                         std::optional<CurveRule> curves)
    : folder_(folder), mesh_(folder), own_(folder), write_(std::move(write)), curves_(curves) {
  mesh_.element_ = element;
  mesh_.source_ = &own_;
  if (element == Element::kCurvedTet10) curves_.emplace();
}

void GroupedSink::begin(const MeshHeader& header) {
  if (mesh_.element_ == Element::kCurvedTet10 && header.record.has_doubles) {
    fail_usage(
        "tet10-curved: not for a mesh with doubled vertices (--split, --cohesive, "
        "--open-hinges); tet10 is");
  }
  mesh_.header_ = header;
  mesh_.header_.record.curved = mesh_.element_ == Element::kCurvedTet10;
  auto& promises = mesh_.header_.record.promises;
  own_.header() = header;
  is_in_parts_ = header.in_parts && mesh_.header_.record.curved;
  if (is_in_parts_) {
    mesh_.header_.in_parts = false;
    mesh_.header_.tets /= kTetParts.size();
  } else if (mesh_.header_.record.curved && promises) {
    promises->quality_floor *= kCurvedFloor;
    promises->max_distance.reset();
  }
}

void GroupedSink::write_vertices(std::span<const Position> positions) {
  own_.add_vertices(positions);
}

void GroupedSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  own_.add_tets(tets, labels);
}

void GroupedSink::write_values(std::span<const double> rows) {
  own_.add_values(rows);
}

void GroupedSink::finish() {
  group([] {});
  if (write_) write_(mesh_);
}

void GroupedSink::take(ScratchMesh& mesh, const std::function<void()>& between) {
  if (!write_) return MeshSink::take(mesh, between);
  write_(view(mesh, between));
}

GroupedMesh& GroupedSink::view(ScratchMesh& mesh, const std::function<void()>& between) {
  begin(mesh.header());
  mesh_.source_ = &mesh;
  group(between);
  return mesh_;
}

std::uint64_t GroupedSink::buffer_bytes() const {
  constexpr std::uint64_t kOfMiddles = 32 << 20;
  constexpr std::uint64_t kOfCurves = 40 << 20;
  constexpr std::uint64_t kOfCorners = kMostBytes - kOfMiddles - kOfCurves;
  return kOfCorners + (has_middles(mesh_.element_) ? kOfMiddles : 0) + (curves_ ? kOfCurves : 0);
}

void GroupedSink::group(const std::function<void()>& between) {
  if (is_in_parts_) mesh_.source_ = &from_parts_.emplace(parts_.emplace(source()).corners());
  check_sink_counts("mesh", mesh_.header_, source().tet_count());
  look_at_vertices();
  look_at_labels();
  number_facets(sort_facets(place_tets(between), between));
  find_wedges();
  if (has_middles(mesh_.element_)) find_middles();
  if (mesh_.element_ == Element::kCurvedTet10) mesh_.curved_nodes_ = source().curved_nodes();
  if (mesh_.curved_nodes_ != nullptr) return;
  if (parts_) {
    own_nodes_.emplace(given_nodes());
  } else if (curves_) {
    own_nodes_.emplace(curve_nodes(mesh_, folder_, *curves_));
  }
  if (own_nodes_) mesh_.curved_nodes_ = &*own_nodes_;
}

PagedArray<Position> GroupedSink::take_nodes() {
  mesh_.curved_nodes_ = nullptr;
  PagedArray<Position> out = std::move(own_nodes_).value();
  own_nodes_.reset();
  return out;
}

/// Returns the places of all nodes as they came.
PagedArray<Position> GroupedSink::given_nodes() {
  PagedArray<Position> out(folder_, mesh_.node_count());
  for (std::uint64_t v = 0; v < mesh_.vertex_count(); ++v) out.set(v, source().vertex(v));
  for (std::uint64_t tet = 0; tet < mesh_.tet_count(); ++tet) {
    const std::array<std::uint64_t, 6> rows = mesh_.middles_[tet];
    const SixPlaces places = given_middles_->get(tet);
    for (std::size_t e = 0; e < rows.size(); ++e) out.set(rows[e], places[e]);
  }
  return out;
}

void GroupedSink::look_at_vertices() {
  Position lo{}, hi{};
  if (mesh_.vertex_count() > 0) lo = hi = source().vertex(0);
  source().each_vertex_batch([&](std::span<const Position> batch) {
    for (const Position& p : batch) {
      for (std::size_t k = 0; k < 3; ++k) {
        mesh_.largest_coordinate_ = std::max(mesh_.largest_coordinate_, std::abs(p[k]));
        lo[k] = std::min(lo[k], p[k]);
        hi[k] = std::max(hi[k], p[k]);
      }
    }
  });
  mesh_.box_.origin = lo;
  for (std::size_t k = 0; k < 3; ++k) mesh_.box_.edges[k][k] = hi[k] - lo[k];
  mesh_.box_ = mesh_.header_.record.box.value_or(mesh_.box_);
}

/// Finds which labels there are, and where the tets of each begin and end.
void GroupedSink::look_at_labels() {
  LabelSet labels;
  source().each_tet_batch([&](const TetBatch& batch) { labels.insert(batch.labels); });
  mesh_.table_ = LabelTable(labels.values(), mesh_.header_.labels_signed);
  std::vector<RowRange>& ranges = mesh_.label_tets_;
  ranges.resize(mesh_.table_.size());
  source().each_tet_batch([&](const TetBatch& batch) {
    for (const RawLabel label : batch.labels) ++ranges[mesh_.table_.dense(label)].end;
  });
  for (std::size_t rank = 1; rank < ranges.size(); ++rank) {
    ranges[rank].begin = ranges[rank - 1].end;
    ranges[rank].end += ranges[rank].begin;
  }
}

/// Places tets by label, and in a label as they came.
GroupedSink::Numbers GroupedSink::place_tets(const std::function<void()>& between) {
  const std::size_t columns = mesh_.header_.values.size();
  mesh_.tets_ = PagedArray<TetRows>(folder_, source().tet_count());
  mesh_.values_ = PagedArray<double>(folder_, source().tet_count() * columns);
  if (parts_) given_middles_.emplace(folder_, source().tet_count());
  std::vector<std::uint64_t> next;
  for (const RowRange& range : mesh_.label_tets_) next.push_back(range.begin);
  Numbers numbers(folder_);
  source().each_tet_batch([&](const TetBatch& batch) {
    between();
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      const std::uint64_t number = next[mesh_.table_.dense(batch.labels[t])]++;
      numbers.append(number << 1 | (place_tet(batch.tets[t], number) ? 1U : 0U));
      for (std::size_t i = 0; i < columns; ++i) {
        mesh_.values_.set(number * columns + i, batch.values[t * columns + i]);
      }
      if (parts_) given_middles_->set(number, parts_->middles(batch.first + t));
    }
  });
  return numbers;
}

/// Returns true if the tet's corners 2 and 3 were swapped.
bool GroupedSink::place_tet(TetRows tet, std::uint64_t number) {
  const std::array<Position, 4> corners = source().corners(tet);
  for (const auto& [from, to] : kTetEdges) {
    const Position edge = minus(corners[to], corners[from]);
    const double square = dot(edge, edge);
    if (square > 0) mesh_.shortest_square_ = std::min(mesh_.shortest_square_, square);
  }
  const double volume = volume6(corners[0], corners[1], corners[2], corners[3]);
  mesh_.least_volume6_ = std::min(mesh_.least_volume6_, std::abs(volume));
  if (volume < 0) std::swap(tet[2], tet[3]);
  mesh_.tets_.set(number, tet);
  return volume < 0;
}

GroupedSink::Facets GroupedSink::sort_facets(Numbers numbers,
                                             const std::function<void()>& between) {
  ScratchFile& facets = source().facets(kSortBytes, between);
  Facets out(folder_, kSortBytes);
  facets.each_batch<MeshFacet>([&](std::span<const MeshFacet> batch) {
    for (const MeshFacet& facet : batch) out.add(record_of(facet, numbers));
  });
  return out;
}

GroupedSink::Facets::Record GroupedSink::record_of(const MeshFacet& facet, Numbers& numbers) {
  const auto& [a, b, c] = facet.rows;
  if (facet.tets > 2) {
    throw Error(ErrorKind::kInput,
                text("three tets share the triangle of vertices ", a, ", ", b, " and ", c,
                     ": this is no mesh of a solid, and has no facets"));
  }
  // 4 * tet + opposite corner, of which 2 and 3 may have been swapped.
  const auto face_of = [&](const FacetSide& side) {
    const std::uint64_t number = numbers[side.tet];
    const bool is_swapped = (number & 1) != 0 && side.opposite >= 2;
    return number >> 1 << 2 | (is_swapped ? side.opposite ^ 1U : side.opposite);
  };
  const auto& [one, other] = facet.sides;
  const Label first = mesh_.table_.dense(one.label);
  if (facet.tets == 1) {
    const BoxSides sides(mesh_.box_);
    const Side side = sides.side_of({source().vertex(a), source().vertex(b), source().vertex(c)});
    return {static_cast<std::uint64_t>(side) << 32 | first, kExterior, face_of(one), 0};
  }
  // Side::kInterface is 0.
  const Label second = mesh_.table_.dense(other.label);
  if (first < second) return {first, second, face_of(one), face_of(other)};
  return {second, first, face_of(other), face_of(one)};
}

void GroupedSink::number_facets(Facets facets) {
  FacetGroup group;
  facets.each([&](const Facets::Record& record) {
    const auto side = static_cast<Side>(record[0] >> 32);
    const auto first = static_cast<Label>(record[0] & 0xffffffffU);
    const auto second = static_cast<Label>(record[1]);
    const std::uint64_t number = mesh_.facets_.size();
    if (number == 0 || side != group.side || first != group.first || second != group.second) {
      if (number > 0) mesh_.facet_groups_.add(group);
      group = {.side = side, .first = first, .second = second, .facets = {number, number}};
    }
    ++group.facets.end;
    const std::uint64_t tet = record[2] >> 2;
    const std::uint64_t opposite = record[2] & 3;
    mesh_.facets_.append({.rows = facet_rows(mesh_.tet(tet), opposite),
                          .tet = tet,
                          .opposite = opposite,
                          .second_tet = record[3] >> 2,
                          .second_opposite = record[3] & 3});
  });
  if (mesh_.facets_.size() > 0) mesh_.facet_groups_.add(group);
}

void GroupedSink::find_wedges() {
  const CohesiveRule& rule = mesh_.header_.record.cohesive;
  if (!rule.any()) return;
  for (const FacetGroup& group : mesh_.facet_groups_) {
    if (group.side != Side::kInterface) continue;
    const RawLabel first = mesh_.table_.raw(group.first), second = mesh_.table_.raw(group.second);
    if (rule.has(first, second)) add_wedges(group, !rule.names(second, first));
  }
}

void GroupedSink::add_wedges(const FacetGroup& group, bool is_first_bottom) {
  WedgeGroup wedges{.bottom = is_first_bottom ? group.first : group.second,
                    .top = is_first_bottom ? group.second : group.first,
                    .wedges = {mesh_.wedges_.size(), mesh_.wedges_.size()}};
  for (std::uint64_t f = group.facets.begin; f < group.facets.end; ++f) {
    const Facet facet = mesh_.facets_[f], other = mesh_.of_second(facet);
    const Facet& bottom = is_first_bottom ? facet : other;
    const Facet& top = is_first_bottom ? other : facet;
    Wedge wedge{.bottom = bottom.rows, .bottom_tet = bottom.tet, .top_tet = top.tet};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto above = std::find_if(top.rows.begin(), top.rows.end(), [&](std::uint64_t row) {
        return source().first_of(row) == source().first_of(bottom.rows[i]);
      });
      MW_ASSERT(above != top.rows.end());
      wedge.top[i] = *above;
    }
    if (wedge.bottom != wedge.top) mesh_.wedges_.append(wedge);
  }
  wedges.wedges.end = mesh_.wedges_.size();
  if (wedges.wedges.size() > 0) mesh_.wedge_groups_.push_back(wedges);
}

/// Numbers the edges in the order of their rows, then gives each tet the numbers of its six.
void GroupedSink::find_middles() {
  ExternalSort<3> edges(folder_, kSortBytes);  // two ascending rows, 8 * tet + edge
  for (std::uint64_t number = 0; number < mesh_.tet_count(); ++number) {
    const TetRows tet = mesh_.tet(number);
    for (std::uint64_t e = 0; e < kTetEdges.size(); ++e) {
      const auto [low, high] = std::minmax(tet[kTetEdges[e][0]], tet[kTetEdges[e][1]]);
      edges.add({low, high, number << 3 | e});
    }
  }
  ExternalSort<2> uses(folder_, kSortBytes);  // 8 * tet + edge, row of the middle
  edges.each_group<2>([&](std::span<const std::array<std::uint64_t, 3>> same) {
    for (const auto& [low, high, use] : same) uses.add({use, mesh_.node_count()});
    mesh_.edges_.append({same[0][0], same[0][1]});
  });
  std::array<std::uint64_t, 6> rows{};
  uses.each([&](const std::array<std::uint64_t, 2>& use) {
    rows[use[0] & 7] = use[1];
    if ((use[0] & 7) == 5) mesh_.middles_.append(rows);
  });
}

}  // namespace mw::io
