// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The digest of a mesh's content, the same for every file the mesh is stored in.
#pragma once

#include <string>

#include "io/file/scratch/external_sort.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/tet_record.h"

namespace mw::io {

/// Takes a mesh as it streams by.  The digest is "sha256:<64 hex digits>" of these bytes, all
/// numbers little-endian:
///   "mwmesh-digest-1"                 15 ASCII characters, no NUL
///   number of vertices, of tets       2 x uint64
///   vertices                          3 x float64 each, sorted by (x, y, z); -0.0 as 0.0
///   tets                              4 x uint64 ranks in ascending order, then uint64 label,
///                                     each; sorted by these five numbers
/// The rank of a vertex is the number of vertices whose position sorts before its own, so vertices
/// at one position share a rank.  The digest does not depend on the order of rows, the orientation
/// of tets, the signedness of labels or the format.
/// Memory: 3 * memory_bytes and 10 MiB; what does not fit waits in temporary files in `folder`,
/// about 50 bytes a vertex and 60 a tet. ERRORS: kInternal when a tet names a vertex that never
/// came; see also ScratchFile.
class DigestSink : public NoSink {
 public:
  static constexpr std::size_t kMemoryBytes = 16 << 20;

  explicit DigestSink(const std::filesystem::path& folder, std::size_t memory_bytes = kMemoryBytes);

  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override {
    return 2 * std::uint64_t{memory_bytes_} + (1 << 20);
  }

  /// Sorts and hashes.  REQUIRES: finished; called once.
  [[nodiscard]] std::string digest();

 private:
  std::filesystem::path folder_;
  std::size_t memory_bytes_;
  std::uint64_t vertices_ = 0;
  std::uint64_t tets_ = 0;
  ExternalSort<4> positions_;  ///< sortable coordinates, row
  PackedRecords<TetRecord> tet_rows_;
};

}  // namespace mw::io
