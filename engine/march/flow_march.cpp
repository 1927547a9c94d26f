// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A loop of two nodes: the keeper, called one at a time, sends windows; the visitor, called by many
// threads at once, sends outcomes back.
#include "engine/march/march.h"

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <memory>
#include <tuple>

#include "engine/system/crew.h"

namespace mw::engine {
namespace {

namespace flow = oneapi::tbb::flow;

/// What the visitor sends to the keeper.  Without a visit it says that inputs came in.
struct Outcome {
  std::optional<Visited> visited;
  std::exception_ptr error;
};

using Visitor = flow::function_node<Index3, Outcome>;
using Keeper = flow::multifunction_node<Outcome, std::tuple<Index3>>;

Outcome visit_window(const VisitWindow& visit, Index3 window) {
  try {
    return {timed_visit(visit, window, oneapi::tbb::this_task_arena::current_thread_index()), {}};
  } catch (...) {
    return {Visited{.window = window, .start = {}, .end = {}}, std::current_exception()};
  }
}

/// The keeper's state: what runs, what is ready, and the first error.  Called by one thread at a
/// time.
class Dispatcher {
 public:
  Dispatcher(const WindowOrder& order, const MarchOptions& options, int threads)
      : order_(order), options_(options), threads_(static_cast<std::size_t>(threads)) {
    const std::uint64_t ahead =
        options.look_ahead > 0 ? options.look_ahead : default_look_ahead(threads_);
    if (options.part == nullptr) {
      front_ = std::make_unique<Wavefront>(order, ahead, options.finished_before);
    } else {
      auto front =
          std::make_unique<ArrivalFront>(order, *options.part, ahead, options.finished_before);
      arrival_front_ = front.get();
      front_ = std::move(front);
    }
  }

  /// Takes an outcome in.
  void finish(const Outcome& outcome) {
    if (!outcome.visited) return look_at_arrivals();
    const std::uint64_t rank = order_.rank(outcome.visited->window);
    std::erase_if(running_, [&](const Running& r) { return r.rank == rank; });
    if (outcome.error) return note(rank, outcome.error);
    front_->finish(rank);
    if (error_ || !options_.visited) return;
    try {
      options_.visited(*outcome.visited);
    } catch (...) {
      note(rank, std::current_exception());
    }
  }

  /// Returns the next window to send, which then counts as running; nothing when all threads are
  /// busy or no window may start.
  [[nodiscard]] std::optional<Index3> next() {
    if (error_ || running_.size() == threads_) return std::nullopt;
    const std::optional<std::uint64_t> rank =
        window_to_start(*front_, [&](std::uint64_t r) { return !error_ && try_start(r); });
    return rank ? std::optional(order_.window(*rank)) : std::nullopt;
  }

  /// Notes an error of the march itself, for instance that memory ran out.  Any error of a window
  /// comes before it.
  void fail(std::exception_ptr error) { note(order_.size(), std::move(error)); }

  /// True if inputs from other processes may still come that make windows ready.
  [[nodiscard]] bool waits() const {
    return arrival_front_ != nullptr && !error_ && front_->first_unfinished() < order_.size();
  }

  void rethrow_error() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  struct Running {
    std::uint64_t rank = 0;
    Admission admission;
  };

  /// Returns false when the window was refused or the hook threw.
  bool try_start(std::uint64_t rank) {
    Admission admission;
    try {
      if (options_.admit) admission = options_.admit(order_.window(rank));
    } catch (...) {
      note(rank, std::current_exception());
      return false;
    }
    // In a part of a march, blocks on their way may hold the room; then the march asks again.
    const bool must_start =
        arrival_front_ == nullptr && running_.empty() && rank == front_->first_unfinished();
    if (options_.admit && !admission && !must_start) return false;
    front_->start(rank);
    running_.push_back({rank, std::move(admission)});
    return true;
  }

  void look_at_arrivals() {
    if (const auto error = options_.part->arrivals->error()) fail(error);
    arrival_front_->poll();
  }

