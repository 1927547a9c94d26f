// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/marches.h"

#include <atomic>

#include "engine/march/timed_visit.h"
#include "engine/system/resident_memory.h"
#include "engine/window/window_memory.h"

namespace mw::engine {
namespace {

double seconds_between(Visited::Time a, Visited::Time b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

std::uint64_t Marches::own_windows() const {
  if (traffic_ == nullptr) return layout_.windows();
  std::uint64_t count = 0;
  for (std::uint32_t march = 0; march < layout_.marches(); ++march) {
    for_each_index(layout_.grid(march).windows(), [&](Index3 w) {
      if (is_mine({march, w})) ++count;
    });
  }
  return count;
}

AdmitWindow Marches::admission(const WindowOrder& order, BlockStore& store,
                               const WindowVisitor& visitor) const {
  const std::uint64_t budget = hooks_.store.memory;
  const bool is_ample = budget_is_ample(budget, order.grid(), thread_count(hooks_.threads));
  if (!is_ample && hooks_.owns_process) return_large_pieces_at_once();
  const WindowNeeds needs{.start_size =
                              [&order, &visitor, is_ample](Index3 block) {
                                return is_ample ? max_start_size(order.grid(), block)
                                                : visitor.start_size(block);
                              },
                          .max_distance = visitor.max_distance()};
  return [&order, &store, needs, is_ample, budget](Index3 window) -> Admission {
    const std::uint64_t bytes = window_bytes(order.grid(), window, store, needs);
    if (!is_ample && bytes < budget) return_free_memory_above(budget - bytes);
    if (!store.admit(window, bytes)) return nullptr;
    return std::make_shared<Index3>(window);
  };
}

void Marches::run(std::uint32_t march_number, BlockStore& store, const WindowVisitor& visitor) {
  const WindowOrder order = layout_.order(march_number);
  const IsFinished is_done = [&](Index3 w) { return store.is_done(w); };
  forecast_.begin_march([&](Index3 w) { return !is_mine({march_number, w}) || is_done(w); });
  const AdmitWindow admit = admission(order, store, visitor);
  // Once a window has failed nobody will ask for the results of others.
  std::atomic<bool> failed = false;
  const VisitWindow visit = [&](Index3 window) {
    if (failed) return;
    try {
      if (hooks_.before_visit) hooks_.before_visit(window);
      add(visitor.visit(window));
    } catch (...) {
      failed = true;
      throw;
    }
  };
  const OnVisited tell = [&](const Visited& v) { note(march_number, v); };
  if (hooks_.pick) {
    const VisitWindow visit_and_tell = [&](Index3 w) {
      const Admission admission = admit(w);
      tell(timed_visit(visit, w, 0));
    };
    march_by_choice(order, visit_and_tell, hooks_.pick);
    return;
  }
  MarchOptions options{
      .threads = hooks_.threads, .admit = admit, .visited = tell, .finished_before = is_done};
  MarchShare share{.march = march_number};
  if (traffic_ != nullptr) {
    share.is_mine = [&](Index3 w) { return is_mine({march_number, w}); };
    share.inputs = [&](Index3 w) { return traffic_->inputs({march_number, w}); };
    share.arrivals = &traffic_->arrivals();
    options.share = &share;
  }
  march(order, visit, options);
}

void Marches::add(const VisitStats& visit) {
  const std::lock_guard lock(mutex_);
  stats_ += visit;
}

void Marches::note(std::uint32_t march_number, const Visited& v) {
  if (hooks_.trace) {
    hooks_.trace({.march = static_cast<int>(march_number),
                  .window = v.window,
                  .start_seconds = seconds_between(begin_, v.start),
                  .end_seconds = seconds_between(begin_, v.end),
                  .cpu_seconds = v.cpu_seconds,
                  .slot = v.slot});
  }
  ++done_;
  if (!hooks_.progress) return;
  if (!total_) total_ = own_windows();
  forecast_.visited(v.window);
  hooks_.progress({.done = done_, .total = *total_, .seconds_left = forecast_.seconds_left()});
}

}  // namespace mw::engine
