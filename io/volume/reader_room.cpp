// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/volume/reader_room.h"

#include <algorithm>

namespace mw::io {

int readers_that_fit(const LabelVolume& volume, int wanted, const ReaderRoom& room) {
  const auto most =
      std::clamp<std::uint64_t>(room.memory / 4 / room.each, 1, static_cast<std::uint64_t>(wanted));
  int count = static_cast<int>(most);
  const auto taken = [&] {
    return static_cast<std::uint64_t>(count) * room.each + volume.buffer_bytes(count);
  };
  while (count > 1 && taken() > room.memory / 2) --count;
  return count;
}

}  // namespace mw::io
