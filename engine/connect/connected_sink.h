// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds what hangs together in a mesh on its way into a file, leaves parts out, doubles vertices.
#pragma once

#include <memory>
#include <optional>

#include "engine/connect/part_finder.h"
#include "io/mesh/tet_record.h"

namespace mw::engine {

struct ConnectTask {
  ConnectOptions options;
  std::filesystem::path folder;  ///< where temporary files go
  std::size_t memory_bytes = kMaxMemoryBytes;

  static constexpr std::size_t kMaxMemoryBytes = 8 << 20;
  /// Returns the part of a budget that each sort takes.
  [[nodiscard]] static std::size_t memory_of(std::uint64_t budget);
};

/// Passes a mesh on as it comes, and counts.  If the options change it, the mesh waits on the disk
/// until it is complete: kept vertices and tets keep their order, copies of vertices come behind
/// the vertices.  Memory: that of PartFinder and 1 MiB; where parts are left out, 2 bits a vertex
/// and 8 bytes a label more; 64 KiB a value.  Disk: that of PartFinder and 24 bytes a vertex; where
/// the mesh changes, 40 more a tet, and 8 a value.  ERRORS: those of PartFinder::find(),
/// ScratchFile and the sink below.  REQUIRES: the sink below outlives it.
class ConnectedSink : public io::MeshSink {
 public:
  ConnectedSink(io::MeshSink& below, ConnectTask task);

  void begin(const io::MeshHeader& header) override;
  void write_vertices(std::span<const io::Position> positions) override;
  void write_tets(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) override;
  void write_values(std::span<const double> rows) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override;

  /// Returns what was found; nothing before finish().
  [[nodiscard]] const std::optional<ConnectFacts>& facts() const { return facts_; }

 private:
  /// Marks the vertices of kept tets among 64, and says how many there are before these.
  struct UsedWord {
    std::uint64_t bits = 0;
    std::uint64_t before = 0;
  };

  [[nodiscard]] io::Position position(std::uint64_t row);
  void find_places();
  void mark_used();
  [[nodiscard]] bool is_used(std::uint64_t row) const;
  [[nodiscard]] std::uint64_t new_row(std::uint64_t row) const;
  void write_changed();
  void pass_vertices();
  void pass_tets();
  void pass_tets_before(std::uint64_t end);
  [[nodiscard]] io::TetRecord& next_tet();
  void pass(const io::TetRecord& tet);
  void flush();

  io::MeshSink& below_;
  ConnectTask task_;
  std::optional<PartFinder> finder_;
  std::optional<ConnectFacts> facts_;
  io::MeshHeader header_;
  io::ScratchFile positions_;
  io::ScratchFile tets_;        ///< only where the mesh changes
  io::ScratchFile values_;      ///< only where the mesh changes: rows of header_.values
  std::vector<UsedWord> used_;  ///< empty if all vertices are used
  std::uint64_t used_count_ = 0;
  std::uint64_t next_ = 0;             ///< the first tet that was not passed on
  std::vector<io::TetRecord> loaded_;  ///< some tets, among them the next one
  std::vector<double> loaded_values_;  ///< values of the loaded tets
  std::uint64_t loaded_first_ = 0;
  std::vector<io::TetRows> batch_;  ///< tets to be passed on
  std::vector<RawLabel> batch_labels_;
  std::vector<double> batch_values_;
};

}  // namespace mw::engine
