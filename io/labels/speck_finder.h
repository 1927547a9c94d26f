// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The components of a volume that are smaller than a number of voxels, out of core.
#pragma once

#include <vector>

#include "io/volume/label_volume.h"

namespace mw::io {

/// Components are voxels of one label that are joined by faces, or by faces, edges and corners.
struct SpeckRule {
  /// The most that `least` may be.
  static constexpr std::uint64_t kMax = std::uint64_t{1} << 62;

  std::uint64_t min = 1;  ///< voxels that a component must have to stay, from 1 to kMax
  bool diagonal = false;  ///< 26 neighbours instead of 6
};

/// Voxels of one speck next to each other along x: all of one label.
struct SpeckRun {
  std::int32_t begin = 0;
  std::int32_t end = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  std::uint32_t speck = 0;
};

/// All specks, numbered from 0 on.
struct Specks {
  std::vector<SpeckRun> runs;    ///< ascending by z, y, begin
  std::vector<RawLabel> labels;  ///< by speck
  std::uint64_t memory = 0;      ///< bytes that are enough to find and to settle them
};

/// How a search for specks is bounded; it changes no result.
struct SpeckLimits {
  std::uint64_t memory = 256ULL << 20U;  ///< bytes
  std::int64_t slab_voxels = 1 << 20;    ///< of one read
  bool is_of_budget = false;             ///< memory is a quarter of --memory, as errors will say

  [[nodiscard]] static SpeckLimits of_budget(std::uint64_t budget) {
    return {.memory = budget / kShare, .is_of_budget = true};
  }
  static constexpr std::uint64_t kShare = 4;
};

/// One pass over the volume.  A component is followed as long as planes go on with it: it keeps
/// its runs while it is small, then nothing but the fact that it is not.
/// Memory: 40 bytes a run of specks, and some 60 a run of two planes and 120 a component in them;
/// neither goes above limits.memory.
/// ERRORS: mw::Error(kResource) when it would, with the number of specks and the memory that is
/// enough, or of two planes how much they take at least.
[[nodiscard]] Specks find_specks(const LabelVolume& volume, const SpeckRule& rule,
                                 const SpeckLimits& limits);

/// Throws mw::Error(kResource): there are so many specks, for which so many bytes are enough.
[[noreturn]] void fail_too_many_specks(const SpeckRule& rule, std::uint64_t specks,
                                       const SpeckLimits& limits, std::uint64_t enough);

}  // namespace mw::io
