// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into an ASCII MEDIT .mesh file.
#pragma once

#include <filesystem>
#include <string>

#include "io/file/scratch/scratch_file.h"
#include "io/file/sink/atomic_file.h"
#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// Coordinates are printed with the fewest digits that give back the same double; the reference of
/// a tet is its label, of a vertex 0; rows count from 1.  Names of labels are comments
/// (medit_names.h).  The lines of the tets, which come last in the file, wait in a temporary file
/// in the same folder.
class MeditSink : public MeshSink {
 public:
  explicit MeditSink(const std::filesystem::path& path)
      : name_(path.string()), file_(path), tet_lines_(path.parent_path()) {}

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 2 << 20; }

 private:
  void append_tets();

  std::string name_;
  AtomicFile file_;
  ScratchFile tet_lines_;
  MeshHeader header_;
  std::uint64_t count_at_ = 0;  ///< where the number of vertices goes
  std::uint64_t vertices_ = 0;
  std::uint64_t tets_ = 0;
};

}  // namespace mw::io
