// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/marches.h"

#include <atomic>

#include "engine/march/march.h"
#include "engine/system/memory.h"

namespace mw::engine {
namespace {

double seconds_between(Visited::Time a, Visited::Time b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

std::uint64_t Marches::own_windows() const {
  std::uint64_t count = 0;
  for (std::uint32_t march = 0; march < run_.layout.marches(); ++march) {
    for_each_index(run_.layout.grid(march).windows(), [&](Index3 w) {
      if (run_.part->visits({march, w})) ++count;
    });
  }
  return count;
}

/// Returns whether an earlier run has left what a visit of the window would.
bool Marches::recalls(const WindowKey& key) const {
  return run_.keep != nullptr && run_.keep->recalls(key);
}

bool Marches::adopt(const WindowKey& key) const {
  if (run_.keep == nullptr) return false;
  const auto places = run_.keep->recalled(key);
  if (!places) return false;
  run_.store.adopt(key, *places);
  return true;
}

std::uint64_t Marches::most_to_come(const WindowOrder& order, BlockStore& store,
                                    const WindowNeeds& needs) const {
  constexpr std::uint64_t kMostSeen = 1 << 14;  // so that a huge volume is refused in seconds, too
  std::map<std::array<std::int64_t, 3>, StartSize> sizes;
  WindowNeeds cached = needs;
  cached.start_size = [&](Index3 block) {
    const auto [at, is_new] = sizes.try_emplace({block.x, block.y, block.z});
    if (is_new) at->second = needs.start_size(block);
    return at->second;
  };
  std::uint64_t seen = 0, most = 0;
  for_each_index(order.grid().windows(), [&](Index3 window) {
    if (seen >= kMostSeen || store.is_done(window)) return;
    ++seen;
    most = std::max(most, window_bytes(order.grid(), window, store, cached));
  });
  // Final blocks are a part of what windows begin with, and what is stored takes a little, too.
  constexpr std::uint64_t kPartWritten = 8, kStored = 1U << 20U;
  return std::max(most, run_.sink.buffer_bytes() + most / kPartWritten) + kStored;
}

AdmitWindow Marches::admission(const WindowOrder& order, BlockStore& store,
                               const WindowVisitor& visitor) {
  const std::uint64_t budget = run_.hooks.store.memory;
  const bool is_ample = budget_is_ample(budget, order.grid(), run_.hooks.threads);
  if (!is_ample && run_.hooks.owns_process) return_large_pieces_at_once();
  const WindowNeeds needs{.start_size =
                              [&order, &visitor, is_ample](Index3 block) {
                                return is_ample ? max_start_size(order.grid(), block)
                                                : visitor.start_size(block);
                              },
                          .max_distance = visitor.max_distance(),
                          .has_source = visitor.has_source()};
  return [this, &order, &store, needs, is_ample, budget](Index3 window) -> Admission {
    const std::uint64_t bytes = window_bytes(order.grid(), window, store, needs);
    if (!is_ample && bytes < budget) return_free_memory_above(budget - bytes);
    const auto most = [&] { return most_to_come(order, store, needs); };
    needed_[{window.x, window.y, window.z}] = bytes;
    if (!store.admit(window, bytes, most)) return nullptr;
    return std::make_shared<Index3>(window);
  };
}

void Marches::visit_all(std::uint32_t march_number, const WindowVisitor& visitor) {
  BlockStore& store = run_.store.march(march_number);
  const WindowOrder order = run_.layout.order(march_number);
  const IsFinished is_done = [&](Index3 w) { return store.is_done(w); };
  forecast_.begin_march([&](Index3 w) {
    return !run_.part->visits({march_number, w}) || is_done(w);
  });
  const AdmitWindow admit_visit = admission(order, store, visitor);
  const AdmitWindow admit = [&](Index3 window) -> Admission {
    if (recalls({march_number, window})) return std::make_shared<Index3>(window);
    return admit_visit(window);
  };
  // Once a window has failed nobody will ask for the results of others.
  std::atomic<bool> failed = false;
  const VisitWindow visit = [&](Index3 window) {
    if (failed) return;
    try {
      if (adopt({march_number, window})) return;
      if (run_.hooks.before_visit) run_.hooks.before_visit(window);
      add(visitor.visit(window));
    } catch (...) {
      failed = true;
      throw;
    }
  };
  const OnVisited tell = [&](const Visited& v) { note(march_number, v); };
  if (run_.hooks.pick) {
    const VisitWindow visit_and_tell = [&](Index3 w) {
      const Admission admission = admit(w);
      tell(timed_visit(visit, w, 0));
    };
    march_by_choice(order, visit_and_tell, run_.hooks.pick);
    return;
  }
  MarchOptions options{
      .threads = run_.hooks.threads, .admit = admit, .visited = tell, .finished_before = is_done};
  const std::optional<PartialMarch> part = run_.part->part_of_march(march_number);
  if (part) options.part = &*part;
  march(order, visit, options);
}

void Marches::add(const VisitStats& visit) {
  const std::lock_guard lock(mutex_);
  stats_ += visit;
}

void Marches::note(std::uint32_t march_number, const Visited& v) {
  const auto needed = needed_.extract({v.window.x, v.window.y, v.window.z});
  if (run_.hooks.trace) {
    run_.hooks.trace({.march = static_cast<int>(march_number),
                      .window = v.window,
                      .start_seconds = seconds_between(begin_, v.start),
                      .end_seconds = seconds_between(begin_, v.end),
                      .cpu_seconds = v.cpu_seconds,
                      .slot = v.slot,
                      .bytes = needed ? needed.mapped() : 0});
  }
  ++done_;
  if (!run_.hooks.progress) return;
  if (!total_) total_ = own_windows();
  forecast_.visited(v.window);
  run_.hooks.progress({.done = done_, .total = *total_, .seconds_left = forecast_.seconds_left()});
}

}  // namespace mw::engine
