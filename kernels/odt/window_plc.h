// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The window's mesh as a constrained Delaunay triangulation sees it (Sec 5.5).
#pragma once

#include "kernels/mesh/tet_mesh.h"
#include "kernels/odt/triangulation.h"

namespace mw {

/// The tets of a window and their regions: sets of tets of one label connected by triangles.
struct RegionTets {
  std::vector<LocalTet> tets;          ///< positive
  std::vector<std::uint32_t> regions;  ///< region of each tet
  std::vector<Label> labels;           ///< label of each region
};

/// Converts lattice points to those of a Plc and back.
class PlcFrame {
 public:
  PlcFrame(Point lower_corner, const Metric& metric)
      : lower_(lower_corner), scale_(metric.voxel()) {}

  [[nodiscard]] PlcPoint to_plc(Point p) const;
  /// Returns the nearest lattice point, or nothing when it is farther than a tet can reach.
  [[nodiscard]] std::optional<Point> to_lattice(const PlcPoint& p) const;

 private:
  Point lower_;
  Vec3 scale_;
};

struct WindowPlc {
  RegionTets content;
  PlcFrame frame;
  Plc plc;  ///< points are the rows of the mesh, seeds are numbered as regions
};

/// Facets are the triangles between labels and those with one loaded tet: the window's hull and the
/// volume's box.  (The paper fixes all tets at the hull; a vertex must stay where its star is not
/// whole, but tets between such vertices are the window's own.)
/// REQUIRES: all vertices alive.
[[nodiscard]] WindowPlc window_plc(const TetMesh& mesh, const Metric& metric);

}  // namespace mw
