// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Several readers of a volume at once: how they borrow a loop, since their caller may bring threads
// and they know none, and how many of them, or what they unpack, there is room for.
#pragma once

#include <cstdint>
#include <functional>

#include "io/volume/label_volume.h"
#include "kernels/core/index.h"

namespace mw::io {

/// Calls visit for each index of an array of this shape, for up to `threads` of them at once.
/// ERRORS: what a visit throws; other visits may then be left out.
using VisitAtOnce =
    std::function<void(int threads, Index3 shape, const std::function<void(Index3 index)>& visit)>;

/// Calls visit for one index after the other, x fastest.
inline void visit_in_turn(int /*threads*/, Index3 shape,
                          const std::function<void(Index3 index)>& visit) {
  for_each_index(shape, visit);
}

/// How many readers wait at once for what is far away (VolumeInfo::is_far), whatever the number of
/// threads that work is.
inline constexpr int kFarReaders = 8;

/// What several readers of a volume may take.
struct ReaderRoom {
  std::uint64_t each = 0;    ///< bytes of a reader, beside what the volume holds
  std::uint64_t memory = 0;  ///< bytes of the budget
};

/// Returns `wanted` readers or fewer, but at least one, where they would take more than a quarter
/// of memory, or more than half with what the volume holds.
[[nodiscard]] int readers_that_fit(const LabelVolume& volume, int wanted, const ReaderRoom& room);

/// How much of a memory budget is there to read a volume.
struct ReadingRoom {
  std::uint64_t memory = 0;  ///< bytes, as the user gives them
  std::uint64_t shares = 1;  ///< into which it is divided; one of them reads
  std::uint64_t beside = 0;  ///< bytes of that share which something else holds meanwhile
};

/// Tells before any work that a chunk of the volume takes more to unpack than there is.  A chunk
/// that takes little is left to the job, which knows better what it needs all in all.
/// ERRORS: mw::Error(kResource) with the least budget that works.
void check_unpacking(const LabelVolume& volume, const ReadingRoom& room);

}  // namespace mw::io
