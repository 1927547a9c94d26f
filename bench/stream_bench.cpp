// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bandwidth of memory: a triad over arrays that no cache holds, as the STREAM benchmark has it.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

namespace {

/// Bytes are those that the loop names: two reads and a write of each element.
void BM_Triad(benchmark::State& state) {
  constexpr std::size_t kElements = std::size_t{1} << 23;
  std::vector<double> a(kElements, 1.0), b(kElements, 2.0), c(kElements);
  for (auto _ : state) {
    for (std::size_t i = 0; i < kElements; ++i) c[i] = a[i] + 3.0 * b[i];
    benchmark::DoNotOptimize(c.data());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(3 * 8 * kElements));
}
BENCHMARK(BM_Triad)->ThreadRange(1, 2)->UseRealTime();

}  // namespace
