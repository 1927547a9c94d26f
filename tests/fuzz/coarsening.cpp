// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Coarsening of labels keeps their topology, by the oracle, and is done once.
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/small_inputs.h"
#include "tests/kernels/start/coarsen/coarse_volume.h"

namespace mw::fuzz {

void fuzz_coarsen(Bytes bytes) {
  Choices choices(bytes);
  const double bound = 0.1 * static_cast<double>(5 + choices.below(40));
  const test::SmallVolume volume = choose_volume(choices, 6);
  const test::SmallVolume coarse = test::coarsened(volume, bound);
  if (coarse.labels == volume.labels) return;
  require(test::betti(coarse) == test::betti(volume), "Betti numbers stay");
  require(test::coarsened(volume, bound).labels == coarse.labels, "the same labels each time");
}

}  // namespace mw::fuzz
