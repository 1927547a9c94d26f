// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Vertices that were doubled, found again by their positions.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "io/file/scratch/external_sort.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/tet_record.h"

namespace mw::io {

/// Finds the vertices that lie where an earlier one lies.
/// Memory: `memory_bytes` while it searches; 16 bytes for each vertex that it finds.  Disk: 32
/// bytes a vertex in `folder`.  ERRORS: see ScratchFile.
class DoubledVertices {
 public:
  explicit DoubledVertices(const std::filesystem::path& folder,
                           std::size_t memory_bytes = kMemoryBytes)
      : positions_(folder, memory_bytes) {}

  void add(std::span<const Position> positions);
  /// Called once, when all vertices were added.
  void find();
  /// Returns the first row at the position of `row`.  REQUIRES: find().  Cost: O(log doubles).
  [[nodiscard]] std::uint64_t first(std::uint64_t row) const;
  /// Returns how many rows before this one double no earlier one.  REQUIRES: first(row) == row.
  [[nodiscard]] std::uint64_t rank(std::uint64_t row) const;
  [[nodiscard]] std::uint64_t count() const { return doubles_.size(); }

 private:
  static constexpr std::size_t kMemoryBytes = 8 << 20;

  ExternalSort<4> positions_;  ///< sortable coordinates, row
  std::uint64_t rows_ = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> doubles_;  ///< row, first row; ascending
};

/// Passes a mesh on without its values of tets.  Where its record tells of doubled vertices, all
/// vertices at one position become one.  Calls between(), which may throw, before each piece that
/// it takes or passes on.  REQUIRES: the sink outlives it. Memory: that of DoubledVertices and 1
/// MiB.  Disk: where vertices were doubled, that of DoubledVertices, and 24 bytes a vertex and 40 a
/// tet.
class MergedVertices : public MeshSink {
 public:
  MergedVertices(
      MeshSink& below, std::filesystem::path folder, std::function<void()> between = [] {})
      : below_(below), folder_(std::move(folder)), between_(std::move(between)) {}

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return below_.buffer_bytes(); }

  /// Returns how many vertices were merged into others.  REQUIRES: finished.
  [[nodiscard]] std::uint64_t merged() const { return waiting_ ? waiting_->doubles.count() : 0; }

 private:
  /// A mesh that is not passed on before all of its vertices are known.
  struct Waiting {
    explicit Waiting(const std::filesystem::path& folder)
        : doubles(folder), positions(folder), tets(folder) {}

    DoubledVertices doubles;
    ScratchFile positions;
    PackedRecords<TetRecord> tets;
  };

  void pass_vertices();
  void pass_tets();

  MeshSink& below_;
  std::filesystem::path folder_;
  std::function<void()> between_;
  std::optional<Waiting> waiting_;
};

}  // namespace mw::io
