// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether a budget of memory has room for what is unpacked when a volume is read.
#pragma once

#include <cstdint>

#include "io/volume/label_volume.h"

namespace mw::engine {

/// How much of a memory budget is there to read a volume.
struct ReadingRoom {
  std::uint64_t memory = 0;  ///< bytes, as the user gives them
  std::uint64_t shares = 1;  ///< into which it is divided; one of them reads
  std::uint64_t beside = 0;  ///< bytes of that share which something else holds meanwhile
};

/// Tells before any work that a chunk of the volume takes more to unpack than there is.  A chunk
/// that takes little is left to the job, which knows better what it needs all in all.
/// ERRORS: mw::Error(kResource) with the least budget that works.
void check_unpacking(const io::LabelVolume& volume, const ReadingRoom& room);

}  // namespace mw::engine
