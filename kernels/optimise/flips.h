// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reconnection inside one label: edge removal (3-2, 4-4 and up) and 2-3 flips.
#pragma once

#include "kernels/mesh/tet_mesh.h"
#include "kernels/topology/edge_ring.h"

namespace mw {

/// Flips that raise the least radius ratio of the tets they replace.
///
/// They never touch an interface or the box: all tets involved bear one label, and the new ones
/// fill exactly the same region (each is exactly positive), so every label stays the same point
/// set.  Vertices may be fixed: a flip changes no vertex, and a closed ring of loaded tets is all
/// it needs.
///
/// A flip must gain at least kLeastGain: the same tet listed in another order has a radius ratio
/// that differs in the last bits, and a gain of that size would flip back and forth for ever.
class Flipper {
 public:
  Flipper(TetMesh& mesh, const Metric& metric) : mesh_(mesh), metric_(metric) {}

  /// Replaces the ring of edge (p, q) by the best triangulation of the ring's polygon, joined to
  /// both ends (dynamic programming over at most kMaxRing vertices).
  bool remove_edge(LocalVertex p, LocalVertex q);

  /// Replaces the two tets at face (b, c, d) of tet (a, b, c, d) by three around a new edge.
  bool remove_face(LocalVertex a, LocalVertex b, LocalVertex c, LocalVertex d);

 private:
  static constexpr std::size_t kMaxRing = 7;
  static constexpr double kLeastGain = 1e-3;

  [[nodiscard]] double worst_of_ring(LocalVertex p, LocalVertex q) const;
  [[nodiscard]] double triangle_value(LocalVertex p, LocalVertex q, std::size_t i, std::size_t j,
                                      std::size_t k) const;
  [[nodiscard]] double best_triangulation(LocalVertex p, LocalVertex q, double enough);
  bool collect_triangles(LocalVertex p, LocalVertex q, std::size_t i, std::size_t k);
  void replace(const std::vector<LocalTet>& old_tets, const std::vector<LocalTet>& new_tets);

  TetMesh& mesh_;
  const Metric& metric_;
  EdgeRing ring_;
  std::array<std::array<double, kMaxRing>, kMaxRing> value_{};
  std::array<std::array<std::size_t, kMaxRing>, kMaxRing> apex_{};
  std::vector<LocalTet> old_tets_;
  std::vector<LocalTet> new_tets_;
};

}  // namespace mw
