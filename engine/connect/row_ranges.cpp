// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/connect/row_ranges.h"

#include <algorithm>

#include "engine/system/crew.h"

namespace mw::engine {
namespace {

io::ExternalSort<2> range_sort(const std::filesystem::path& folder, std::size_t bytes,
                               bool has_threads) {
  if (!has_threads) return {folder, bytes};
  return {folder, bytes, [](std::span<RangeTet> held) { tbb_sort(held); }};
}

}  // namespace

void add_ranges(std::uint64_t tet, const io::TetRows& rows, std::vector<RangeTet>& out) {
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  for (const std::uint64_t row : rows) {
    const RangeTet one{row / kRowsARange, tet};
    if (std::find(out.begin() + first, out.end(), one) == out.end()) out.push_back(one);
  }
}

RowRanges::RowRanges(const std::filesystem::path& folder, std::size_t bytes, bool has_threads)
    : sort_(range_sort(folder, bytes, has_threads)) {}

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

}  // namespace mw::engine
