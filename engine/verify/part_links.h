// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which parts of different tiles are one: the same tets or voxels are in both.
#pragma once

#include <vector>

#include "io/file/scratch/external_sort.h"
namespace mw::engine {

/// Items (tets, voxels) by number, in runs, each in a part of a tile.
/// Memory: see io::ExternalSort.
class PartLinks {
 public:
  PartLinks(const std::filesystem::path& folder, std::size_t memory_bytes)
      : runs_(folder, memory_bytes) {}

  /// part: numbered through all tiles.
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

}  // namespace mw::engine
