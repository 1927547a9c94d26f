// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sorts the corners of boundary triangles by vertex and label, and looks whether they are one fan.
#include "kernels/audit/topology/pinches.h"

#include <algorithm>
#include <span>

namespace mw::audit {
namespace {

/// A corner of a triangle that one tet of a label has, and the triangle's two other vertices.
struct BoundaryCorner {
  std::uint32_t vertex = 0;
  Label label = 0;
  std::array<std::uint32_t, 2> others{};

  friend auto operator<=>(const BoundaryCorner&, const BoundaryCorner&) = default;
};

/// The triangles of a label's boundary around a vertex, which are the edges of a graph.
class BoundaryFan {
 public:
  void reset(std::span<const BoundaryCorner> corners) {
    corners_ = corners;
    ends_.clear();
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      for (const std::uint32_t other : corners[i].others) ends_.push_back({other, i});
    }
    std::sort(ends_.begin(), ends_.end());
  }

  /// Calls visit(other, count) for each edge of the fan, by how many triangles have it.
  template <class Visit>
  void each_edge(Visit&& visit) const {
    for (std::size_t i = 0; i < ends_.size();) {
      const std::size_t first = i;
      while (i < ends_.size() && ends_[i].other == ends_[first].other) ++i;
      visit(ends_[first].other, i - first);
    }
  }

  /// Goes around from triangle to triangle.  REQUIRES: each edge has two.
  [[nodiscard]] bool is_one_cycle() const {
    std::uint32_t triangle = 0, across = corners_[0].others[1];
    std::size_t steps = 0;
    do {
      const End* const end = first_at(across);
      triangle = end[0].triangle == triangle ? end[1].triangle : end[0].triangle;
      const auto& others = corners_[triangle].others;
      across = others[0] == across ? others[1] : others[0];
      ++steps;
    } while (triangle != 0);
    return steps == corners_.size();
  }

 private:
  struct End {
    std::uint32_t other = 0;
    std::uint32_t triangle = 0;
    friend auto operator<=>(const End&, const End&) = default;
  };

  [[nodiscard]] const End* first_at(std::uint32_t other) const {
    return &*std::lower_bound(ends_.begin(), ends_.end(), End{other, 0});
  }

  std::span<const BoundaryCorner> corners_;
  std::vector<End> ends_;
};

class PinchSweep {
 public:
  PinchSweep(const MeshStars& stars, std::size_t label_count)
      : stars_(stars), found_(label_count) {}

  std::vector<Pinches> run() {
    visit_whole_faces(stars_, [this](const MeshFace& face) { add_face(face); });
    std::sort(corners_.begin(), corners_.end());
    for (std::size_t i = 0; i < corners_.size();) {
      const std::size_t first = i;
      const auto& [vertex, label, others] = corners_[first];
      while (i < corners_.size() && corners_[i].vertex == vertex && corners_[i].label == label) ++i;
      look_at(std::span(corners_).subspan(first, i - first));
    }
    return std::move(found_);
  }

 private:
  void add_face(const MeshFace& face) {
    const auto& labels = stars_.mesh().labels;
    for (const FaceSide& side : face.sides) {
      const Label label = labels[side.tet];
      const auto tets = std::count_if(face.sides.begin(), face.sides.end(),
                                      [&](const FaceSide& s) { return labels[s.tet] == label; });
      if (label >= found_.size() || tets != 1) continue;
      const auto& [a, b, c] = face.vertices;
      for (const BoundaryCorner& corner :
           {BoundaryCorner{a, label, {b, c}}, BoundaryCorner{b, label, {a, c}},
            BoundaryCorner{c, label, {a, b}}}) {
        if (stars_.owns(corner.vertex)) corners_.push_back(corner);
      }
    }
  }

  void look_at(std::span<const BoundaryCorner> corners) {
    Pinches& found = found_[corners[0].label];
    fan_.reset(corners);
    bool is_cycles = true;
    fan_.each_edge([&](std::uint32_t other, std::size_t triangles) {
      is_cycles = is_cycles && triangles == 2;
      if (triangles > 2 && other > corners[0].vertex) ++found.edges;
    });
    if (!is_cycles || !fan_.is_one_cycle()) ++found.vertices;
  }

  const MeshStars& stars_;
  std::vector<Pinches> found_;
  std::vector<BoundaryCorner> corners_;
  BoundaryFan fan_;
};

}  // namespace

void Pinches::add(const Pinches& other) {
  vertices += other.vertices;
  edges += other.edges;
}

Pinches Pinches::halved(int times) const {
  const std::uint64_t pieces = std::uint64_t{1} << static_cast<unsigned>(times);
  return {vertices + edges * (pieces - 1), edges * pieces};
}

void VoxelPinches::add(const VoxelPinches& other) {
  corners += other.corners;
  for (std::size_t axis = 0; axis < 3; ++axis) edges[axis] += other.edges[axis];
}

Pinches VoxelPinches::in_layers(Index3 layers) const {
  const std::array<std::int64_t, 3> along{layers.x, layers.y, layers.z};
  Pinches out{.vertices = corners};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto pieces = static_cast<std::uint64_t>(along[axis]);
    out.add({edges[axis] * (pieces - 1), edges[axis] * pieces});
  }
  return out;
}

std::vector<Pinches> mesh_pinches(const MeshStars& stars, std::size_t label_count) {
  return PinchSweep(stars, label_count).run();
}

}  // namespace mw::audit
