// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promises P1 to P4 and P8 of a mesh of any size, on many threads (`mwmesh verify`).
#pragma once

#include <filesystem>
#include <functional>

#include "engine/verify/mesh_tiles.h"
#include "kernels/audit/audit.h"

namespace mw::engine {

struct VerifyTask {
  audit::AuditOptions options;
  int threads = 1;
  /// How many readers each thread has in the second half, where reading waits for a network; each
  /// of them takes reader_bytes() beside the rest.
  int readers = 1;
  /// What tiles, sorts and buffers may take together.  More is taken where a tile with its
  /// interfaces needs more, and for parts of labels (verify_mesh()).
  std::uint64_t memory_bytes = std::uint64_t{256} << 20U;
  std::filesystem::path folder;           ///< of temporary files
  std::function<void()> between = [] {};  ///< called often, by any thread; may throw
};

/// Returns the bytes that a reader takes of a volume that is far away (io::VolumeInfo::is_far),
/// with what the volume holds for it; 0 for other volumes, which threads read themselves.
[[nodiscard]] std::uint64_t reader_bytes(const io::LabelVolume& volume);

/// Returns how many readers each of `threads` threads has, so that together they are about
/// io::kFarReaders, or fewer where that many take more than `memory` bytes.
[[nodiscard]] int readers_of_thread(int threads, std::uint64_t reader_bytes, std::uint64_t memory);

/// Checks a mesh against its volume.  A thread has no more in memory than a tile of the mesh, and
/// then a tile of the volume with what is near it.
/// Memory: besides, 24 bytes for each part of a label in a tile, and 8 for each other one that it
/// touches; where interfaces are counted, 4 for each part of one that goes on in another tile.
/// ENSURES: the report depends on mesh and volume only, except for distances farther than memory
/// lets it look (DistanceReport::far_samples); sums are rounded in the order of the tiles.
/// ERRORS: kResource when a temporary file cannot be written.
/// REQUIRES: mesh is finished, and of that volume; its tiles are used up.
[[nodiscard]] audit::AuditReport verify_mesh(const io::DenseVolume& volume, MeshTiles& mesh,
                                             const VerifyTask& task);

}  // namespace mw::engine
