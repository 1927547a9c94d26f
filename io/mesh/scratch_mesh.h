// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A finished mesh in files without a name, column by column, which passes change and writers read.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// Tets that follow one another, with their labels, and their numbers row by row.
struct TetBatch {
  std::uint64_t first = 0;  ///< the number of the first one in the mesh
  std::span<const TetRows> tets;
  std::span<const RawLabel> labels;
  std::span<const double> values;  ///< as MeshSink::write_values() takes them
};

/// A whole mesh outside of memory.
/// Memory: kBufferBytes.
/// Disk: 24 bytes a vertex, 40 a tet, and 8 for each of its values.
/// ERRORS (all members): see ScratchFile.  Thread safety: none.
class ScratchMesh {
 public:
  static constexpr std::size_t kBatchTets = 4096;
  static constexpr std::uint64_t kBufferBytes = std::uint64_t{9} << 18U;

  /// REQUIRES: an existing folder.
  explicit ScratchMesh(const std::filesystem::path& folder);

  /// Returns what is known of the mesh beside its rows; `tets` of it is their number.
  [[nodiscard]] MeshHeader& header() { return header_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::uint64_t vertex_count() const { return positions_.size(); }
  [[nodiscard]] std::uint64_t tet_count() const { return tets_.size() / sizeof(TetRows); }
  /// REQUIRES: row < vertex_count().
  [[nodiscard]] Position vertex(std::uint64_t row) { return positions_[row]; }
  /// Returns the places of a tet's corners.  ERRORS: mw::Error(kInput) for a row without a vertex.
  [[nodiscard]] std::array<Position, 4> corners(const TetRows& tet);

  void add_vertices(std::span<const Position> positions);
  /// REQUIRES: as many labels as tets.
  void add_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels);
  /// Adds rows of values, as MeshSink::write_values() takes them.
  void add_values(std::span<const double> rows);
  /// Replaces the values of all tets by those that add_rows() appends for each batch.
  void replace_values(
      std::vector<std::string> names,
      const std::function<void(const TetBatch&, std::vector<double>& rows)>& add_rows);
  /// Takes the values of all tets away.
  void drop_values();

  /// Calls visit(std::span<const Position>) on all vertices in their order.
  template <class Visit>
  void each_vertex_batch(Visit visit) {
    positions_.each_batch(visit);
  }
  /// Calls visit on all tets in their order, at most kBatchTets at once.
  void each_tet_batch(const std::function<void(const TetBatch&)>& visit);
  /// Passes the mesh on, from begin() to finish(); calls between(), which may throw, often.
  void copy_to(
      MeshSink& sink, const std::function<void()>& between = [] {});

 private:
  std::filesystem::path folder_;
  MeshHeader header_;
  PagedFile<Position, 256> positions_;
  ScratchFile tets_;
  ScratchFile labels_;
  ScratchFile values_;
};

/// Fills a mesh.  REQUIRES: the mesh is empty, and outlives it.
class ScratchMeshSink : public MeshSink {
 public:
  /// complete is called by finish(), and its errors are those of finish().
  explicit ScratchMeshSink(
      ScratchMesh& mesh, std::function<void()> complete = [] {})
      : mesh_(mesh), complete_(std::move(complete)) {}

  void begin(const MeshHeader& header) override { mesh_.header() = header; }
  void write_vertices(std::span<const Position> positions) override {
    mesh_.add_vertices(positions);
  }
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override {
    mesh_.add_tets(tets, labels);
  }
  void write_values(std::span<const double> rows) override { mesh_.add_values(rows); }
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return ScratchMesh::kBufferBytes; }

 private:
  ScratchMesh& mesh_;
  std::function<void()> complete_;
};

}  // namespace mw::io
