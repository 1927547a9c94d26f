// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The sorts that turn a stream of tets into a grouped mesh.
#include "io/mesh/grouped/grouped_sink.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/mesh/tet_record.h"
#include "kernels/core/assert.h"
#include "kernels/core/tet_nodes.h"
#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

/// Returns the rows of a face, by which the two tets of a triangle find each other.
std::array<std::uint64_t, 3> key_of(const std::array<std::uint64_t, 4>& face) {
  return {face[0], face[1], face[2]};
}

std::array<std::uint64_t, 3> facet_rows(const TetRows& tet, std::uint64_t opposite) {
  const auto& corners = kTetFacets[opposite];
  return {tet[corners[0]], tet[corners[1]], tet[corners[2]]};
}

}  // namespace

GroupedSink::GroupedSink(const std::filesystem::path& folder, std::unique_ptr<GroupedWriter> writer,
                         Element element, std::optional<CurveRule> curves)
    : folder_(folder),
      mesh_(folder),
      tets_(folder),
      values_(folder),
      writer_(std::move(writer)),
      curves_(curves) {
  mesh_.element_ = element;
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
  if (header.in_parts && mesh_.header_.record.curved) {
    parts_.emplace(folder_, header.values.size());
    given_middles_.emplace(folder_);
    mesh_.header_.in_parts = false;
    mesh_.header_.tets /= kTetParts.size();
    return;
  }
  auto& promises = mesh_.header_.record.promises;
  if (mesh_.header_.record.curved && promises) {
    promises->quality_floor *= kCurvedFloor;
    promises->max_distance.reset();
  }
  if (header.record.has_doubles) doubles_.emplace(folder_, kSortBytes);
}

void GroupedSink::write_vertices(std::span<const Position> positions) {
  if (parts_ && !parts_->is_joined()) return parts_->add_vertices(positions);
  for (const Position& p : positions) {
    if (mesh_.vertices_.size() == 0) lo_ = hi_ = p;
    for (std::size_t k = 0; k < 3; ++k) {
      mesh_.largest_coordinate_ = std::max(mesh_.largest_coordinate_, std::abs(p[k]));
      lo_[k] = std::min(lo_[k], p[k]);
      hi_[k] = std::max(hi_[k], p[k]);
    }
    mesh_.vertices_.append(p);
  }
  if (doubles_) doubles_->add(positions);
}

void GroupedSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size());
  if (parts_ && !parts_->is_joined()) return parts_->add(tets, labels);
  append_tets(tets_, tets, labels);
  labels_.insert(labels);
}

void GroupedSink::write_values(std::span<const double> rows) {
  if (parts_ && !parts_->is_joined()) return parts_->add_values(rows);
  for (const double value : rows) values_.append(value);
}

void GroupedSink::finish() {
  if (parts_) parts_->join(*this);
  group();
  if (writer_) writer_->write(mesh_);
}

std::uint64_t GroupedSink::buffer_bytes() const {
  constexpr std::uint64_t kOfCorners = 64 << 20;
  constexpr std::uint64_t kOfMiddles = 32 << 20;
  constexpr std::uint64_t kOfCurves = 40 << 20;
  return kOfCorners + (has_middles(mesh_.element_) ? kOfMiddles : 0) + (curves_ ? kOfCurves : 0);
}

void GroupedSink::group() {
  check_sink_counts("mesh", mesh_.header_, tets_.size() / sizeof(TetRecord));
  mesh_.table_ = LabelTable(labels_.values(), mesh_.header_.labels_signed);
  find_box();
  if (doubles_) doubles_->find();
  Facets facets(folder_, kSortBytes);
  {
    Faces faces(folder_, kSortBytes);
    sort_tets(faces);
    pair_faces(faces, facets);
  }
  number_facets(facets);
  find_wedges();
  if (has_middles(mesh_.element_)) find_middles();
  if (parts_) {
    mesh_.curved_.emplace(given_nodes());
  } else if (curves_) {
    mesh_.curved_.emplace(curve_nodes(mesh_, folder_, *curves_));
  }
}

/// Returns the places of all nodes as they came.
PagedArray<Position> GroupedSink::given_nodes() {
  PagedArray<Position> out(folder_, mesh_.node_count());
  const auto put = [&out](std::uint64_t row, const Position& at) {
    out.change(row, [&at](Position& place) { place = at; });
  };
  for (std::uint64_t v = 0; v < mesh_.vertices_.size(); ++v) put(v, mesh_.vertices_[v]);
  for (std::uint64_t tet = 0; tet < mesh_.tets_.size(); ++tet) {
    const std::array<std::uint64_t, 6> rows = mesh_.middles_[tet];
    const SixPlaces places = (*given_middles_)[tet];
    for (std::size_t e = 0; e < rows.size(); ++e) put(rows[e], places[e]);
  }
  return out;
}

void GroupedSink::find_box() {
  if (mesh_.header_.record.box) {
    mesh_.box_ = *mesh_.header_.record.box;
    return;
  }
  mesh_.box_.origin = lo_;
  for (std::size_t k = 0; k < 3; ++k) mesh_.box_.edges[k][k] = hi_[k] - lo_[k];
}

