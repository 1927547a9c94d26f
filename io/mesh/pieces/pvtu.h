// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh in pieces, for programs that run on many processes: .pvtu files, in and out.
#pragma once

#include <filesystem>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Rows of tets by piece, ascending.  Boxes around the barycentres are halved again and again
/// across their longest side, so pieces are compact; they have as many tets as each other, give or
/// take one.  A function of the mesh and the number: ties go by row. REQUIRES: 1 <= pieces <= tets.
/// Memory: 40 bytes a tet.  Cost: O(tets log pieces).
[[nodiscard]] std::vector<std::vector<std::uint64_t>> mesh_parts(const MeshData& mesh,
                                                                 std::uint64_t pieces);

/// M.pvtu, which names the files M/M_0000.vtu, M/M_0001.vtu, ... of a folder beside it, a piece of
/// mesh_parts() each.  A piece has its tets and their vertices, both in the order of the mesh, and
///   PointData/GlobalNodeIds   Int64, the vertex's row in the whole mesh: vertices of several
///   pieces
///                             are those with one id
///   CellData/label            as in a .vtu, and values beside it
/// The folder gets its name first, then M.pvtu; a kill in between leaves the folder.
/// Memory: the mesh, and 40 bytes a tet.  ERRORS: as AtomicFile and AtomicFolder; mw::Error(kUsage)
/// for more pieces than tets.
class PvtuSink : public MeshDataSink {
 public:
  /// REQUIRES: pieces >= 1.
  PvtuSink(const std::filesystem::path& path, std::uint64_t pieces);

  void begin(const MeshHeader& header) override;
  void finish() override;

 private:
  void write_piece(std::uint64_t number, std::span<const std::uint64_t> tets);

  std::string name_;
  std::uint64_t pieces_;
  MeshHeader header_;
  AtomicFile index_;
  AtomicFolder folder_;
  std::string stem_;
};

/// The .vtu files that a .pvtu names, in its folder or below, put together: vertices by ascending
/// PointData/GlobalNodeIds, tets piece by piece, names of labels from all.  A single piece needs no
/// ids.  What PvtuSink wrote comes back as the mesh; only the order of tets may differ.
/// Values that a piece does not have are NaN there.
/// Memory: the mesh, and 24 bytes a vertex of a piece.
/// ERRORS: mw::Error(kInput) with file and place as read_vtu(); for pieces that overlap (ghost
/// cells), without ids, or with tets of ten nodes, and for an id at two places.
[[nodiscard]] MeshData read_pvtu(const std::filesystem::path& path);

}  // namespace mw::io
