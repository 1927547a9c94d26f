// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Merges the sorted lists of a block's triangles and edges with those that wait.
#include "engine/output/interface_shape.h"

#include <algorithm>

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

void InterfaceShape::add(BlockTriangles&& block) {
  block_ = &block;
  for (const auto& [a, b, c] : block.interfaces) {
    meter_.add_triangle(position(point(a)), position(point(b)), position(point(c)));
  }
  hold_lone();
  news_ = std::move(block.news);
  const auto own = static_cast<std::ptrdiff_t>(news_.size());
  const auto home_of = [&](const auto& part) { return block.home(part.rows[0]); };
  for_each_piece(
      std::span<const LoneTriangle>(block.lone), home_of,
      [&](std::span<const LoneTriangle> piece) { settle_faces(home_of(piece[0]), piece); });
  sort_news(own);
  for_each_piece(std::span<const EdgeNews>(news_), home_of,
                 [&](std::span<const EdgeNews> piece) { settle_edges(home_of(piece[0]), piece); });
  news_ = {};  // frees memory for what is written next
  max_remembered_ = std::max(max_remembered_, remembered());
}

/// Sorts news_, of which the first `sorted` entries are sorted already.
void InterfaceShape::sort_news(std::ptrdiff_t sorted) {
  const auto before = [&](const EdgeNews& a, const EdgeNews& b) {
    return block_->comes_before(a, b);
  };
  const auto added = news_.begin() + sorted;
  std::sort(added, news_.end(), before);
  std::inplace_merge(news_.begin(), added, news_.end(), before);
}

void InterfaceShape::settle_faces(std::size_t home, std::span<const LoneTriangle> faces) {
  Front& front = fronts_[home];
  list_bytes_ -= bytes(front.faces);
  std::vector<OpenFace> open;
  auto known = front.faces.cbegin();
  for (const LoneTriangle& face : faces) {
    const std::array ids{id(face.rows[0]), id(face.rows[1]), id(face.rows[2])};
    while (known != front.faces.cend() && known->ids < ids) open.push_back(*known++);
    const bool closes = known != front.faces.cend() && known->ids == ids;
    tell_open(face.rows, closes ? -1 : 1);
    if (closes) {
      meet(face, (known++)->label);
    } else {
      open.push_back({ids, face.label});
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

/// Measures a triangle whose other tet has the label `other`.
void InterfaceShape::meet(const LoneTriangle& face, Label other) {
  const Label here = face.label;
  if (here == other || !selection_.keeps(here) || !selection_.keeps(other)) return;
  const auto& [a, b, c] = face.rows;
  const LabelPair labels = label_pair(here, other);
  meter_.add_triangle(position(point(a)), position(point(b)), position(point(c)));
  tell_interface(face.rows, labels, face.points_out == (here == labels.low), news_);
}

void InterfaceShape::tell_open(const TriangleRows& face, std::int8_t opens) {
  const auto& [a, b, c] = face;
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

/// Holds memory for all lone triangles and their edges, although those that close one do not wait.
void InterfaceShape::hold_lone() {
  const std::uint64_t each = sizeof(OpenFace) + 3 * sizeof(OpenEdge);
  if (hold_) hold_(remembered() + each * block_->lone.size());
}

}  // namespace mw::engine
