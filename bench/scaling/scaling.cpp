// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where it would go on more cores: measured durations of windows, simulated schedules.
//   mwmesh mesh VOLUME -o OUT.vtkhdf --threads 1 --trace T.csv --report R.json
//   mw_scaling T.csv [--report R.json [--memory M] [--traffic BYTES --bandwidth BYTES]]
//              [--order ORDER] [--wall] [--look-ahead N]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>

#include "bench/scaling/list_schedule.h"
#include "bench/scaling/stage_table.h"
#include "bench/scaling/trace_table.h"
#include "engine/march/wavefront.h"
#include "kernels/core/error.h"

namespace mw::bench {
namespace {

using engine::Order;
using engine::WindowOrder;

struct Job {
  std::string trace;
  std::string report;  ///< if empty, there are windows only
  Order order = Order::kColour;
  bool wall = false;
  std::uint64_t look_ahead = 0;  ///< 0: the march's own
  std::uint64_t memory = 0;      ///< of the run (--memory); 0: no window waits
  double traffic = 0.0;          ///< bytes between memory and caches in the run; 0: unknown
  double bandwidth = 0.0;        ///< bytes a second
};

WindowOrder order_of(Index3 windows, Order order) {
  // A grid of that many windows: one block more along each axis, blocks of one voxel.
  return {engine::WindowGrid(windows + Index3{1, 1, 1}, 2), order};
}

/// Returns values of windows, of which the first are x fastest, in the order of their visits.
template <typename Value>
std::vector<Value> by_rank(const std::vector<Value>& values, const WindowOrder& order) {
  std::vector<Value> out(values.size());
  for (std::uint64_t rank = 0; rank < out.size(); ++rank) {
    out[rank] = values[raster(order.window(rank), order.grid().windows())];
  }
  return out;
}

/// What was measured.
struct Measured {
  std::vector<MarchTrace> marches;
  std::vector<engine::StageCost> stages;
  std::uint64_t held_bytes = 0;  ///< beside windows, blocks and output
};

double seconds_of_one_core(const Measured& run) {
  double sum = seconds_beside_visits(run.stages, 1);
  for (const MarchTrace& march : run.marches) {
    sum = std::accumulate(march.seconds.begin(), march.seconds.end(), sum);
  }
  return sum;
}

/// Returns how many cores work at a time.
std::size_t fed(const Measured& run, std::size_t cores, const Job& job) {
  if (job.traffic == 0.0) return cores;
  return fed_cores(cores, job.traffic, seconds_of_one_core(run), job.bandwidth);
}

/// Returns the room for windows that run.
std::uint64_t window_budget(const Measured& run, const Job& job) {
  if (job.memory == 0) return std::numeric_limits<std::uint64_t>::max();
  return job.memory - std::min(job.memory, run.held_bytes);
}

/// One stage after the other, with nothing of the next before the last of this.
double predicted_seconds(const Measured& run, std::size_t cores, const Job& job) {
  double sum = seconds_beside_visits(run.stages, cores);
  const std::uint64_t look_ahead =
      job.look_ahead > 0 ? job.look_ahead : engine::default_look_ahead(cores);
  for (const MarchTrace& march : run.marches) {
    const WindowOrder windows = order_of(march.windows, job.order);
    const std::vector<std::uint64_t> bytes = by_rank(march.bytes, windows);
    sum += list_schedule(windows, by_rank(march.seconds, windows), cores, look_ahead,
                         {.bytes = bytes, .budget = window_budget(run, job)});
  }
  return sum;
}

void print_march(const MarchTrace& march, std::size_t number, const Job& job) {
  const WindowOrder order = order_of(march.windows, job.order);
  const double work = std::accumulate(march.seconds.begin(), march.seconds.end(), 0.0);
  const Index3 w = march.windows;
  std::cout << "| " << number << " | " << w.x << " x " << w.y << " x " << w.z << " | "
            << order.steps() << " | " << work << " | "
            << longest_path(order, by_rank(march.seconds, order)) << " | "
            << *std::max_element(march.bytes.begin(), march.bytes.end()) << " |\n";
}

void print_stages(const std::vector<engine::StageCost>& stages) {
  if (stages.empty()) return;
  double sum = 0.0;
  for (const engine::StageCost& stage : stages) sum += stage.cpu_seconds;
  std::cout << "\n| stage | processor s | alone s | of the whole run, alone |\n|---|---|---|---|\n";
  for (const engine::StageCost& stage : stages) {
    std::cout << "| " << stage.name << " | " << stage.cpu_seconds << " | " << stage.alone_seconds
              << " | " << 100 * stage.alone_seconds / sum << " % |\n";
  }
}

void print_prediction(const Measured& run, const Job& job) {
  const double one = predicted_seconds(run, 1, job);
  for (std::size_t cores = 1; cores <= 128; cores *= 2) {
    const double many = predicted_seconds(run, fed(run, cores, job), job);
    std::cout << "| " << cores << " | " << many << " | " << one / many << " | "
              << 100 * one / many / static_cast<double>(cores) << " % |\n";
  }
}

std::ifstream opened(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw Error(ErrorKind::kInput, path + ": cannot be read");
  return in;
}

Measured read(const Job& job) {
  std::ifstream trace = opened(job.trace);
  Measured out{.marches = read_trace(trace, job.wall ? Clock::kWall : Clock::kCpu),
               .stages = {},
               .held_bytes = 0};
  if (job.report.empty()) return out;
  std::ifstream report = opened(job.report);
  const std::string text{std::istreambuf_iterator<char>(report), {}};
  out.stages = read_stages(text, job.report);
  out.held_bytes = read_held_bytes(text, job.report);
  return out;
}

void report(const Job& job) {
  const Measured run = read(job);
  std::cout << std::setprecision(4) << "Windows of " << job.trace << ", "
            << (job.order == Order::kRaster ? "raster" : "colour") << " order, "
            << (job.wall ? "wall" : "processor") << " seconds"
            << (job.report.empty() ? ", and nothing beside them" : "") << ".\n\n"
            << "| march | windows | steps | work s | longest path s | most bytes of a window |\n"
            << "|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < run.marches.size(); ++i) print_march(run.marches[i], i, job);
  print_stages(run.stages);
  if (job.traffic > 0.0) {
    std::cout << "\nMemory feeds at most " << fed(run, std::numeric_limits<int>::max(), job)
              << " cores.\n";
  }
  std::cout << "\n| cores | seconds | speed-up | efficiency |\n"
            << "|---|---|---|---|\n";
  print_prediction(run, job);
}

void add_options(CLI::App& app, Job& job) {
  const std::map<std::string, engine::Order> orders{{"raster", engine::Order::kRaster},
                                                    {"colour", engine::Order::kColour}};
  app.add_option("TRACE", job.trace, "written by mwmesh mesh --trace")->required();
  app.add_option("--order", job.order, "in which the trace was taken")
      ->transform(CLI::CheckedTransformer(orders));
  app.add_flag("--wall", job.wall, "wall instead of processor time of windows");
  CLI::Option* report = app.add_option(
      "--report", job.report, "of the same run, with one thread: adds all that is not a window");
  app.add_option("--memory", job.memory,
                 "of the same run, as 2G: windows wait for room, as they would")
      ->transform(CLI::AsSizeValue(false))
      ->needs(report);
  CLI::Option* traffic =
      app.add_option("--traffic", job.traffic,
                     "bytes that the run moves between memory and caches (bench/scaling/README.md)")
          ->check(CLI::PositiveNumber);
  app.add_option("--bandwidth", job.bandwidth, "bytes a second of the machine's memory")
      ->check(CLI::PositiveNumber)
      ->needs(traffic);
  traffic->needs("--bandwidth");
  app.add_option("--look-ahead", job.look_ahead,
                 "of the march, in windows; by default the march's own")
      ->check(CLI::PositiveNumber);
}

}  // namespace
}  // namespace mw::bench

int main(int argc, char** argv) {
  try {
    mw::bench::Job job;
    CLI::App app("predicts the march's speed-up on more cores from a trace, as Markdown");
    mw::bench::add_options(app, job);
    CLI11_PARSE(app, argc, argv);
    mw::bench::report(job);
  } catch (const std::exception& error) {
    std::cerr << "mw_scaling: error: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
