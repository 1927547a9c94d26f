// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cuts each tet of a mesh into eight.
#pragma once

#include <functional>
#include <optional>

#include "io/mesh/scratch_mesh.h"

namespace mw::io {

/// How interfaces become smoother while tets are cut.
struct HalvedCurves {
  double most_move = 0;                ///< no vertex and no middle of an edge moves farther
  std::optional<double> max_distance;  ///< what the record promises of where they come to lie
};

/// Cuts every tet by nodes on its edges (kernels/quality/halved_tet.h), so that edges are half as
/// long, and gives the parts to a sink.  The nodes are the middles of edges, and all surfaces stay
/// where they are; with curves, those of interfaces lie where curve_nodes() places them.  Vertices
/// keep their rows; behind them come the middles.  The tets come by label, the eight of each one
/// after the other, with the values of the tet that they are parts of.  The record's promises say
/// how often tets were cut.  Calls between(), which may throw, often.
/// Memory and disk: those of a GroupedSink with kTet10.
void halve(
    ScratchMesh& mesh, MeshSink& below, const std::optional<HalvedCurves>& curves = {},
    const std::function<void()>& between = [] {});

}  // namespace mw::io
