// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into an ASCII MEDIT .mesh file.
#pragma once

#include <filesystem>
#include <string>

#include "io/file/atomic_file.h"
#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// Coordinates are printed with the fewest digits that give back the same double; the reference of
/// a tet is its label, of a vertex 0; rows count from 1.
class MeditSink : public MeshSink {
 public:
  explicit MeditSink(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void finish() override;

 private:
  void begin_tets();

  std::string name_;
  AtomicFile file_;
  MeshHeader header_;
  std::uint64_t vertices_ = 0;
  std::uint64_t tets_ = 0;
  bool tets_begun_ = false;
};

}  // namespace mw::io
