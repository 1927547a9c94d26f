// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes meshes in pieces (.pvtu files), for programs that run on many processes.
// Format: https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html
#pragma once

#include <filesystem>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Returns the rows of the tets of each piece, ascending.  Boxes around the barycentres are halved
/// again and again across their longest side, so pieces are compact; their numbers of tets differ
/// by at most one.  The result depends on the mesh and the number of pieces alone: ties go by row.
/// REQUIRES: 1 <= pieces <= tets.  Memory: 40 bytes a tet.  Cost: O(tets log pieces).
[[nodiscard]] std::vector<std::vector<std::uint64_t>> mesh_parts(const MeshData& mesh,
                                                                 std::uint64_t pieces);

/// Writes M.pvtu, which names the files M/M_0000.vtu, M/M_0001.vtu, ... of a folder beside it; each
/// holds a piece of mesh_parts().  A piece has its tets and their vertices, both in the order of
/// the mesh, and
///   PointData/GlobalNodeIds   Int64, the vertex's row in the whole mesh: a vertex has one id in
///                             all of its pieces
///   CellData/label            as in a .vtu, and values beside it
/// The folder gets its name first, then M.pvtu; a kill in between leaves the folder.
/// Memory: the mesh, and 40 bytes a tet.  ERRORS: see AtomicFile, AtomicFolder; mw::Error(kUsage)
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

/// Returns the files of the pieces that a .pvtu names, in order.
/// ERRORS: mw::Error(kInput) for a file that names none, or pieces that overlap.
[[nodiscard]] std::vector<std::filesystem::path> piece_files(const std::filesystem::path& path);

/// Reads the .vtu files that a .pvtu names, in its folder or below, and puts them together:
/// vertices by ascending PointData/GlobalNodeIds, tets piece by piece, names of labels from all.  A
/// single piece needs no ids.  What PvtuSink wrote comes back as the mesh; only the order of tets
/// may differ, and the record is not kept.
/// Values that a piece does not have are NaN there.
/// Memory: the mesh, and 24 bytes a vertex of a piece.
/// ERRORS: those of read_vtu(); mw::Error(kInput) for pieces that overlap (ghost cells), without
/// ids, or with tets of ten nodes, and for an id at two places.
[[nodiscard]] MeshData read_pvtu(const std::filesystem::path& path);

}  // namespace mw::io
