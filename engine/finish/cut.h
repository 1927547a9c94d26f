// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Edges of a finished mesh become half as long, once or twice.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "io/mesh/grouped/halved_mesh.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::engine {

struct CutTask {
  int times = 0;
  std::optional<io::HalvedCurves> curves{};  ///< how interfaces move; empty: they stay
};

/// Cuts each tet into eight, as often as the task says.  Calls between(), which may throw, often.
void cut(io::ScratchMesh& mesh, const CutTask& task, const std::function<void()>& between);

/// Returns the most bytes that cut() holds beside the mesh.
[[nodiscard]] std::uint64_t bytes_to_cut();

}  // namespace mw::engine
