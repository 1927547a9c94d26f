// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/volume/volume_readers.h"

#include <algorithm>

#include "io/file/text_numbers.h"
#include "kernels/core/error.h"

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

void check_unpacking(const LabelVolume& volume, const ReadingRoom& room) {
  constexpr std::uint64_t kLittle = 4;  // a chunk is little if this many fit into a share
  const std::uint64_t unpacked = volume.buffer_bytes(1);
  if (unpacked == 0) return;  // as of an array, which has no chunks
  if (unpacked < room.memory / room.shares / kLittle) return;
  const std::uint64_t now = room.shares * (room.beside + unpacked);
  if (now <= room.memory) return;
  // Of each byte that is added to the budget, unpacked chunks take a quarter.
  const std::uint64_t least = now + (now - room.memory) / 3;
  throw Error(ErrorKind::kResource,
              text("a memory budget of ", size_words(room.memory),
                   " is too small to unpack a chunk of the volume; ", min_memory(least)));
}

}  // namespace mw::io
