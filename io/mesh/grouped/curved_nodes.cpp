// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bulges of edges, moves of corners, and the balance of volumes.
#include "io/mesh/grouped/curved_nodes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "kernels/curve/quadratic.h"

namespace mw::io {
namespace {

/// The cosine of the sharpest bend that is no line.
constexpr double kLineCosine = 0.5;
/// The largest bulge of an edge, as a share of its length: that of an arc of 56 degrees.
constexpr double kMaxBulge = 0.125;
/// The largest move of a corner, as a share of its shortest edge.
constexpr double kMaxMove = 0.25;
/// The least length of a sum of normals that is taken for one, as a share of their lengths' sum.
constexpr double kLeastAgreement = 0.5;
/// How often volumes are balanced; an error of some tenth of a per mille is left then.
constexpr int kRounds = 3;

enum class CornerKind : std::uint8_t { kStays, kOnSurface, kOnLine };

struct Corner {
  Position direction{};  ///< unit normal or unit tangent of a line; before, a sum of normals
  Position move{};
  double lengths = 0;                   ///< sum of those of the summands of `direction`
  double area = 0;                      ///< a third of the area of its triangles
  double volume = 0;                    ///< what its surroundings took, for it to give back
  double wanted = 0;                    ///< what they are to take, where places are known
  double shortest = 0;                  ///< length of its shortest edge on an interface
  std::array<std::uint64_t, 2> line{};  ///< the first two corners that its lines go to
  std::uint32_t group = 0;
  std::uint32_t facets = 0;
  std::uint32_t edges = 0;
  std::uint32_t lines = 0;
  std::uint32_t lines_in_box = 0;
  std::uint8_t sides = 0;  ///< a bit for each side of the box
  bool has_more_groups = false;
  bool is_known = false;
  CornerKind kind = CornerKind::kStays;
};

struct Edge {
  std::array<std::uint64_t, 2> corners{};
  Position normal{};  ///< unit normal of its first triangle
  Position bulge{};   ///< from its middle
  std::uint32_t group = 0;
  std::uint32_t facets = 0;  ///< triangles of interfaces
  std::uint8_t sides = 0;
  bool is_bent = false;  ///< more groups than one, or a sharp bend

