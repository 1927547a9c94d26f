// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Places of a volume and of a mesh of any size, held against each other.
#pragma once

#include <optional>

#include "io/file/external_sort.h"
#include "kernels/audit/cavities.h"

namespace mw::engine {

/// Takes what tiles tell of their places: first those of one side, then those of the other.
/// Memory: `memory_bytes`, 4 bytes a set that goes on in other tiles, and places that differ.
/// Disk: 40 bytes a place in each tile that has it, 32 a vertex of it between tiles.
/// ERRORS: see io::ScratchFile; kResource above 2^32 such sets.
class PlaceLedger {
 public:
  enum class Side : std::uint8_t { kVolume, kMesh };

  PlaceLedger(std::filesystem::path folder, std::size_t memory_bytes);

  /// Labels are those of the whole.
  void add(Side side, const audit::PlacesPiece& piece);
  /// Joins its sets over tiles.  REQUIRES: all of its tiles were added, and no set of the other
  /// side is open.
  void close(Side side, audit::Cavities cavities);
  /// REQUIRES: called once, both sides are closed.
  [[nodiscard]] audit::PlacesReport compare();

 private:
  using Nodes = io::ExternalSort<4>;  ///< place, vertex, set
  /// Sums over the cells of a place.
  struct Sums {
    std::int64_t components = 0;
    std::int64_t euler = 0;
  };
  /// A place with its sums on both sides.
  struct Row {
    audit::PlaceLabels labels{};
    audit::PlaceKind kind{};
    std::array<Sums, 2> sums;
  };

  void add_sums(Side side, const audit::PlaceLabels& labels, audit::PlaceKind kind, Sums sums);
  [[nodiscard]] audit::Betti betti_of(const Row& row, Side side) const;
  void report(const Row& row, audit::PlacesReport& out) const;

  std::filesystem::path folder_;
  std::size_t share_;
  std::optional<Nodes> nodes_;  ///< of the side that is being added
  std::uint64_t sets_ = 0;      ///< of it
  io::ExternalSort<5> cells_;   ///< place, side, sums
  std::array<audit::Cavities, 2> cavities_;
};

}  // namespace mw::engine
