// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A finished mesh in files without a name, column by column, which passes change and writers read.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "io/mesh/merged_vertices.h"
#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// Tets that follow one another, with their labels, and their numbers row by row.
struct TetBatch {
  std::uint64_t first = 0;  ///< the number of the first one in the mesh
  std::span<const TetRows> tets;
  std::span<const RawLabel> labels;
  std::span<const double> values;  ///< as MeshSink::write_values() takes them
};

/// A tet that has a facet.
struct FacetSide {
  std::uint64_t tet = 0;
  RawLabel label = 0;
  std::uint32_t opposite = 0;    ///< its corner that is not in the facet, 0 to 3
  std::uint32_t points_out = 0;  ///< 1 if the normal of the facet's rows does
};

/// A triangle that is not between two tets of one label.
struct MeshFacet {
  std::array<std::uint64_t, 3> rows{};  ///< ascending; of doubled vertices the first ones
  std::array<FacetSide, 2> sides{};     ///< two of its tets, or one
  std::uint64_t tets = 0;               ///< how many tets have it
};

/// A whole mesh outside of memory.
/// Memory: kBufferBytes; with facets 256 KiB more, and 16 bytes for each vertex that was doubled.
/// Disk: 24 bytes a vertex, 40 a tet, 8 for each of its values, and 24 a curved node.  Facets take
/// 80 bytes each, and 160 a tet while they are made.
/// ERRORS (all members): see ScratchFile.  Thread safety: see settle(); else none.
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
  /// Returns the first vertex at the place of a vertex, which is another one only where the header
  /// tells of doubled vertices.  REQUIRES: find_doubles() or facets() was called.
  [[nodiscard]] std::uint64_t first_of(std::uint64_t row) const {
    return doubles_ ? doubles_->first(row) : row;
  }
  /// Finds the doubled vertices, if the header tells of any, by a sort of this memory.
  void find_doubles(std::size_t sort_bytes);
  /// Returns the facets, ascending by rows.  They are made when they are first asked for, by a sort
  /// of this memory, which pairs the faces of tets; between(), which may throw, is called often.
  [[nodiscard]] ScratchFile& facets(
      std::size_t sort_bytes, const std::function<void()>& between = [] {});

  void add_vertices(std::span<const Position> positions);
  /// REQUIRES: as many labels as tets.
  void add_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels);
  /// Adds rows of values, as MeshSink::write_values() takes them.
  void add_values(std::span<const double> rows);
  /// Adds columns of values behind those that the mesh has; add_row() appends the numbers of one
  /// tet of the batch, one for each name.
  void add_columns(const std::vector<std::string>& names,
                   const std::function<void(const TetBatch& batch, std::size_t tet,
                                            std::vector<double>& rows)>& add_row);
  /// Takes the values of all tets away.
  void drop_values();
  /// Takes the places of the nodes that curved tets have: the vertices, then the middles of edges,
  /// which ascend by their ends.  The straight mesh stays.  REQUIRES: no tet is added afterwards.
  void curve(PagedArray<Position> nodes) { curved_nodes_.emplace(std::move(nodes)); }
  /// Returns these places; null where there are none.
  [[nodiscard]] PagedArray<Position>* curved_nodes() {
    return curved_nodes_ ? &*curved_nodes_ : nullptr;
  }

  /// Calls visit(std::span<const Position>) on all vertices in their order.
  template <class Visit>
  void each_vertex_batch(Visit visit) {
    positions_.each_batch(visit);
  }
  /// Puts all rows into the files.  Until rows are added, several threads may call read_tets() at
  /// once, and look at vertices through a CornerReader each.
  void settle();
  /// Fills both lists, which are of one length, from this tet on.  REQUIRES: they are there.
  void read_tets(std::uint64_t first, std::span<TetRows> tets, std::span<RawLabel> labels);
  /// Calls visit on all tets in their order, at most kBatchTets at once.
  void each_tet_batch(const std::function<void(const TetBatch&)>& visit);
  /// Gives the mesh to a sink (MeshSink::take()).
  void copy_to(
      MeshSink& sink, const std::function<void()>& between = [] {}) {
    sink.take(*this, between);
  }

 private:
  friend class CornerReader;

  std::filesystem::path folder_;
  MeshHeader header_;
  PagedFile<Position, 256> positions_;
  ScratchFile tets_;
  ScratchFile labels_;
  ScratchFile values_;
  std::optional<DoubledVertices> doubles_;
  std::optional<ScratchFile> facets_;
  std::optional<PagedArray<Position>> curved_nodes_;
};

/// Looks up places of corners.  Several threads may have one each.
/// REQUIRES: a settled mesh, which outlives it.  Memory: kBytes.  ERRORS: see
/// ScratchMesh::corners().
class CornerReader {
 public:
  static constexpr std::size_t kPages = 64;
  static constexpr std::uint64_t kBytes = kPages * (4096 + 64);

  explicit CornerReader(ScratchMesh& mesh)
      : file_(mesh.positions_.file()), vertices_(mesh.vertex_count()) {}

  [[nodiscard]] std::array<Position, 4> corners(const TetRows& tet);

 private:
  ScratchFile& file_;
  std::uint64_t vertices_;
  RecordPages<Position, kPages> pages_;
};

/// Fills a mesh.  REQUIRES: the mesh is empty, and outlives it.
class ScratchMeshSink : public MeshSink {
 public:
  /// complete is called by finish(), and its errors are those of finish(); bytes is the most that
  /// it and the mesh hold.
  explicit ScratchMeshSink(
      ScratchMesh& mesh, std::function<void()> complete = [] {},
      std::uint64_t bytes = ScratchMesh::kBufferBytes)
      : mesh_(mesh), complete_(std::move(complete)), bytes_(bytes) {}

  void begin(const MeshHeader& header) override { mesh_.header() = header; }
  void write_vertices(std::span<const Position> positions) override {
    mesh_.add_vertices(positions);
  }
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override {
    mesh_.add_tets(tets, labels);
  }
  void write_values(std::span<const double> rows) override { mesh_.add_values(rows); }
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return bytes_; }

 private:
  ScratchMesh& mesh_;
  std::function<void()> complete_;
  std::uint64_t bytes_;
};

}  // namespace mw::io