  void note(std::uint64_t rank, std::exception_ptr error) {
    if (error_ && error_rank_ <= rank) return;
    error_ = std::move(error);
    error_rank_ = rank;
  }

  const WindowOrder& order_;
  const MarchOptions& options_;
  std::size_t threads_;
  std::unique_ptr<Front> front_;
  ArrivalFront* arrival_front_ = nullptr;  ///< front_ if this is a part of a march
  std::vector<Running> running_;
  std::exception_ptr error_;
  std::uint64_t error_rank_ = 0;
};

/// Keeps a graph alive while inputs may come from other processes, and wakes it when they do.
class Waiting {
 public:
  Waiting(flow::graph& graph, const Dispatcher& dispatcher, Arrivals* arrivals)
      : graph_(graph), dispatcher_(dispatcher), arrivals_(arrivals) {
    if (arrivals_ != nullptr) graph_.reserve_wait();
  }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
  ~Waiting() { end(); }

  /// Makes arrivals wake the keeper, which may be at work before this returns.
  void begin(Keeper& keeper) {
    if (arrivals_ != nullptr) arrivals_->on_wake([&keeper] { keeper.try_put(Outcome{}); });
  }
  /// The keeper calls this after each outcome.
  void release_if_over() {
    if (!dispatcher_.waits()) release();
  }
  /// ENSURES: arrivals do not wake the graph any more; messages on their way still have to run.
  void end() {
    if (arrivals_ != nullptr) arrivals_->on_wake({});
    release();
  }

 private:
  void release() {
    if (arrivals_ != nullptr && !released_.exchange(true)) graph_.release_wait();
  }

  flow::graph& graph_;
  const Dispatcher& dispatcher_;
  Arrivals* arrivals_;
  std::atomic<bool> released_ = false;
};

/// Runs the graph in the calling thread's arena.  arrivals is null if all windows are visited here.
void run_graph(Dispatcher& dispatcher, const VisitWindow& visit, Arrivals* arrivals) {
  flow::graph graph;
  Visitor visitor(graph, flow::unlimited,
                  [&](Index3 window) { return visit_window(visit, window); });
  Waiting* waits = nullptr;
  Keeper keeper(graph, flow::serial, [&](const Outcome& outcome, Keeper::output_ports_type& out) {
    try {
      dispatcher.finish(outcome);
      while (const auto window = dispatcher.next()) std::get<0>(out).try_put(*window);
    } catch (...) {
      // If it left this body, nobody would end the wait for inputs.
      dispatcher.fail(std::current_exception());
    }
    waits->release_if_over();
  });
  Waiting waiting(graph, dispatcher, arrivals);  // it goes before the keeper that arrivals wake
  waits = &waiting;
  flow::make_edge(visitor, keeper);
  flow::make_edge(flow::output_port<0>(keeper), visitor);
  // All first windows are chosen before one is sent, since from then on the keeper may be at work.
  std::vector<Index3> first;
  while (const auto window = dispatcher.next()) first.push_back(*window);
  waiting.begin(keeper);
  try {
    for (Index3 window : first) visitor.try_put(window);
    // The keeper has to look at what came in meanwhile, and to see if there is nothing to do.
    if (arrivals != nullptr) arrivals->wake();
    graph.wait_for_all();
  } catch (...) {
    // There was no memory for a message: those that were sent must end before the nodes go.
    waiting.end();
    graph.cancel();
    graph.wait_for_all();
    throw;
  }
  waiting.end();
  graph.wait_for_all();
}

}  // namespace

void flow_march(const WindowOrder& order, const VisitWindow& visit, const MarchOptions& options,
                Crew& crew) {
  Dispatcher dispatcher(order, options, crew.size());
  Arrivals* arrivals = options.part == nullptr ? nullptr : options.part->arrivals;
  crew.run([&] { run_graph(dispatcher, visit, arrivals); });
  dispatcher.rethrow_error();
}

}  // namespace mw::engine
