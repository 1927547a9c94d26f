// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A sink that cuts each tet of a mesh into eight and passes them on.
#pragma once

#include <functional>

#include "io/mesh/grouped/grouped_sink.h"

namespace mw::io {

/// How interfaces become smoother while tets are cut.
struct HalvedCurves {
  double most_move = 0;                ///< no vertex and no middle of an edge moves farther
  std::optional<double> max_distance;  ///< what the record promises of where they come to lie
};

/// Cuts every tet by nodes on its edges (kernels/quality/halved_tet.h), so that edges are half as
/// long.  The nodes are the middles of edges, and all surfaces stay where they are; with curves,
/// those of interfaces lie where curve_nodes() places them.  Vertices keep their rows; behind them
/// come the middles.  The tets come by label, the eight of each one after the other, with the
/// values of the tet that they are parts of.  The record's promises say how often tets were cut.
/// Memory and disk: those of a GroupedSink with kTet10.  REQUIRES: the sink below outlives it.
class HalvedSink : public GroupedSink {
 public:
  /// between is called for each batch of tets that is passed on, and may throw.
  HalvedSink(
      MeshSink& below, const std::filesystem::path& folder,
      const std::optional<HalvedCurves>& curves = {}, std::function<void()> between = [] {});
  [[nodiscard]] std::uint64_t buffer_bytes() const override;

 private:
  MeshSink& below_;
};

}  // namespace mw::io
