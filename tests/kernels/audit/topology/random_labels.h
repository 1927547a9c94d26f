// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels of tets that mean no volume: any tets next to each other may have any.
#pragma once

#include "tests/oracle/small_volumes.h"

namespace mw::audit::test {

/// Runs of tets get a label below `labels` each, or none that is known; the longer the runs, the
/// larger `runs`.
inline void paint_in_runs(std::mt19937& random, std::uint32_t labels, std::uint32_t runs,
                          SmallMesh& mesh) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const bool again = t > 0 && below(random, runs) != 0;
    const Label fresh = below(random, labels + 1);
    mesh.labels[t] = again ? mesh.labels[t - 1] : fresh < labels ? fresh : kUnknown;
  }
}

}  // namespace mw::audit::test
