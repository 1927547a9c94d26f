// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers of a mesh with gaps, put together from its tiles.
#pragma once

#include "engine/verify/part_links.h"
#include "kernels/audit/regions/regions.h"

namespace mw::engine {

/// Memory: `memory_bytes`, and see audit::RegionsUnion.  ERRORS: see io::ScratchFile.
class RegionLinks {
 public:
  RegionLinks(std::size_t label_count, const std::filesystem::path& folder,
              std::size_t memory_bytes)
      : regions_(label_count),
        links_(folder, memory_bytes / 2),
        meetings_(folder, memory_bytes / 2) {}

  /// Labels are those of the whole.
  void add(const audit::RegionsPiece& piece) {
    const std::uint32_t first = regions_.add(piece);
    for (const auto& [item, set] : piece.shared) links_.add(item, 1, first + set);
    for (const auto& [vertex, part, inner] : piece.meetings) {
      meetings_.add({vertex, first + part, first + inner});
    }
  }

  /// By label.  REQUIRES: called once, after all tiles.
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
