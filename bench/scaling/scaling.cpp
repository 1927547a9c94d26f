// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where it would go on more cores: measured durations of windows, simulated schedules.
//   mwmesh mesh VOLUME -o OUT.vtu --threads 1 --trace T.csv
//   mw_scaling T.csv [--order ORDER] [--wall] [--serial SECONDS] [--look-ahead N]
#include <CLI/CLI.hpp>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <numeric>

#include "bench/scaling/list_schedule.h"
#include "bench/scaling/trace_table.h"
#include "engine/march/wavefront.h"
#include "kernels/core/error.h"

namespace mw::bench {
namespace {

using engine::Order;
using engine::WindowOrder;

struct Job {
  std::string trace;
  Order order = Order::kRaster;
  bool wall = false;
  double serial = 0.0;
  std::uint64_t look_ahead = 0;  ///< 0: the march's own
};

WindowOrder order_of(Index3 windows, Order order) {
  // A grid of that many windows: one block more along each axis, blocks of one voxel.
  return {engine::WindowGrid(windows + Index3{1, 1, 1}, 2), order};
}

std::vector<double> by_rank(const MarchTrace& march, const WindowOrder& order) {
  std::vector<double> out(march.seconds.size());
  for (std::uint64_t rank = 0; rank < out.size(); ++rank) {
    out[rank] = march.seconds[raster(order.window(rank), march.windows)];
  }
  return out;
}

/// One march after the other, with nothing of the next before the last of this.
double predicted_seconds(const std::vector<MarchTrace>& marches, std::size_t cores,
                         const Job& job) {
  double sum = job.serial;
  const std::uint64_t look_ahead =
      job.look_ahead > 0 ? job.look_ahead : engine::default_look_ahead(cores);
  for (const MarchTrace& march : marches) {
    const WindowOrder windows = order_of(march.windows, job.order);
    sum += list_schedule(windows, by_rank(march, windows), cores, look_ahead);
  }
  return sum;
}

void print_march(const MarchTrace& march, std::size_t number, const Job& job) {
  const WindowOrder order = order_of(march.windows, job.order);
  const double work = std::accumulate(march.seconds.begin(), march.seconds.end(), 0.0);
  const Index3 w = march.windows;
  std::cout << "| " << number << " | " << w.x << " x " << w.y << " x " << w.z << " | "
            << order.steps() << " | " << work << " | " << longest_path(order, by_rank(march, order))
            << " |\n";
}

void print_prediction(const std::vector<MarchTrace>& marches, const Job& job) {
  const double one = predicted_seconds(marches, 1, job);
  for (std::size_t cores = 1; cores <= 128; cores *= 2) {
    const double many = predicted_seconds(marches, cores, job);
    std::cout << "| " << cores << " | " << many << " | " << one / many << " | "
              << 100 * one / many / static_cast<double>(cores) << " % |\n";
  }
}

void report(const Job& job) {
  std::ifstream in(job.trace);
  if (!in) throw Error(ErrorKind::kInput, job.trace + ": cannot be read");
  const std::vector<MarchTrace> marches = read_trace(in, job.wall ? Clock::kWall : Clock::kCpu);
  std::cout << std::setprecision(4) << "Windows of " << job.trace << ", "
            << (job.order == Order::kRaster ? "raster" : "colour") << " order, "
            << (job.wall ? "wall" : "processor") << " seconds; " << job.serial
            << " s besides windows that do not scale.\n\n"
            << "| march | windows | steps | work s | longest path s |\n"
            << "|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < marches.size(); ++i) print_march(marches[i], i, job);
  std::cout << "\n| cores | seconds | speed-up | efficiency |\n"
            << "|---|---|---|---|\n";
  print_prediction(marches, job);
}

void add_options(CLI::App& app, Job& job) {
  const std::map<std::string, engine::Order> orders{{"raster", engine::Order::kRaster},
                                                    {"colour", engine::Order::kColour}};
  app.add_option("TRACE", job.trace, "written by mwmesh mesh --trace")->required();
  app.add_option("--order", job.order, "in which the trace was taken")
      ->transform(CLI::CheckedTransformer(orders));
  app.add_flag("--wall", job.wall, "wall instead of processor time of windows");
  app.add_option("--serial", job.serial, "seconds of the run besides windows")
      ->check(CLI::NonNegativeNumber);
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
