// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/connect/row_ranges.h"

#include <algorithm>
#include <numeric>

namespace mw::engine {
namespace {

/// Sorts by range.  REQUIRES: tets ascend, and so they do in each range afterwards.
void sort_by_range(std::span<RangeTet> held) {
  if (held.empty()) return;
  const auto [least, greatest] = std::minmax_element(
      held.begin(), held.end(), [](const RangeTet& a, const RangeTet& b) { return a[0] < b[0]; });
  const std::uint64_t first = (*least)[0], ranges = (*greatest)[0] - first + 1;
  if (ranges > held.size()) return std::sort(held.begin(), held.end());
  std::vector<std::uint32_t> place(ranges + 1);
  for (const RangeTet& tet : held) ++place[tet[0] - first + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<RangeTet> sorted(held.size());
  for (const RangeTet& tet : held) sorted[place[tet[0] - first]++] = tet;
  std::copy(sorted.begin(), sorted.end(), held.begin());
}

}  // namespace

void add_ranges(std::uint64_t tet, const io::TetRows& rows, std::vector<RangeTet>& out) {
  std::array<std::uint64_t, 4> ranges{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ranges[i] = rows[i] / kRowsARange;
    const auto here = ranges.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(ranges.begin(), here, ranges[i]) == here) out.push_back({ranges[i], tet});
  }
}

// A third of the memory is for what is held, and as much for its sorted copy, and the rest for
// places.
RowRanges::RowRanges(const std::filesystem::path& folder, std::size_t bytes)
    : sort_(folder, bytes / 3, sort_by_range) {}

void RowRanges::add(std::span<const RangeTet> tets) {
  for (const RangeTet& tet : tets) sort_.add(tet);
}

std::optional<RangeTets> RowRanges::next() {
  RangeTets out;
  if (!ahead_) {
    const auto* const first = sort_.next();
    if (first == nullptr) return std::nullopt;
    ahead_ = *first;
  }
  out.range = (*ahead_)[0];
  out.tets.push_back((*ahead_)[1]);
  ahead_.reset();
  while (const auto* const record = sort_.next()) {
    if ((*record)[0] != out.range) {
      ahead_ = *record;
      break;
    }
    out.tets.push_back((*record)[1]);
  }
  return out;
}

void read_tets(io::ScratchMesh& mesh, const std::vector<std::uint64_t>& numbers,
               std::span<io::TetRows> tets, std::span<RawLabel> labels) {
  std::vector<io::TetRows> near_tets;
  std::vector<RawLabel> near_labels;
  each_near(numbers, [&](const NearNumbers& near) {
    near_tets.resize(near.span);
    near_labels.resize(near.span);
    mesh.read_tets(near.first, near_tets, near_labels);
    for (std::size_t i = near.begin; i < near.end; ++i) {
      tets[i] = near_tets[numbers[i] - near.first];
      labels[i] = near_labels[numbers[i] - near.first];
    }
  });
}

}  // namespace mw::engine
