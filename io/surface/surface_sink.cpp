// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Counts of a surface, and the way along its runs.
#include "io/surface/surface_sink.h"

#include "kernels/core/assert.h"

namespace mw::io {

std::uint64_t SurfaceHeader::vertices() const {
  std::uint64_t sum = 0;
  for (const SurfaceShell& shell : shells) sum += shell.vertices;
  return sum;
}

std::uint64_t SurfaceHeader::triangles() const {
  std::uint64_t sum = 0;
  for (const SurfaceShell& shell : shells) {
    for (const SurfaceRun& run : shell.runs) sum += run.triangles;
  }
  return sum;
}

bool RunCursor::next() {
  bool other = !begun_;
  begun_ = true;
  while (run_ == shell().runs.size() || seen_ == run().triangles) {
    seen_ = 0;
    other = true;
    if (run_ < shell().runs.size()) ++run_;
    if (run_ < shell().runs.size()) continue;
    run_ = 0;
    ++shell_;
    MW_ASSERT(shell_ < header_->shells.size());
  }
  ++seen_;
  return other;
}

}  // namespace mw::io
