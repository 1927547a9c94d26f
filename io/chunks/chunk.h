// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A piece of a volume that a store keeps, and reads, as one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/volume/decode.h"

namespace mw::io {

/// The voxels of a box as a store has them, unpacked.
struct Chunk {
  std::vector<std::byte> bytes;
  /// Where the voxel box.lo of ChunkSource::load is, in voxels from the first byte.
  std::size_t first = 0;
  /// How many voxels further along x, y and z.
  Index3 strides;
};

/// Where the chunks of a volume come from.  Thread safety: const members may be called from many
/// threads.
class ChunkSource {
 public:
  virtual ~ChunkSource() = default;
  /// What error messages call the store, and one of its chunks (by its number along x, y and z).
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual std::string name_of(Index3 chunk) const = 0;

  /// Unpacks a chunk.  box: its voxels that are in the volume.
  /// ENSURES: empty when the store has none, so that its voxels are the fill value; otherwise every
  /// voxel of box is within bytes (whoever asks checks that again).
  /// ERRORS: mw::Error(kInput) naming the chunk when it is damaged; memory stays bounded by the
  /// size that the chunk must have, whatever its bytes claim.
  [[nodiscard]] virtual std::optional<Chunk> load(Index3 chunk, const Box3& box) const = 0;

  /// The most that load() takes in memory beside what it returns.
  [[nodiscard]] virtual std::uint64_t scratch_bytes() const = 0;
};

}  // namespace mw::io