/// Sorts tets by label, and in a label as they came, and adds their faces.
void GroupedSink::sort_tets(Faces& faces) {
  using Record = std::array<std::uint64_t, 6>;
  ExternalSort<6> tets(folder_, kSortBytes);
  std::uint64_t number = 0;
  tets_.each_batch<TetRecord>([&](std::span<const TetRecord> batch) {
    for (const auto& [a, b, c, d, label] : batch) {
      tets.add({mesh_.table_.dense(label), number++, a, b, c, d});
    }
  });
  mesh_.label_tets_.resize(mesh_.table_.size());
  tets.each([&](const Record& record) {
    RowRange& range = mesh_.label_tets_[record[0]];
    if (range.size() == 0) range = {mesh_.tets_.size(), mesh_.tets_.size()};
    ++range.end;
    place_tet({record[2], record[3], record[4], record[5]}, faces);
    place_values(record[1]);
    if (parts_) given_middles_->append(parts_->middles(record[1]));
  });
}

void GroupedSink::place_values(std::uint64_t tet) {
  const std::size_t columns = mesh_.header_.values.size();
  for (std::size_t i = 0; i < columns; ++i) mesh_.values_.append(values_[tet * columns + i]);
}

void GroupedSink::place_tet(TetRows tet, Faces& faces) {
  for (const std::uint64_t row : tet) {
    if (row >= mesh_.vertices_.size()) {
      throw Error(ErrorKind::kInput,
                  text("a tet names vertex ", row, " of ", mesh_.vertices_.size()));
    }
  }
  std::array<Position, 4> corners{};
  for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh_.vertices_[tet[i]];
  for (const auto& [from, to] : kTetEdges) {
    const Position edge = minus(corners[to], corners[from]);
    const double square = dot(edge, edge);
    if (square > 0) mesh_.shortest_square_ = std::min(mesh_.shortest_square_, square);
  }
  const double volume = volume6(corners[0], corners[1], corners[2], corners[3]);
  mesh_.least_volume6_ = std::min(mesh_.least_volume6_, std::abs(volume));
  if (volume < 0) std::swap(tet[2], tet[3]);
  const std::uint64_t number = mesh_.tets_.size();
  mesh_.tets_.append(tet);
  for (std::uint64_t opposite = 0; opposite < 4; ++opposite) {
    std::array<std::uint64_t, 3> rows = facet_rows(tet, opposite);
    for (std::uint64_t& row : rows) row = first_of(row);
    std::sort(rows.begin(), rows.end());
    faces.add({rows[0], rows[1], rows[2], number << 2 | opposite});
  }
}

void GroupedSink::pair_faces(Faces& faces, Facets& facets) {
  std::array<FaceRecord, 2> sharing{};
  std::size_t count = 0;
  const auto close = [&] {
    if (count > 0) add_facet(std::span(sharing).first(count), facets);
    count = 0;
  };
  faces.each([&](const FaceRecord& face) {
    if (count > 0 && key_of(face) != key_of(sharing[0])) close();
    if (count == 2) {
      throw Error(ErrorKind::kInput,
                  text("three tets share the triangle of vertices ", face[0], ", ", face[1],
                       " and ", face[2], ": this is no mesh of a solid, and has no facets"));
    }
    sharing[count++] = face;
  });
  close();
}

void GroupedSink::add_facet(std::span<const FaceRecord> sharing, Facets& facets) {
  const Label one = mesh_.label_of(sharing[0][3] >> 2);
  if (sharing.size() == 1) {
    std::array<Position, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = mesh_.vertices_[sharing[0][i]];
    const auto side = static_cast<std::uint64_t>(BoxSides(mesh_.box_).side_of(corners));
    facets.add({side << 32 | one, kExterior, sharing[0][3], 0});
    return;
  }
  const Label other = mesh_.label_of(sharing[1][3] >> 2);
  if (one == other) return;
  const std::size_t lower = one < other ? 0 : 1;
  // Side::kInterface is 0.
  facets.add(
      {std::min(one, other), std::max(one, other), sharing[lower][3], sharing[1 - lower][3]});
}

void GroupedSink::number_facets(Facets& facets) {
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
    mesh_.facets_.append({.rows = facet_rows(mesh_.tets_[tet], opposite),
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
        return first_of(row) == first_of(bottom.rows[i]);
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
  for (std::uint64_t number = 0; number < mesh_.tets_.size(); ++number) {
    const TetRows tet = mesh_.tets_[number];
    for (std::uint64_t e = 0; e < kTetEdges.size(); ++e) {
      const auto [low, high] = std::minmax(tet[kTetEdges[e][0]], tet[kTetEdges[e][1]]);
      edges.add({low, high, number << 3 | e});
    }
  }
  ExternalSort<2> uses(folder_, kSortBytes);  // 8 * tet + edge, row of the middle
  std::array<std::uint64_t, 2> last{};
  edges.each([&](const std::array<std::uint64_t, 3>& record) {
    const std::array<std::uint64_t, 2> corners{record[0], record[1]};
    if (mesh_.edges_.size() == 0 || corners != last) mesh_.edges_.append(corners);
    last = corners;
    uses.add({record[2], mesh_.node_count() - 1});
  });
  std::array<std::uint64_t, 6> rows{};
  uses.each([&](const std::array<std::uint64_t, 2>& use) {
    rows[use[0] & 7] = use[1];
    if ((use[0] & 7) == 5) mesh_.middles_.append(rows);
  });
}

}  // namespace mw::io
