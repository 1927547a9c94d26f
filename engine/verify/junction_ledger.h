// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Junctions of a volume and of a mesh of any size, held against each other.
#pragma once

#include <optional>

#include "io/file/scratch/external_sort.h"
#include "kernels/audit/topology/part_graph.h"

namespace mw::engine {

/// Takes what tiles tell of their junctions: first those of one side, then those of the other.
/// Memory: `memory_bytes`, 4 bytes for each set that goes on in other tiles, and the junctions that
/// differ.  Disk: 40 bytes for each junction in each tile that has it, 32 for each vertex of it
/// between tiles.  ERRORS: see io::ScratchFile; kResource from 2^32 - 1 such sets on.
class JunctionLedger {
 public:
  enum class Side : std::uint8_t { kVolume, kMesh };

  JunctionLedger(std::filesystem::path folder, std::size_t memory_bytes);

  /// Adds a tile's piece, whose labels are those of the whole volume.
  void add(Side side, const audit::JunctionsPiece& piece);
  /// Joins the sets of a side over tiles.  REQUIRES: all of its tiles were added, and no set of the
  /// other side is open.
  void close(Side side, audit::Cavities cavities);
  /// Compares the two sides.  REQUIRES: called once, both sides are closed.
  [[nodiscard]] audit::JunctionReport compare();

 private:
  using Nodes = io::ExternalSort<4>;  ///< junction, vertex, set
  /// Sums over the cells of a junction.
  struct Sums {
    std::int64_t components = 0;
    std::int64_t euler = 0;
  };
  /// A junction with its sums on both sides.
  struct Row {
    audit::JunctionLabels labels{};
    audit::JunctionKind kind{};
    std::array<Sums, 2> sums;
  };

  void add_sums(Side side, const audit::JunctionLabels& labels, audit::JunctionKind kind,
                Sums sums);
  [[nodiscard]] audit::Betti betti_of(const Row& row, Side side) const;
  void report(const Row& row, audit::JunctionReport& out) const;

  std::filesystem::path folder_;
  std::size_t share_;
  std::optional<Nodes> nodes_;  ///< of the side that is being added
  std::uint64_t sets_ = 0;      ///< its sets so far that go on in other tiles
  io::ExternalSort<5> cells_;   ///< junction, side, sums
  std::array<audit::Cavities, 2> cavities_;
};

}  // namespace mw::engine
