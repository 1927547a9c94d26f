// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/layouts.h"

#include <algorithm>
#include <utility>

#include "kernels/core/error.h"

namespace mw::bench {
namespace {

/// The first march's rows.
struct Rows {
  std::int64_t y, z;

  explicit Rows(const engine::RunLayout& layout)
      : y(layout.grid(0).windows().y), z(layout.grid(0).windows().z) {}
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(y * z); }
  [[nodiscard]] std::size_t at(std::int64_t row_y, std::int64_t row_z) const {
    return static_cast<std::size_t>(row_z * y + row_y);
  }
};

/// A layout of y times z rows, for the engine to deal.
engine::RunLayout rows_layout(std::int64_t y, std::int64_t z, engine::Order order) {
  return run_layout({1, y + 1, z + 1}, 2, 1, order);
}

}  // namespace

engine::RunLayout run_layout(Index3 volume, int window, std::uint32_t marches,
                             engine::Order order) {
  std::vector<engine::WindowGrid> grids;
  for (std::uint32_t march = 0; march < marches; ++march) {
    grids.emplace_back(volume, window << march);
  }
  return engine::RunLayout(std::move(grids), order);
}

/// An axis of one window may have one block or two: two is what traces of volumes worth it have.
engine::RunLayout traced_layout(const std::vector<MarchTrace>& trace, engine::Order order) {
  if (trace.empty()) throw Error(ErrorKind::kInput, "the trace has no visits");
  return run_layout(trace[0].windows + Index3{1, 1, 1}, 2, static_cast<std::uint32_t>(trace.size()),
                    order);
}

engine::Partition deal(const RunFlow& flow, std::span<const double> seconds, engine::Order order,
                       int ranks, std::int64_t cut_every) {
  const std::int64_t n = order == engine::Order::kColour ? cut_every : 1;
  const Rows rows(flow.layout());
  const engine::RunLayout bundles_layout =
      rows_layout((rows.y + n - 1) / n, (rows.z + n - 1) / n, order);
  const Rows bundles(bundles_layout);
  std::vector<double> costs(bundles.size());
  for (std::uint32_t w = 0; w < flow.first(1); ++w) {
    const Index3 window = flow.key(w).window;
    costs[bundles.at(window.y / n, window.z / n)] += seconds[w];
  }
  const engine::Partition dealt(bundles_layout, order, ranks, costs);
  std::vector<std::uint32_t> owners(rows.size());
  for (std::int64_t z = 0; z < rows.z; ++z) {
    for (std::int64_t y = 0; y < rows.y; ++y) {
      owners[rows.at(y, z)] = dealt.owners()[bundles.at(y / n, z / n)];
    }
  }
  return {flow.layout(), std::move(owners)};
}

engine::Partition deal_like(const RunFlow& flow, const engine::RunLayout& volume,
                            engine::Order order, int ranks) {
  const Rows rows(flow.layout()), far(volume);
  const engine::Partition dealt(volume, order, ranks);
  std::vector<std::uint32_t> owners(rows.size());
  for (std::int64_t z = 0; z < rows.z; ++z) {
    for (std::int64_t y = 0; y < rows.y; ++y) {
      owners[rows.at(y, z)] = dealt.owners()[far.at((2 * y + 1) * far.y / (2 * rows.y),
                                                    (2 * z + 1) * far.z / (2 * rows.z))];
    }
  }
  return {flow.layout(), std::move(owners)};
}

}  // namespace mw::bench
