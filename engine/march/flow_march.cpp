// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A loop of two nodes: the keeper, one call at a time, sends windows; the visitor, many at once,
// sends outcomes back.
#include "engine/march/flow_march.h"

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/task_arena.h>

#include <exception>
#include <tuple>

#include "engine/march/timed_visit.h"

namespace mw::engine {
namespace {

namespace flow = oneapi::tbb::flow;

/// What the visitor sends to the keeper.
struct Outcome {
  Visited visited;
  std::exception_ptr error;
};

using Visitor = flow::function_node<Index3, Outcome>;
using Keeper = flow::multifunction_node<Outcome, std::tuple<Index3>>;

Outcome visit_window(const VisitWindow& visit, Index3 window) {
  try {
    return {timed_visit(visit, window, oneapi::tbb::this_task_arena::current_thread_index()), {}};
  } catch (...) {
    return {{.window = window, .start = {}, .end = {}}, std::current_exception()};
  }
}

/// The keeper's state: what runs, what is ready, and the first error.  Called by one thread at a
/// time.
class Dispatcher {
 public:
  Dispatcher(const WindowOrder& order, const MarchOptions& options, int threads)
      : order_(order),
        options_(options),
        threads_(static_cast<std::size_t>(threads)),
        wavefront_(order,
                   options.look_ahead > 0 ? options.look_ahead : default_look_ahead(threads_),
                   options.finished_before) {}

  /// Takes an outcome in.
  void finish(const Outcome& outcome) {
    const std::uint64_t rank = order_.rank(outcome.visited.window);
    std::erase_if(running_, [&](const Running& r) { return r.rank == rank; });
    if (outcome.error) return note(rank, outcome.error);
    wavefront_.finish(rank);
    if (error_ || !options_.visited) return;
    try {
      options_.visited(outcome.visited);
    } catch (...) {
      note(rank, std::current_exception());
    }
  }

  /// The next window to send, which then counts as running; nothing when all threads are busy or
  /// no window may start.
  [[nodiscard]] std::optional<Index3> next() {
    if (error_ || running_.size() == threads_) return std::nullopt;
    const std::optional<std::uint64_t> best = wavefront_.best();
    if (!best) return std::nullopt;
    if (try_start(*best)) return order_.window(*best);
    const std::uint64_t first = wavefront_.first_unfinished();
    if (error_ || !wavefront_.is_ready(first) || !try_start(first)) return std::nullopt;
    return order_.window(first);
  }

  void rethrow_error() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  struct Running {
    std::uint64_t rank = 0;
    Admission admission;
  };

  /// False when the window was refused or the hook threw.
  bool try_start(std::uint64_t rank) {
    Admission admission;
    try {
      if (options_.admit) admission = options_.admit(order_.window(rank));
    } catch (...) {
      note(rank, std::current_exception());
      return false;
    }
    const bool must_start = running_.empty() && rank == wavefront_.first_unfinished();
    if (options_.admit && !admission && !must_start) return false;
    wavefront_.start(rank);
    running_.push_back({rank, std::move(admission)});
    return true;
  }

  void note(std::uint64_t rank, std::exception_ptr error) {
    if (error_ && error_rank_ <= rank) return;
    error_ = std::move(error);
    error_rank_ = rank;
  }

  const WindowOrder& order_;
  const MarchOptions& options_;
  std::size_t threads_;
  Wavefront wavefront_;
  std::vector<Running> running_;
  std::exception_ptr error_;
  std::uint64_t error_rank_ = 0;
};

/// Runs the graph in the calling thread's arena.
void run_graph(Dispatcher& dispatcher, const VisitWindow& visit) {
  flow::graph graph;
  Visitor visitor(graph, flow::unlimited,
                  [&](Index3 window) { return visit_window(visit, window); });
  Keeper keeper(graph, flow::serial, [&](const Outcome& outcome, Keeper::output_ports_type& out) {
    dispatcher.finish(outcome);
    while (const auto window = dispatcher.next()) std::get<0>(out).try_put(*window);
  });
  flow::make_edge(visitor, keeper);
  flow::make_edge(flow::output_port<0>(keeper), visitor);
  // All of the first windows are chosen before one is sent: from then on the keeper may be at work.
  std::vector<Index3> first;
  while (const auto window = dispatcher.next()) first.push_back(*window);
  try {
    for (Index3 window : first) visitor.try_put(window);
  } catch (...) {
    // No memory for a message: those that were sent must be over before the nodes go.
    graph.cancel();
    graph.wait_for_all();
    throw;
  }
  graph.wait_for_all();
}

}  // namespace

void flow_march(const WindowOrder& order, const VisitWindow& visit, const MarchOptions& options,
                Crew& crew) {
  Dispatcher dispatcher(order, options, crew.size());
  crew.run([&] { run_graph(dispatcher, visit); });
  dispatcher.rethrow_error();
}

}  // namespace mw::engine
