// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How many readers of a volume there is room for.
#pragma once

#include <cstdint>

#include "io/volume/label_volume.h"

namespace mw::io {

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

}  // namespace mw::io
