// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Simplification of a window by edge contraction (Sec 5.2 to 5.4).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/core/parallel_for.h"
#include "kernels/distance/distance_guard.h"
#include "kernels/inner/inner_demand.h"
#include "kernels/mesh/tet_mesh.h"
#include "kernels/topology/kept_topology.h"

namespace mw {

struct SimplifyOptions {
  /// No contraction may create a tet below this radius ratio, unless the tets that it replaces
  /// reach no further (strong anisotropy makes even the start mesh flat).
  double quality_floor = 0.1;
  /// Contractions of an inner vertex keep to this radius ratio instead: they can wait for better
  /// shapes, because inner vertices are few and the shape of everything around depends on them
  /// (bench/parameters.md, "Constants").
  double inner_quality = 0.44;
  /// Bound tau_e on the normalised edge length variance of changed tets, Eq (3); none if not set.
  std::optional<double> edge_variance;
  KeptTopology topology = KeptTopology::kLabels;
  bool keep_smooth = false;  ///< contractions that fold interfaces are refused (BendFilter)
  TetDemands demands;        ///< demands that are met stay met; others may stay unmet
  bool only_short = false;   ///< besides touches, edges that EdgeLimits::is_short() finds short
  /// Boxes that an earlier march has finished.  Edges between vertices whose stars lie in one of
  /// these boxes, and that have not changed in this window, are not looked at.
  std::vector<LatticeBox> finished;
  /// Contraction ends when no more than this many vertices, fixed ones included, are left.
  std::size_t enough_vertices = 0;
  /// Runs the loop over all vertices that fills the queue (4 to 5 % of the time in the benchmark).
  /// The result is the same for any number of threads in it.
  ParallelFor seeding = serial_for;
};

/// How many candidates were tried and contracted, and how many fell for each reason.
struct SimplifyStats {
  std::uint64_t tried = 0;
  std::uint64_t contracted = 0;
  std::uint64_t inverted = 0;
  std::uint64_t low_quality = 0;
  std::uint64_t too_long = 0;
  std::uint64_t no_inner = 0;  ///< tets would lose their last inner vertex
  std::uint64_t topology = 0;
  std::uint64_t folded = 0;
  std::uint64_t distance = 0;

  SimplifyStats& operator+=(const SimplifyStats& other);
};

/// Contracts edges with both ends free until none that passes the filters costs less than the last
/// bound of VertexQueue.  Where shapes refuse the planned place, other_positions() are tried,
/// except with options.edge_variance, the paper's filter, which goes with the paper's place.  Where
/// sizes are asked and enough_vertices is 0, a second pass contracts much shorter edges, also of
/// inner vertices, down to quality_floor.  In both, lines of three labels come before costs, up to
/// the limits that moves have: touches (kernels/surface/line_edges.h) are contracted first, also at
/// positions_around(), so that lines do not fork, and edges of lines that are still short at the
/// end; vertices that these contractions changed are not asked for cheaper edges once more.  guard
/// keeps the distance bound; null means no bound. ENSURES: all tets strictly positive (exactly),
/// options.topology kept, box kept, fixed vertices
///          untouched; the result depends on the mesh's content only.
SimplifyStats simplify(TetMesh& mesh, const Metric& metric, const SimplifyOptions& options,
                       DistanceGuard* guard = nullptr);

}  // namespace mw
