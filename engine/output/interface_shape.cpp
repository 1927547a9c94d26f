// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sorted lists of what a block has, merged with those of what waits.
#include "engine/output/interface_shape.h"

#include <algorithm>
#include <tuple>

#include "engine/output/written_block.h"

namespace mw::engine {
namespace {

template <typename List>
std::uint64_t bytes(const List& list) {
  return list.capacity() * sizeof(typename List::value_type);
}

/// Calls visit(piece) for the pieces of a list whose elements have the same key.
template <typename Element, typename Key, typename Visit>
void for_each_piece(std::span<const Element> list, Key key, Visit visit) {
  for (std::size_t begin = 0, end = 0; begin < list.size(); begin = end) {
    while (end < list.size() && key(list[end]) == key(list[begin])) ++end;
    visit(list.subspan(begin, end - begin));
  }
}

}  // namespace

InterfaceShape::InterfaceShape(const WindowGrid& grid, io::VolumeInfo info,
                               const LabelSelection& selection, HoldMemory hold)
    : info_(std::move(info)), selection_(selection), hold_(std::move(hold)), homes_(grid) {
  info_.space.axes = io::VolumeSpace{}.axes;
}

void InterfaceShape::add(const BlockMesh& block) {
  block_ = &block;
  home_.clear();
  for (const BlockVertex& v : block.vertices) {
    home_.push_back(raster(homes_.home(v.position), homes_.blocks()));
  }
  collect_faces();
  reserve_news();
  pair_faces();
  hold_left();
  const auto home_of = [&](const auto& part) { return home_[part.rows[0]]; };
  std::sort(faces_.begin(), faces_.end(), [&](const Face& a, const Face& b) {
    return std::tuple(home_of(a), a.rows) < std::tuple(home_of(b), b.rows);
  });
  for_each_piece(std::span<const Face>(faces_), home_of,
                 [&](std::span<const Face> piece) { settle_faces(home_of(piece[0]), piece); });
  std::sort(news_.begin(), news_.end(), [&](const EdgeNews& a, const EdgeNews& b) {
    return std::tuple(home_of(a), a.rows, a.opens, a.apex) <
           std::tuple(home_of(b), b.rows, b.opens, b.apex);
  });
  for_each_piece(std::span<const EdgeNews>(news_), home_of,
                 [&](std::span<const EdgeNews> piece) { settle_edges(home_of(piece[0]), piece); });
  faces_ = {};  // what is written next needs the memory
  news_ = {};
  max_remembered_ = std::max(max_remembered_, remembered());
}

void InterfaceShape::collect_faces() {
  faces_.clear();
  faces_.reserve(4 * block_->tets.size());
  for (std::uint32_t t = 0; t < block_->tets.size(); ++t) {
    const auto& [a, b, c, d] = block_->tets[t].vertices;
    for (const auto& rows : {std::array{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}}) {
      faces_.push_back({rows, t});
    }
  }
  std::sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) {
    return std::tie(a.rows, a.tet) < std::tie(b.rows, b.tet);
  });
}

/// Room for all that can be told: a list that grew would take three times as much meanwhile.
void InterfaceShape::reserve_news() {
  std::size_t lone = 0;
  std::size_t interfaces = 0;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (i + 1 == faces_.size() || faces_[i + 1].rows != faces_[i].rows) {
      ++lone;
    } else {
      if (label(faces_[i]) != label(faces_[i + 1])) ++interfaces;
      ++i;
    }
  }
  news_.reserve(3 * interfaces + 6 * lone);
}

/// Leaves the triangles that have one tet in the block and are not on the box.
void InterfaceShape::pair_faces() {
  std::size_t left = 0;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Face face = faces_[i];
    if (i + 1 < faces_.size() && faces_[i + 1].rows == face.rows) {
      meet(face, label(faces_[++i]));
    } else if (!on_box(face)) {
      faces_[left++] = face;
    }
  }
  faces_.resize(left);
}

void InterfaceShape::settle_faces(std::size_t home, std::span<const Face> faces) {
  Front& front = fronts_[home];
  list_bytes_ -= bytes(front.faces);
  std::vector<OpenFace> open;
  auto known = front.faces.cbegin();
  for (const Face& face : faces) {
    const std::array ids{id(face.rows[0]), id(face.rows[1]), id(face.rows[2])};
    while (known != front.faces.cend() && known->ids < ids) open.push_back(*known++);
    const bool closes = known != front.faces.cend() && known->ids == ids;
    tell_open(face, closes ? -1 : 1);
    if (closes) {
      meet(face, (known++)->label);
    } else {
      open.push_back({ids, label(face)});
    }
  }
  open.insert(open.end(), known, front.faces.cend());
  open.shrink_to_fit();
  front.faces = std::move(open);
  list_bytes_ += bytes(front.faces);
}

