// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which parts of different tiles are one, as the same tets or voxels are in both; Betti numbers of
// a mesh with gaps, put together from its tiles.
#pragma once

#include <vector>

#include "io/file/scratch/external_sort.h"
#include "kernels/audit/regions/regions.h"

namespace mw::engine {

/// Runs of items (tets or voxels, by number), each of which lies in a part of a tile.
/// Memory: see io::ExternalSort.
class PartLinks {
 public:
  PartLinks(const std::filesystem::path& folder, std::size_t memory_bytes)
      : runs_(folder, memory_bytes) {}

  /// Adds a run of items in a part; parts are numbered through all tiles.
  void add(std::uint64_t first, std::uint64_t count, std::uint32_t part) {
    runs_.add({first, count, part});
  }
  /// Makes all parts one that have an item in common, by parts.unite(a, b).
  /// REQUIRES: called once.
  template <class Parts>
  void unite(Parts& parts) {
    std::vector<Run> open;  // those that reach beyond the last one's beginning
    runs_.each([&](const std::array<std::uint64_t, 3>& record) {
      const Run run{record[0] + record[1], static_cast<std::uint32_t>(record[2])};
      std::erase_if(open, [&](const Run& other) { return other.end <= record[0]; });
      for (const Run& other : open) parts.unite(other.part, run.part);
      open.push_back(run);
    });
  }

 private:
  struct Run {
    std::uint64_t end = 0;
    std::uint32_t part = 0;
  };

  io::ExternalSort<3> runs_;
};

/// Puts together the regions of a mesh with gaps.  Memory: `memory_bytes`, and see
/// audit::RegionsUnion.  ERRORS: see io::ScratchFile.
class RegionLinks {
 public:
  RegionLinks(std::size_t label_count, const std::filesystem::path& folder,
              std::size_t memory_bytes)
      : regions_(label_count),
        links_(folder, memory_bytes / 2),
        meetings_(folder, memory_bytes / 2) {}

  /// Adds a tile's piece, whose labels are those of the whole volume.
  void add(const audit::RegionsPiece& piece) {
    const std::uint32_t first = regions_.add(piece);
    for (const auto& [item, set] : piece.shared) links_.add(item, 1, first + set);
    for (const auto& [vertex, part, inner] : piece.meetings) {
      meetings_.add({vertex, first + part, first + inner});
    }
  }

  /// Returns the Betti numbers by label.  REQUIRES: called once, after all tiles.
  [[nodiscard]] std::vector<audit::RegionBetti> betti() {
    links_.unite(regions_);
    std::vector<audit::RegionsPiece::Meeting> here;  // at one vertex
    meetings_.each([&](const std::array<std::uint64_t, 3>& m) {
      if (!here.empty() && here.front().vertex != m[0]) {
        regions_.meet(here);
        here.clear();
      }
      here.push_back({m[0], static_cast<std::uint32_t>(m[1]), static_cast<std::uint32_t>(m[2])});
    });
    regions_.meet(here);
    return regions_.betti();
  }

 private:
  audit::RegionsUnion regions_;
  PartLinks links_;
  io::ExternalSort<3> meetings_;
};

}  // namespace mw::engine