  [[nodiscard]] bool is_on_interface() const { return facets > 0; }
  [[nodiscard]] bool is_line() const { return facets != 2 || is_bent || sides != 0; }
};

Vec3 vector_of(const Position& p) {
  return {p[0], p[1], p[2]};
}

Position position_of(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

void add_to(Position& sum, const Vec3& v) {
  for (std::size_t k = 0; k < 3; ++k) sum[k] += v[static_cast<int>(k)];
}

Vec3 no_longer(const Vec3& move, double most) {
  const double length = move.norm();
  return length <= most ? move : move * (most / length);
}

bool is_box_side(Side side) {
  return side != Side::kInterface && side != Side::kOuter;
}

class Curving {
 public:
  Curving(GroupedMesh& mesh, const std::filesystem::path& folder, const CurveRule& rule)
      : mesh_(mesh),
        folder_(folder),
        rule_(rule),
        corners_(folder, mesh.vertex_count()),
        edges_(folder, mesh.node_count() - mesh.vertex_count()) {
    const auto& promises = mesh.header().record.promises;
    is_periodic_ = promises && promises->periodic != 0;
  }

  PagedArray<Position> run() {
    collect_facets();
    each_edge([this](std::uint64_t, const Edge& edge) { count_edge(edge); });
    for (std::uint64_t v = 0; v < corners_.size(); ++v) classify(v);
    each_edge([this](std::uint64_t number, const Edge& edge) { bulge(number, edge); });
    for (std::uint64_t v = 0; v < corners_.size(); ++v) go_back(v);
    if (mesh_.header().interface_place) go_to_known_places();
    for (int round = 0; round < kRounds; ++round) balance();
    return straightened(mesh_, moves(), folder_, rule_.has_straight_parts);
  }

 private:
  template <class Visit>
  void each_facet(Visit visit) {
    std::uint32_t number = 0;
    for (const FacetGroup& group : mesh_.facet_groups()) {
      for (std::uint64_t f = group.facets.begin; f < group.facets.end; ++f) {
        visit(number, group.side, mesh_.facet(f));
      }
      ++number;
    }
  }

  /// Calls visit(number, edge) for each edge on an interface.
  template <class Visit>
  void each_edge(Visit visit) {
    for (std::uint64_t number = 0; number < edges_.size(); ++number) {
      if (const Edge edge = edges_.get(number); edge.is_on_interface()) visit(number, edge);
    }
  }

  [[nodiscard]] Vec3 place(std::uint64_t row) { return vector_of(mesh_.node(row)); }
  [[nodiscard]] std::uint64_t edge_of(std::uint64_t middle) const {
    return middle - mesh_.vertex_count();
  }

  void collect_facets() {
    each_facet([this](std::uint32_t group, Side side, const Facet& facet) {
      if (is_box_side(side)) {
        add_box_facet(side, facet);
      } else {
        add_interface_facet(group, facet);
      }
    });
  }

  void add_box_facet(Side side, const Facet& facet) {
    const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(side));
    for (const std::uint64_t row : facet.rows) {
      corners_.change(row, [bit](Corner& corner) { corner.sides |= bit; });
    }
    for (const std::uint64_t middle : mesh_.facet_middles(facet)) {
      edges_.change(edge_of(middle), [bit](Edge& edge) { edge.sides |= bit; });
    }
  }

  void add_interface_facet(std::uint32_t group, const Facet& facet) {
    const std::array<Vec3, 3> at{place(facet.rows[0]), place(facet.rows[1]), place(facet.rows[2])};
    const std::array<std::uint64_t, 3> middles = mesh_.facet_middles(facet);
    const Vec3 normal = (at[1] - at[0]).cross(at[2] - at[0]);
    const double length = normal.norm();
    for (std::size_t i = 0; i < 3; ++i) {
      const double weight =
          1 / ((at[(i + 1) % 3] - at[i]).squaredNorm() * (at[(i + 2) % 3] - at[i]).squaredNorm());
      corners_.change(facet.rows[i], [&](Corner& corner) {
        if (corner.facets++ == 0) corner.group = group;
        corner.has_more_groups = corner.has_more_groups || corner.group != group;
        corner.area += length / 6;
        corner.lengths += length * weight;
        add_to(corner.direction, normal * weight);
      });
      edges_.change(edge_of(middles[i]), [&](Edge& edge) {
        const Vec3 unit = normal / length;
        if (edge.facets++ == 0) {
          edge.corners = {facet.rows[i], facet.rows[(i + 1) % 3]};
          edge.group = group;
          edge.normal = position_of(unit);
        } else {
          edge.is_bent =
              edge.is_bent || edge.group != group || unit.dot(vector_of(edge.normal)) < kLineCosine;
        }
      });
    }
  }

  void count_edge(const Edge& edge) {
    const auto [a, b] = edge.corners;
    const double length = (place(b) - place(a)).norm();
    for (std::size_t end = 0; end < 2; ++end) {
      corners_.change(edge.corners[end], [&](Corner& corner) {
        if (corner.edges++ == 0 || length < corner.shortest) corner.shortest = length;
        if (!edge.is_line()) return;
        if (edge.sides != 0) ++corner.lines_in_box;
        if (corner.lines < 2) corner.line[corner.lines] = edge.corners[1 - end];
        ++corner.lines;
      });
    }
  }

  /// Decides what may become of a corner, and in what direction.
  void classify(std::uint64_t v) {
    const Corner corner = corners_.get(v);
    if (corner.facets == 0) return;
    CornerKind kind = CornerKind::kStays;
    Vec3 direction = vector_of(corner.direction);
    if (is_on_surface(corner)) {
      kind = CornerKind::kOnSurface;
      direction.normalize();
    } else if (may_follow_line(corner)) {
      const Vec3 before = place(v) - place(corner.line[0]),
                 after = place(corner.line[1]) - place(v);
      const double one = before.norm(), other = after.norm();
      if (before.dot(after) >= kLineCosine * one * other) {
        // This is the tangent of the circle through the three corners.
        kind = CornerKind::kOnLine;
        direction = (before * (other / one) + after * (one / other)).normalized();
      }
    }
    corners_.change(v, [&](Corner& c) {
      c.kind = kind;
      c.direction = position_of(direction);
    });
  }

  /// True inside of one interface, where its triangles lie all around the corner.
  [[nodiscard]] static bool is_on_surface(const Corner& corner) {
    return corner.lines == 0 && corner.sides == 0 && !corner.has_more_groups &&
           corner.edges == corner.facets &&
           vector_of(corner.direction).norm() >= kLeastAgreement * corner.lengths;
  }

  /// True where one line goes through the corner, which is in no side of the box or stays in one.
  [[nodiscard]] bool may_follow_line(const Corner& corner) const {
    if (corner.lines != 2) return false;
    if (corner.sides == 0) return true;
    return std::has_single_bit(corner.sides) && corner.lines_in_box == 2 && !is_periodic_;
  }

  void bulge(std::uint64_t number, const Edge& edge) {
    const Vec3 out = edge.is_line() ? bulge_of_line(edge) : bulge_of_surface(edge);
    const double length = (place(edge.corners[1]) - place(edge.corners[0])).norm();
    if (!(out.norm() <= kMaxBulge * length)) return;
    edges_.change(number, [&](Edge& e) { e.bulge = position_of(out); });
    for (const std::uint64_t v : edge.corners) {
      corners_.change(v, [&](Corner& corner) {
        const bool counts = edge.is_line() ? corner.kind == CornerKind::kOnLine
                                           : corner.kind == CornerKind::kOnSurface;
        if (counts) add_to(corner.move, -out);
      });
    }
  }

  /// Returns the mean of the bulges that the normals at both ends tell.  The end of a parabola lies
  /// four times as far from the tangent plane at its beginning as its middle from the chord's.
  [[nodiscard]] Vec3 bulge_of_surface(const Edge& edge) {
    const Vec3 chord = place(edge.corners[1]) - place(edge.corners[0]);
    Vec3 normals = Vec3::Zero();
    double height = 0;
    int ends = 0;
    for (std::size_t end = 0; end < 2; ++end) {
      const Corner corner = corners_.get(edge.corners[end]);
      if (corner.kind != CornerKind::kOnSurface) continue;
      const Vec3 normal = vector_of(corner.direction);
      height += (end == 0 ? -0.25 : 0.25) * chord.dot(normal);
      normals += normal;
      ++ends;
    }
    if (ends == 0 || normals.norm() < kLeastAgreement) return Vec3::Zero();
    return normals.normalized() * (height / ends);
  }

  [[nodiscard]] Vec3 bulge_of_line(const Edge& edge) {
    if (edge.sides != 0 && is_periodic_) return Vec3::Zero();
    const Vec3 chord = place(edge.corners[1]) - place(edge.corners[0]);
    Vec3 out = Vec3::Zero();
    int ends = 0;
    for (std::size_t end = 0; end < 2; ++end) {
      const Corner corner = corners_.get(edge.corners[end]);
      if (corner.kind != CornerKind::kOnLine) continue;
      const Vec3 tangent = vector_of(corner.direction);
      const Vec3 across = chord - chord.dot(tangent) * tangent;
      out += (end == 0 ? -0.25 : 0.25) * across;
      ++ends;
    }
    return ends == 0 ? out : out / ends;
  }

  /// Turns the sum of bulges into a move by their mean.
  void go_back(std::uint64_t v) {
    const Corner corner = corners_.get(v);
    if (corner.kind == CornerKind::kStays) return;
    Vec3 move =
        vector_of(corner.move) / (corner.kind == CornerKind::kOnLine ? corner.lines : corner.edges);
    const Vec3 direction = vector_of(corner.direction);
    if (corner.kind == CornerKind::kOnSurface) move = move.dot(direction) * direction;
    corners_.change(v, [&](Corner& c) { c.move = position_of(within(move, c)); });
  }

  /// Moves corners and middles of edges inside of an interface to where that is known to lie.
  void go_to_known_places() {
    for (std::uint64_t v = 0; v < corners_.size(); ++v) {
      const Corner corner = corners_.get(v);
      if (corner.facets == 0) continue;
      const auto found =
          corner.kind == CornerKind::kOnSurface ? known_move(place(v), corner.group) : std::nullopt;
      corners_.change(v, [&](Corner& c) {
        if (found) c.move = position_of(within(*found, c));
        c.is_known = found.has_value();
      });
    }
    each_edge([this](std::uint64_t number, const Edge& edge) {
      if (edge.is_line()) return;
      const auto [a, b] = edge.corners;
      const Vec3 middle = 0.5 * (place(a) + place(b)) + middle_move(edge);
      const auto found = known_move(middle, edge.group);
      if (!found) return;
      const Vec3 bulge = vector_of(edge.bulge) + *found;
      if (!(bulge.norm() <= kMaxBulge * (place(b) - place(a)).norm())) return;
      edges_.change(number, [&](Edge& e) { e.bulge = position_of(bulge); });
    });
    each_facet([this](std::uint32_t group, Side side, const Facet& facet) {
      if (!is_box_side(side)) want_volume(group, facet);
    });
  }

  /// Returns how far the interface of a group is known to be from a place.
  [[nodiscard]] std::optional<Vec3> known_move(const Vec3& from, std::uint32_t group) {
    const FacetGroup sides = mesh_.facet_groups()[group];
    if (sides.second == kExterior) return std::nullopt;
    const LabelTable& table = mesh_.table();
    const auto found = mesh_.header().interface_place(position_of(from), table.raw(sides.first),
                                                      table.raw(sides.second));
    if (!found) return std::nullopt;
    return Vec3(vector_of(*found) - from);
  }

  [[nodiscard]] Vec3 within(const Vec3& move, const Corner& corner) const {
    return no_longer(move, std::min(kMaxMove * corner.shortest, rule_.most_move));
  }

  /// Moves corners so that each gives back the volume that its surroundings took beyond what is
  /// wanted.
  void balance() {
    each_facet([this](std::uint32_t, Side side, const Facet& facet) {
      if (!is_box_side(side)) take_volume(facet);
    });
    for (std::uint64_t v = 0; v < corners_.size(); ++v) {
      const Corner corner = corners_.get(v);
      if (corner.kind != CornerKind::kOnSurface) continue;
      const Vec3 back =
          vector_of(corner.direction) * ((corner.volume - corner.wanted) / corner.area);
      corners_.change(v, [&](Corner& c) {
        c.volume = 0;
        c.move = position_of(within(vector_of(c.move) - back, c));
      });
    }
  }

  /// Returns a triangle of an interface as it is, and as it becomes.
  [[nodiscard]] std::array<QuadraticTriangle, 2> before_and_after(const Facet& facet) {
    const std::array<std::uint64_t, 3> middles = mesh_.facet_middles(facet);
    QuadraticTriangle from, to;
    for (std::size_t i = 0; i < 3; ++i) {
      from[i] = place(facet.rows[i]);
      from[3 + i] = place(middles[i]);
      to[i] = from[i] + vector_of(corners_.get(facet.rows[i]).move);
      to[3 + i] = from[3 + i] + middle_move(edges_.get(edge_of(middles[i])));
    }
    return {from, to};
  }

  /// Notes the volumes up to the interface through known places: those of the nodes, which are
  /// there, and that of the triangle's middle, to which it bulges (27 times the product of the
  /// three hat functions, whose mean is 9 / 20).
  void want_volume(std::uint32_t group, const Facet& facet) {
    const auto [from, to] = before_and_after(facet);
    std::array<double, 3> volumes = swept_volumes(from, to);
    const Vec3 middle = (4.0 * (to[3] + to[4] + to[5]) - to[0] - to[1] - to[2]) / 9;
    const Vec3 normal = (to[1] - to[0]).cross(to[2] - to[0]);
    const Vec3 bulge = known_move(middle, group).value_or(Vec3::Zero());
    for (std::size_t i = 0; i < 3; ++i) {
      volumes[i] += 0.5 * normal.dot(bulge) * (9.0 / 20) / 3;
      if (!corners_.get(facet.rows[i]).is_known) volumes[i] = 0;
    }
    hand_on(facet, volumes);
    for (std::size_t i = 0; i < 3; ++i) {
      corners_.change(facet.rows[i], [&](Corner& corner) { corner.wanted += volumes[i]; });
    }
  }

  void take_volume(const Facet& facet) {
    const auto [from, to] = before_and_after(facet);
    std::array<double, 3> volumes =
        rule_.has_straight_parts ? swept_part_volumes(from, to) : swept_volumes(from, to);
    hand_on(facet, volumes);
    for (std::size_t i = 0; i < 3; ++i) {
      corners_.change(facet.rows[i], [&](Corner& corner) { corner.volume += volumes[i]; });
    }
  }

  /// Corners that may move take over what the others cannot give back.
  void hand_on(const Facet& facet, std::array<double, 3>& volumes) {
    std::array<bool, 3> may_move{};
    double rest = 0;
    int takers = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      may_move[i] = corners_.get(facet.rows[i]).kind == CornerKind::kOnSurface;
      takers += may_move[i] ? 1 : 0;
      if (!may_move[i]) rest += volumes[i];
    }
    if (takers == 0) return;
    for (std::size_t i = 0; i < 3; ++i) {
      if (may_move[i]) volumes[i] += rest / takers;
    }
  }

