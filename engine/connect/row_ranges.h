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
  /// If has_threads is true, add() and next() are called within an arena (Crew), whose threads
  /// sort.
  RowRanges(const std::filesystem::path& folder, std::size_t bytes, bool has_threads);

  void add(std::span<const RangeTet> tets);
  /// Returns the tets of the range that follows, or nothing behind the last.  REQUIRES: nothing is
  /// added afterwards.
  [[nodiscard]] std::optional<RangeTets> next();

 private:
  io::ExternalSort<2> sort_;
  std::optional<RangeTet> ahead_;  ///< behind the range that was taken last
};

/// Calls visit(first, at, count) for each run of numbers that follow one another: the run begins
/// with `first`, at this place of the list.
template <class Visit>
void each_run(const std::vector<std::uint64_t>& numbers, Visit visit) {
  for (std::size_t at = 0, end = 0; at < numbers.size(); at = end) {
    while (end < numbers.size() && numbers[end] - numbers[at] == end - at) ++end;
    visit(numbers[at], at, end - at);
  }
}

}  // namespace mw::engine
