// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A sink that cuts each tet of a mesh into eight and passes them on.
#pragma once

#include <functional>

#include "io/mesh/grouped/grouped_sink.h"

namespace mw::io {

/// Called for each tet that is written, in the order of the mesh.
using SeeTet = std::function<void(const std::array<Position, 4>& corners, RawLabel label)>;

/// Cuts every tet by the middles of its edges (kernels/quality/halved_tet.h), so that edges are
/// half as long and all surfaces stay where they are.  Vertices keep their rows; behind them come
/// the middles.  The tets come by label, the eight of each one after the other, with the values of
/// the tet that they are parts of.  The record's promises say how often tets were cut.
/// Memory and disk: those of a GroupedSink with kTet10.  REQUIRES: the sink below outlives it.
class HalvedSink : public GroupedSink {
 public:
  HalvedSink(MeshSink& below, const std::filesystem::path& folder, SeeTet see = {});
  [[nodiscard]] std::uint64_t buffer_bytes() const override;

 private:
  MeshSink& below_;
};

}  // namespace mw::io