  /// How far the middle of an interface's edge goes.
  [[nodiscard]] Vec3 middle_move(const Edge& edge) {
    const Vec3 one = vector_of(corners_.get(edge.corners[0]).move);
    const Vec3 other = vector_of(corners_.get(edge.corners[1]).move);
    return no_longer(0.5 * (one + other) + vector_of(edge.bulge), rule_.most_move);
  }

  /// Returns the moves by node; middles of edges on no interface follow from their corners.
  [[nodiscard]] PagedArray<NodeMove> moves() {
    PagedArray<NodeMove> out(folder_, mesh_.node_count());
    for (std::uint64_t v = 0; v < corners_.size(); ++v) {
      const Position move = corners_.get(v).move;
      if (move != Position{}) out.change(v, [&](NodeMove& node) { node = {.move = move}; });
    }
    each_edge([&](std::uint64_t number, const Edge& edge) {
      const Position move = position_of(middle_move(edge));
      out.change(mesh_.vertex_count() + number,
                 [&](NodeMove& node) { node = {.move = move, .has_own = true}; });
    });
    return out;
  }

  GroupedMesh& mesh_;
  std::filesystem::path folder_;
  CurveRule rule_;
  PagedArray<Corner> corners_;
  PagedArray<Edge> edges_;
  bool is_periodic_ = false;
};

}  // namespace

PagedArray<Position> curve_nodes(GroupedMesh& mesh, const std::filesystem::path& folder,
                                 const CurveRule& rule) {
  return Curving(mesh, folder, rule).run();
}

}  // namespace mw::io
