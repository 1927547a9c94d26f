// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the march itself costs: windows that do nothing.
#include <benchmark/benchmark.h>

#include "engine/march/march.h"

namespace mw::engine {
namespace {

/// Arguments: order, threads.
void march_over_nothing(benchmark::State& state) {
  // 40 x 40 x 40 windows.
  const WindowOrder order(WindowGrid({41, 41, 41}, 2), static_cast<Order>(state.range(0)));
  const MarchOptions options{.threads = static_cast<int>(state.range(1))};
  for (auto _ : state)
    march(
        order, [](Index3 w) { benchmark::DoNotOptimize(w); }, options);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(order.size()));
}
BENCHMARK(march_over_nothing)->ArgsProduct({{0, 1}, {1, 2, 8}})->UseRealTime();

}  // namespace
}  // namespace mw::engine
