// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether a budget of memory has room for what is unpacked when a volume is read.
#include "engine/job/unpacking.h"

#include "io/file/text_numbers.h"
#include "kernels/core/error.h"

namespace mw::engine {

void check_unpacking(const io::LabelVolume& volume, const ReadingRoom& room) {
  constexpr std::uint64_t kLittle = 4;  // a chunk is little if this many fit into a share
  const std::uint64_t unpacked = volume.buffer_bytes(1);
  if (unpacked == 0) return;  // as of an array, which has no chunks
  if (unpacked < room.memory / room.shares / kLittle) return;
  const std::uint64_t now = room.shares * (room.beside + unpacked);
  if (now <= room.memory) return;
  // Of each byte that is added to the budget, unpacked chunks take a quarter.
  const std::uint64_t least = now + (now - room.memory) / 3;
  throw Error(ErrorKind::kResource,
              io::text("a memory budget of ", io::size_words(room.memory),
                       " is too small to unpack a chunk of the volume; ", io::min_memory(least)));
}

}  // namespace mw::engine
