// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reconnection: edge removal (3-2, 4-4 and up), also across an interface or the box.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernels/distance/distance_guard.h"
#include "kernels/inner/inner_demand.h"
#include "kernels/mesh/tet_mesh.h"
#include "kernels/size/edge_limits.h"
#include "kernels/topology/edge_ring.h"

namespace mw {

/// Flips that lower the shape energy of the tets they replace (kernels/quality/quality.h).
///
/// Inside a label all tets involved bear one label and the new ones fill exactly the same region
/// (each is exactly positive), so every label stays the same point set.
///
/// Across an interface, or on the box, the edge (p, q) lies on a surface with one label A on one
/// side and one label B, or the exterior, on the other; its two surface triangles (p, q, a) and
/// (p, q, b) become (a, b, p) and (a, b, q).  The ball around the edge is cut by a disc before and
/// after, with the same rim: a homeomorphism that fixes all outside carries one to the other, so
/// labels, interfaces and meetings of labels keep their topology (KeptTopology::kInterfaces needs
/// no further test).  Triangles on the box stay in their plane, and a guard keeps the distance
/// bound on interfaces.
///
/// On one side there may be a single tet, a cap (p, q, a, b).  Flattened as far as its shape may
/// get, it holds the interface in a bend.  It goes if all tets at its edge (a, b) have its label:
/// then the interface runs from (p, q, a) and (p, q, b) to its other two triangles.  Around (a, b)
/// there is nothing else of the interface, so again one disc takes the place of another.
///
/// A dimple is all that its label has at a vertex v: up to four tets, which share no edge but those
/// at v.  Given to the other label, they leave v inside it, and the interface runs across from v,
/// one disc for another: there the dimple's own label goes on, also around edges between its tets.
///
/// Vertices may be fixed, because a flip moves none; it only needs a closed ring of loaded tets.
///
/// A flip must gain at least kMinGain: the same tet listed in another order has a radius ratio
/// that differs in the last bits, and a gain of that size would flip back and forth for ever.
///
/// Rings of six and seven are left out: only 94 of 151,000 tries succeeded on EM 64^3, but 26,600
/// of 297,000 on rings of three to five.  Without them, and with a limit to the search, flips take
/// 29 % fewer instructions on EM 40^3.
///
/// There is no 2-3 flip: three tets for two hardly ever have less energy (0 of 440,000 tries on
/// EM), and edge removal makes the same meshes.
class Flipper {
 public:
  /// guard keeps the distance bound; null means no bound.
  Flipper(TetMesh& mesh, const Metric& metric, double quality_floor, DistanceGuard* guard = nullptr,
          const TetDemands& demands = {})
      : mesh_(mesh),
        metric_(metric),
        quality_floor_(quality_floor),
        guard_(guard),
        limits_(EdgeLimits::of_moves(mesh, metric, demands.sizes)),
        inner_(mesh, demands.inner) {}

  /// Replaces the ring of edge (p, q) by the best triangulation of the ring's polygon, joined to
  /// both ends (dynamic programming over at most kMaxRing vertices), if that gains.  On a surface
  /// the polygon is cut in two by the new edge (a, b); a cap is left to flip_surface(), which
  /// is told what the surface loses.
  bool remove_edge(LocalVertex p, LocalVertex q);

  /// Flips an edge between two labels of the volume when shapes and surface together gain.
  /// `surface_gain` is what the surface gains, in units of the shape energy.  REQUIRES: a guard.
  bool flip_surface(LocalVertex p, LocalVertex q, double surface_gain);

  /// Returns the tets of a dimple at v that may be flipped; none where there is no such dimple.
  /// The span is valid until the next call.
  /// REQUIRES: v free, between two labels, off the box; fan has its interface triangles, of which
  /// each edge at v has two.
  [[nodiscard]] std::span<const LinkTriangle> find_dimple(LocalVertex v,
                                                          std::span<const FanTriangle> fan);
  /// Gives the dimple that was found last to the other label.  REQUIRES: as find_dimple().
  bool flip_dimple(LocalVertex v, std::span<const FanTriangle> fan);

 private:
  static constexpr std::size_t kMaxRing = 5;
  static constexpr std::size_t kMaxSurfaceRing = 8;
  static constexpr std::size_t kMostInDimple = 4;  ///< see bench/parameters.md, "Constants"
  static constexpr double kMinGain = 1e-2;

  /// Ring vertices first .. last, a polygon of one label; last may be as for ring_vertex().  That
  /// of a cap is an edge.
  struct Polygon {
    std::size_t first = 0;
    std::size_t last = 0;
    Label label = 0;
    [[nodiscard]] bool is_cap() const { return last - first == 1; }
  };

  /// A triangle of ring vertices that may be part of the polygon's best triangulation.
  struct Tried {
    std::size_t i = 0, j = 0, k = 0;
    double energy = 0.0;  ///< of its tets and those of the best triangulations beside it
  };

  [[nodiscard]] bool collect_polygons(LocalVertex p, LocalVertex q, std::size_t max_ring);
  [[nodiscard]] bool cut_into_polygons();
  [[nodiscard]] bool has_cap() const;
  [[nodiscard]] bool has_only(LocalVertex p, LocalVertex q, Label label);
  [[nodiscard]] bool goes_on_beyond(LocalVertex v, const LinkTriangle& t);
  [[nodiscard]] bool surface_allows(LocalVertex p, LocalVertex q);
  /// REQUIRES: i is at most the ring's size, which stands for vertex 0.
  [[nodiscard]] LocalVertex ring_vertex(std::size_t i) const {
    return ring_.vertices[i == ring_.size() ? 0 : i];
  }
  [[nodiscard]] double energy_of_old_tets(double decent);
  /// Rings of less energy are not worth a search: of 5,900 that were replaced on EM 40^3, none had
  /// less than 1.32 for each new tet.
  [[nodiscard]] double min_energy_worth_trying() const;
  void add_energies(LocalVertex p, LocalVertex q);
  /// Returns the least energy of new tets for the polygon; infinite unless below `limit`.
  [[nodiscard]] double best_triangulation(LocalVertex p, LocalVertex q, const Polygon& polygon,
                                          double limit);
  bool collect_triangles(LocalVertex p, LocalVertex q, const Polygon& polygon);
  [[nodiscard]] bool is_between_labels() const;
  /// Looks for new tets that cost less than `budget`, and puts them in.
  bool replace_within(LocalVertex p, LocalVertex q, double budget);
  void replace();

  TetMesh& mesh_;
  const Metric& metric_;
  double quality_floor_;
  DistanceGuard* guard_;
  EdgeLimits limits_;
  InnerFilter inner_;
  double min_ = 0.0;  ///< radius ratio that the new tets must reach
  EdgeRing ring_;
  EdgeRing other_ring_;
  std::vector<Polygon> polygons_;
  std::array<std::array<double, kMaxSurfaceRing + 1>, kMaxSurfaceRing + 1> energy_{};
  std::array<std::array<std::size_t, kMaxSurfaceRing + 1>, kMaxSurfaceRing + 1> apex_{};
  std::vector<Tried> tried_;
  std::vector<LocalTet> old_tets_;
  std::vector<LocalTet> new_tets_;
  std::vector<LinkTriangle> dimple_;
};

}  // namespace mw