void InterfaceShape::settle_edges(std::size_t home, std::span<const EdgeNews> news) {
  Front& front = fronts_[home];
  list_bytes_ -= bytes(front.edges);
  std::vector<OpenEdge> open;
  auto known = front.edges.cbegin();
  for_each_piece(
      news, [](const EdgeNews& n) { return n.rows; },
      [&](std::span<const EdgeNews> piece) {
        const auto& rows = piece[0].rows;
        OpenEdge edge{.ids = {id(rows[0]), id(rows[1])}};
        while (known != front.edges.cend() && known->ids < edge.ids) open.push_back(*known++);
        if (known != front.edges.cend() && known->ids == edge.ids) edge = *known++;
        for (const EdgeNews& n : piece) take(edge, n);
        if (edge.open > 0) {
          open.push_back(edge);
        } else {
          finish(edge, rows);
        }
      });
  open.insert(open.end(), known, front.edges.cend());
  open.shrink_to_fit();
  front.edges = std::move(open);
  list_bytes_ += bytes(front.edges);
  if (front.edges.empty()) fronts_.erase(home);  // no face is open where no edge is
}

/// A triangle whose other tet has that label.
void InterfaceShape::meet(const Face& face, Label other) {
  const Label here = label(face);
  if (here == other || !selection_.keeps(here) || !selection_.keeps(other)) return;
  const auto& [a, b, c] = face.rows;
  const LabelPair labels = label_pair(here, other);
  const bool out = points_out(face) == (here == labels.low);
  meter_.add_triangle(position(point(a)), position(point(b)), position(point(c)));
  news_.push_back({{a, b}, c, labels, 0, !out});
  news_.push_back({{b, c}, a, labels, 0, !out});
  news_.push_back({{a, c}, b, labels, 0, out});
}

void InterfaceShape::tell_open(const Face& face, std::int8_t opens) {
  const auto& [a, b, c] = face.rows;
  for (const auto& rows : {std::array{a, b}, {b, c}, {a, c}}) {
    news_.push_back({.rows = rows, .opens = opens});
  }
}

void InterfaceShape::take(OpenEdge& edge, const EdgeNews& news) const {
  edge.open = static_cast<std::uint16_t>(edge.open + news.opens);
  if (news.opens != 0 || edge.triangles == kMany) return;
  if (edge.triangles == 0) edge.labels = news.labels;
  if (edge.triangles == 2 || edge.labels != news.labels) {
    edge.triangles = kMany;
    return;
  }
  edge.apexes[edge.triangles] = point(news.apex);
  edge.turned[edge.triangles] = news.turned;
  ++edge.triangles;
}

void InterfaceShape::finish(const OpenEdge& edge, const std::array<std::uint32_t, 2>& rows) {
  if (edge.triangles != 2) return;
  meter_.add_edge(position(point(rows[0])), position(point(rows[1])),
                  {position(edge.apexes[0]), edge.turned[0]},
                  {position(edge.apexes[1]), edge.turned[1]});
}

io::Vector3 InterfaceShape::position(Point p) const {
  return physical(p, info_.space);
}

bool InterfaceShape::on_box(const Face& face) const {
  const Point a = point(face.rows[0]), b = point(face.rows[1]), c = point(face.rows[2]);
  const auto on_side = [](std::int32_t u, std::int32_t v, std::int32_t w, std::int64_t voxels) {
    return u == v && v == w && (u == 0 || u == voxels * kUnitsPerVoxel);
  };
  return on_side(a.x, b.x, c.x, info_.shape.x) || on_side(a.y, b.y, c.y, info_.shape.y) ||
         on_side(a.z, b.z, c.z, info_.shape.z);
}

/// Whether (b - a) x (c - a) points out of the face's tet.
bool InterfaceShape::points_out(const Face& face) const {
  const auto& [a, b, c] = face.rows;
  for (const std::uint32_t v : block_->tets[face.tet].vertices) {
    if (v != a && v != b && v != c) return volume6(point(v), point(a), point(b), point(c)) > 0;
  }
  return false;
}

/// Before the triangles that are left and their edges wait as well; those that close one will not.
void InterfaceShape::hold_left() {
  const std::uint64_t each = sizeof(OpenFace) + 3 * sizeof(OpenEdge);
  if (hold_) hold_(remembered() + each * faces_.size());
}

}  // namespace mw::engine
