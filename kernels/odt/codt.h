// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Constrained optimal Delaunay triangulation of a window (Sec 5.5), and the vertex moves of its
// sweeps.
#pragma once

#include "kernels/distance/carried_samples.h"
#include "kernels/mesh/tet_mesh.h"
#include "kernels/odt/replacement.h"
#include "kernels/odt/triangulation.h"

namespace mw {

/// Ids with this bit are those of vertices that a window made; voxel corners have smaller ones.
constexpr int kSteinerBit = 63;
/// Ids have 0 from here to kSteinerBit, except in grids that tell copies of a vertex apart there.
constexpr int kCopyBits = 57;

/// Ids that a window may give to Steiner points.  No two windows of a march share one.
struct SteinerIds {
  VertexId first = 0;
  std::uint64_t count = 0;
};

/// Range of ids of window number `window` among `windows`.  REQUIRES: window < windows <= 2^51.
[[nodiscard]] SteinerIds steiner_ids(std::uint64_t window, std::uint64_t windows);

struct CodtOptions {
  int iterations = 10;     ///< the most iterations; the paper's number
  double min_gain = 2e-3;  ///< iteration ends when the ODT energy falls by less than this share
  double quality_floor = 0.0;
  SteinerIds ids;
};

struct CodtStats {
  std::uint64_t windows = 0;
  std::uint64_t iterations = 0;
  std::uint64_t moves = 0;
  std::uint64_t added = 0;      ///< Steiner points
  std::uint64_t fallbacks = 0;  ///< windows that stopped because a triangulation failed
  ReplacementStats replaced;

  CodtStats& operator+=(const CodtStats& other);
};

/// What ODT minimises, up to a factor: the sum over tets of volume times the sum of squared edges.
/// (The mean radius ratio is no guide, because after local optimisation it falls at first.)
[[nodiscard]] double odt_energy(const TetMesh& mesh, const Metric& metric);

/// Iterates vertex moves (sweep_odt()) and constrained Delaunay reconnection (replacement.h).
/// Steiner points become vertices inside their label.  They get the point quadric that such
/// vertices have from the start (Eq (2)), and ids of the window in the triangulation's order.
/// REQUIRES: `samples` are carried by the mesh; box as the mesh was made with; no vertex of the
///           volume has one of the ids.
/// ENSURES: as optimise(), but rows may change: vertices that no tet uses are gone, samples follow.
CodtStats codt(TetMesh& mesh, CarriedSamples& samples, Point box, const Metric& metric,
               const CodtOptions& options, const Triangulate& triangulate);

/// Moves each free vertex inside a label, in ascending order, to the mean of the circumcentres of
/// its tets, weighted by volume (Chen and Holst, Efficient mesh optimization schemes based on
/// optimal Delaunay triangulations, 2011).  All other vertices stay, which makes it "constrained".
/// A step that would make a tet non-positive, or the worst tet of the star worse and worse than the
/// floor, is halved up to three times, then left out.
/// ENSURES: as optimise(); returns how many vertices moved.
std::uint64_t odt_sweep(TetMesh& mesh, const Metric& metric, double quality_floor);

}  // namespace mw
