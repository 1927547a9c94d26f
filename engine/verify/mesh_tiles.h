// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh of any size, taken apart into tiles.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/verify/tile_grid.h"
#include "engine/verify/tile_labels.h"
#include "io/labels/label_table.h"
#include "io/mesh/mesh_sink.h"
#include "kernels/audit/check.h"
#include "kernels/audit/compensated_sum.h"
#include "kernels/audit/shape/curved.h"

namespace mw::engine {

/// One tile in memory, as audit::MeshTile wants it.
struct LoadedMesh {
  std::vector<audit::Position> vertices;  ///< in the array's axes
  std::vector<audit::Position> written;   ///< as written, where axes are turned; else empty
  std::vector<audit::TetRow> tets;
  std::vector<Label> labels;  ///< of the tile
  std::vector<std::uint64_t> vertex_ids;
  std::vector<std::uint64_t> tet_ids;
  std::vector<std::uint8_t> owned;
  std::vector<bool> is_shared;  ///< by tet: whether another tile has it, too
  TileLabels names{{}, 0};

  [[nodiscard]] audit::MeshTile view() const {
    return {{vertices, tets, labels}, vertex_ids, tet_ids, owned};
  }
};

/// Takes a mesh in and gives it back in tiles: each vertex is owned by the tile that it lies in,
/// and a tile has every tet with a vertex that it owns.  A mesh whose rows or numbers make no sense
/// is taken note of, not kept.  Memory: `memory_bytes` while it is taken in, and for each vertex 4
/// bytes.  Disk: 24 bytes a vertex, some 20 a tet.  ERRORS: see io::ScratchFile;
/// kResource from 2^32 - 1 vertices on.
class MeshTiles : public io::MeshSink {
  struct Tet {
    std::uint64_t id = 0;
    audit::TetRow vertices{};
    Label label = 0;
    std::uint32_t is_shared = 0;
  };

 public:
  struct Place {
    std::filesystem::path folder;  ///< of temporary files
    std::uint64_t memory_bytes = std::uint64_t{32} << 20U;
    std::int64_t edge = TileGrid::kEdge;  ///< of tiles
  };

  /// volume and table outlive this.  begin() tells whether the volume repeats itself, which its
  /// lattice depends on.
  MeshTiles(const io::VolumeInfo& volume, const io::LabelTable& table, const Place& junction);

  void begin(const io::MeshHeader& header) override;
  void write_vertices(std::span<const io::Position> positions) override;
  void write_tets(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) override;
  /// What a thread finds of tets that follow one another.
  struct TetShare {
    std::uint64_t tet_count = 0;
    TileShares<Tet> tets{};
    std::vector<Label> labels{};  ///< dense
    std::string range_error{};    ///< names the first tet with a row without a vertex
  };
  /// Looks at tets from this one on.  REQUIRES: all vertices were written.  Thread-safe.  Memory:
  /// 48 bytes for each tet in each tile that has it.
  [[nodiscard]] TetShare look_at(std::uint64_t first, std::span<const io::TetRows> tets,
                                 std::span<const RawLabel> labels);
  /// Adds tets to their tiles.  REQUIRES: they follow those that were added or written last.
  void add(const TetShare& found);
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return memory_bytes_; }

  [[nodiscard]] const io::MeshHeader& header() const { return header_; }
  [[nodiscard]] const TileGrid& grid() const { return grid_; }
  /// "P2 input": only a mesh that passes has tiles.
  [[nodiscard]] audit::Check input_check() const;
  /// Returns the vertices in no tet.
  [[nodiscard]] const audit::Offenders& unused() const { return unused_; }
  /// Returns what tets of ten nodes are like, where the mesh came in their straight parts, which
  /// are the tets in the tiles.
  [[nodiscard]] const std::optional<audit::CurvedMeter>& curved() const { return curved_; }
  /// Returns the volume of curved tets beyond their parts, by dense label, in lattice voxels.
  [[nodiscard]] const std::vector<audit::CompensatedSum>& beyond_parts() const {
    return beyond_parts_;
  }
  /// Returns which labels of the volume the mesh has, by dense label.
  [[nodiscard]] const audit::KeptLabels& labels() const { return labels_; }
  /// Return whether the mesh's axes are not the array's, and whether they are a mirror image.
  [[nodiscard]] bool is_turned() const { return !is_upright_; }
  [[nodiscard]] bool is_mirrored() const { return is_mirrored_; }
  /// Returns where the array's axes lie, for the audit.
  [[nodiscard]] audit::Frame frame() const;

  /// Returns a tile and lets go of it.  REQUIRES: finished, and input_check() passed; called once
  /// for each tile.  Thread-safe.
  [[nodiscard]] LoadedMesh take_tile(std::uint32_t tile);

 private:
  /// Returns whether all vertices of a tet have been written, and notes the first that is not.
  [[nodiscard]] bool in_range(const Tet& tet, std::string& error) const;
  [[nodiscard]] std::uint32_t use(std::uint64_t vertex);
  void add_to_tiles(Tet tet, TileShares<Tet>& out);
  void keep_nodes(std::uint64_t tet, const io::TetRows& part, RawLabel label);
  void measure_curved();
  [[nodiscard]] audit::Position in_array(const io::Position& p) const;
  [[nodiscard]] LoadedMesh make(const std::vector<Tet>& tets) const;
  void read_positions(std::span<const std::uint64_t> ids, std::vector<audit::Position>& out) const;

  const io::VolumeInfo& volume_;
  const io::LabelTable& table_;
  Index3 layers_;
  bool is_upright_;
  bool is_mirrored_;
  TileGrid grid_;
  std::uint64_t memory_bytes_;
  io::MeshHeader header_;
  mutable std::mutex mutex_;
  mutable io::ScratchFile positions_;
  static constexpr std::uint32_t kUsed = std::uint32_t{1} << 31U;
  std::vector<std::uint32_t> tile_of_vertex_;  ///< with kUsed until all tets are there
  audit::KeptLabels labels_;
  TileBuckets<Tet> tets_;
  std::uint64_t tet_count_ = 0;
  /// A curved tet as it waits for the last vertex.
  struct CurvedTet {
    std::array<std::uint64_t, 10> rows{};
    std::uint64_t label = 0;  ///< dense
  };
  io::ScratchFile curved_tets_;
  CurvedTet next_;
  std::vector<audit::CompensatedSum> beyond_parts_;
  std::optional<audit::CurvedMeter> curved_;
  std::string range_error_;
  audit::Offenders endless_{"vertices that are not finite"};
  audit::Offenders unused_{"vertices in no tet"};
};

}  // namespace mw::engine
