// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets brought together by the vertices that they have, a range of rows at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "io/file/scratch/external_sort.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::engine {

/// How many vertices are looked at together, with all of their tets.
inline constexpr std::uint64_t kRowsARange = 1024;
/// The number of a range of rows, and a tet that has one of them.
using RangeTet = std::array<std::uint64_t, 2>;

/// Appends the ranges of a tet's rows, each once.
void add_ranges(std::uint64_t tet, const io::TetRows& rows, std::vector<RangeTet>& out);

/// The tets that have a vertex of a range of rows, ascending.
struct RangeTets {
  std::uint64_t range = 0;
  std::vector<std::uint64_t> tets;
};

/// Sorts tets by ranges of rows.  Memory: `bytes`.  Disk: 16 bytes a record.
/// Thread safety: one thread at a time.  ERRORS: those of ExternalSort.
class RowRanges {
 public:
  RowRanges(const std::filesystem::path& folder, std::size_t bytes);

  /// REQUIRES: numbers of tets ascend, from call to call, too.
  void add(std::span<const RangeTet> tets);
  /// Returns the tets of the range that follows, or nothing behind the last.  REQUIRES: nothing is
  /// added afterwards.
  [[nodiscard]] std::optional<RangeTets> next();

 private:
  io::ExternalSort<2> sort_;
  std::optional<RangeTet> ahead_;  ///< behind the range that was taken last
};

/// Some ascending numbers that are near each other.
struct NearNumbers {
  std::uint64_t first = 0;  ///< the least one
  std::size_t span = 0;     ///< how many numbers there are from the least to the greatest
  std::size_t begin = 0;    ///< places in the list
  std::size_t end = 0;
};

/// Calls visit(NearNumbers) for parts of an ascending list of numbers.  What is between numbers of
/// a part costs less to read than another call to the system would.
template <class Visit>
void each_near(const std::vector<std::uint64_t>& numbers, Visit visit) {
  constexpr std::uint64_t kMostGap = 32, kMostSpan = 4096;
  for (std::size_t at = 0, end = 0; at < numbers.size(); at = end) {
    for (end = at + 1; end < numbers.size(); ++end) {
      if (numbers[end] - numbers[end - 1] > kMostGap) break;
      if (numbers[end] - numbers[at] >= kMostSpan) break;
    }
    visit(NearNumbers{numbers[at], numbers[end - 1] - numbers[at] + 1, at, end});
  }
}

/// Reads tets of a settled mesh and their labels.  REQUIRES: ascending numbers of tets; as many
/// places in both lists.
void read_tets(io::ScratchMesh& mesh, const std::vector<std::uint64_t>& numbers,
               std::span<io::TetRows> tets, std::span<RawLabel> labels);

}  // namespace mw::engine
