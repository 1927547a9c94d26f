// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes and metrics out of bytes, for the kernels.
#pragma once

#include "kernels/core/metric.h"
#include "tests/fuzz/choices.h"
#include "tests/oracle/small_volumes.h"

namespace mw::fuzz {

/// Up to `most` voxels along each axis and 5 labels, each voxel by a byte; or of some kind, by
/// random numbers.
[[nodiscard]] inline audit::test::SmallVolume choose_volume(Choices& choices, std::uint32_t max) {
  using audit::test::VolumeKind;
  const auto edge = [&] { return std::int64_t{1 + choices.below(max)}; };
  const std::int64_t x = edge(), y = edge(), z = edge();
  const std::uint32_t labels = 1 + choices.below(5);
  const std::uint32_t kind = choices.below(1 + audit::test::kVolumeKinds);
  if (kind > 0) {
    std::mt19937 random(choices.below(1 << 16));
    return random_volume_of(random, static_cast<VolumeKind>(kind - 1), {x, y, z}, labels);
  }
  return audit::test::volume_from({x, y, z}, labels,
                                  [&](auto, auto, auto) { return choices.below(labels); });
}

[[nodiscard]] inline Metric choose_metric(Choices& choices) {
  const auto spacing = [&] { return 0.25 * static_cast<double>(1 + choices.below(16)); };
  const double x = spacing(), y = spacing();
  return choices.below(2) == 0 ? Metric() : Metric({x, y, spacing()});
}

}  // namespace mw::fuzz
