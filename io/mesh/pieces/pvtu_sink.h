// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a mesh in pieces, for programs that run on many processes.
#pragma once

#include <filesystem>

#include "io/file/sink/atomic_file.h"
#include "io/file/sink/atomic_folder.h"
#include "io/mesh/mesh_data.h"

namespace mw::io {

/// M.pvtu, which names the files M/M_0000.vtu, M/M_0001.vtu, ... of a folder beside it, a piece of
/// mesh_parts() each.  A piece has its tets and their vertices, both in the order of the mesh, and
///   PointData/GlobalNodeIds   Int64, the vertex's row in the whole mesh: vertices of several
///   pieces
///                             are those with one id
///   CellData/label            as in a .vtu
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

}  // namespace mw::io
