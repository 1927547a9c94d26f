// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sequential marches; the parallel one is in flow_march.cpp.
#include "engine/march/march.h"

#include <algorithm>

#include "engine/system/crew.h"
#include "engine/system/stages.h"
#include "engine/system/stopwatch.h"
#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

/// The reference for all other ways to march.
void march_in_sequence(const WindowOrder& order, const VisitWindow& visit,
                       const MarchOptions& options) {
  for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
    const Index3 window = order.window(rank);
    if (options.finished_before && options.finished_before(window)) continue;
    Admission admission;
    if (options.admit) admission = options.admit(window);
    const Visited visited = timed_visit(visit, window, 0);
    admission.reset();
    if (options.visited) options.visited(visited);
  }
}

}  // namespace

Visited timed_visit(const VisitWindow& visit, Index3 window, int slot) {
  const SharedWork shared;
  Visited out{.window = window, .start = {}, .end = {}, .slot = slot};
  const double cpu_before = thread_cpu_seconds();
  out.start = std::chrono::steady_clock::now();
  visit(window);
  out.end = std::chrono::steady_clock::now();
  out.cpu_seconds = thread_cpu_seconds() - cpu_before;
  return out;
}

void march(const WindowOrder& order, const VisitWindow& visit, const MarchOptions& options) {
  if (thread_count(options.threads) == 1 && options.part == nullptr) {
    return march_in_sequence(order, visit, options);
  }
  Crew crew(thread_count(options.threads));
  if (crew.size() > 1 || options.part != nullptr) return flow_march(order, visit, options, crew);
  // The crew's arena is used all the same, since a visit must not wake threads of oneTBB.
  crew.run([&] { march_in_sequence(order, visit, options); });
}

void march_by_choice(const WindowOrder& order, const VisitWindow& visit, const PickReady& pick) {
  std::vector<std::size_t> missing(order.size());
  std::vector<Index3> ready;
  for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
    missing[rank] = order.predecessors(order.window(rank)).size();
    if (missing[rank] == 0) ready.push_back(order.window(rank));
  }
  while (!ready.empty()) {
    const std::size_t choice = pick(ready);
    MW_ASSERT(choice < ready.size());
    const Index3 w = ready[choice];
    ready[choice] = ready.back();
    ready.pop_back();
    visit(w);
    for (Index3 s : order.successors(w)) {
      if (--missing[order.rank(s)] == 0) ready.push_back(s);
    }
  }
}

}  // namespace mw::engine
