// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Makes curved tets of their straight parts again.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "io/mesh/kept_rows.h"
#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// The places of the middles of kTetEdges.
using SixPlaces = std::array<Position, 6>;

/// Takes a mesh of parts (MeshHeader::in_parts) and gives it back as tets of ten nodes.
/// Memory: 16 MiB, and a quarter of a byte for each vertex.  Disk: 24 bytes a vertex, 88 a tet of
/// ten nodes and 8 for each of its values.  ERRORS: see ScratchFile.
class CurvedParts {
 public:
  /// values is how many numbers each tet has.
  CurvedParts(const std::filesystem::path& folder, std::size_t values);

  void add_vertices(std::span<const Position> positions);
  void add(std::span<const TetRows> parts, std::span<const RawLabel> labels);
  /// Takes the numbers of the parts that add() was given last.
  void add_values(std::span<const double> rows);

  /// Writes corners, and the tets between them with their labels and values, to a sink, without its
  /// begin() and finish().  ERRORS: kInput when a part names a vertex that never came.
  /// REQUIRES: called once; the parts of each tet are there.
  void join(MeshSink& sink);
  [[nodiscard]] bool is_joined() const { return is_joined_; }
  /// Returns the middles of a tet, by the order in which the tets came; each of them is on the edge
  /// that it has when its corners are positive.  REQUIRES: joined.
  [[nodiscard]] SixPlaces middles(std::uint64_t tet);

 private:
  struct Tet {
    std::array<std::uint64_t, 10> rows{};
    RawLabel label = 0;
  };

  [[nodiscard]] KeptRows corners();
  void write_corners(const KeptRows& kept, MeshSink& sink);
  void write_tets(const KeptRows& kept, MeshSink& sink);

  PagedFile<Position> vertices_;
  PagedFile<Tet> tets_;
  ScratchFile values_;
  std::size_t columns_;  ///< values of each tet
  std::uint64_t parts_ = 0;
  std::uint64_t batch_ = 0;  ///< parts before those that came last
  Tet next_;
  bool is_joined_ = false;
};

}  // namespace mw::io
