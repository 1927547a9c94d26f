// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where it would go on more machines: measured durations of windows, simulated ranks.
//   mwmesh mesh VOLUME -o OUT.vtu --threads 1 --order ORDER --trace T.csv
//   mw_scale_out T.csv --order ORDER [--shape X,Y,Z] [--ranks 1,2,4] [--cores 16]
// bench/scaling/README.md tells what the columns mean.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <numeric>

#include "bench/scaling/layouts.h"
#include "bench/scaling/sleeping_run.h"
#include "bench/scaling/team_schedule.h"
#include "bench/scaling/visit_classes.h"
#include "kernels/core/error.h"

namespace mw::bench {
namespace {

using engine::Order;

struct Job {
  std::string trace;
  Order order = Order::kRaster;
  std::vector<std::int64_t> shape;  ///< empty: the trace's own run
  int window = 32;
  bool wall = false;
  std::uint64_t seed = 1;
  double factor = 1.0;
  std::int64_t cut_every = 1;
  std::int64_t stand_in = 1;  ///< for a volume that is this many times as long
  double sleep_ms = 0.0;      ///< on the average; 0: nobody sleeps
  std::vector<int> ranks{1, 2, 4, 8, 16, 32, 64, 128, 256};
  Machines machines{.cores = 16, .latency = 1e-4, .block_bytes = {36e3, 160e3}};
};

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::vector<MarchTrace> trace_of(const Job& job) {
  std::ifstream in(job.trace);
  if (!in) throw Error(ErrorKind::kInput, job.trace + ": cannot be read");
  return read_trace(in, job.wall ? Clock::kWall : Clock::kCpu);
}

/// The run that is played.
struct Play {
  RunFlow flow;
  std::vector<double> seconds;
};

Play play_of(const Job& job) {
  const std::vector<MarchTrace> trace = trace_of(job);
  RunFlow traced(traced_layout(trace, job.order));
  std::vector<double> seconds = traced_seconds(traced, trace);
  for (double& s : seconds) s *= job.factor;
  if (job.shape.empty()) return {std::move(traced), std::move(seconds)};
  const Index3 volume{job.shape[0], job.shape[1], job.shape[2]};
  RunFlow flow(run_layout(volume, job.window, traced.layout().marches(), job.order));
  std::vector<double> drawn = VisitClasses(traced, seconds).draw(flow, job.seed);
  return {std::move(flow), std::move(drawn)};
}

void print_run(const Job& job, const Play& play) {
  std::cout << "Windows of " << job.trace << ", "
            << (job.order == Order::kRaster ? "raster" : "colour") << " order; "
            << play.flow.windows() << " windows, " << sum(play.seconds) << " s of work, "
            << longest_path(play.flow, play.seconds) << " s along the longest path; "
            << job.machines.cores << " cores a rank, " << 1e6 * job.machines.latency << " us, "
            << job.machines.bandwidth / 1e9 << " GB/s.\n\n";
}

std::uint64_t total(const std::vector<std::uint64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

double most(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

engine::Partition partition_of(const Job& job, const Play& play, int ranks) {
  if (job.stand_in == 1 || job.cut_every > 1) {
    return deal(play.flow, play.seconds, job.order, ranks, job.cut_every);
  }
  const Index3 v = play.flow.layout().grid(0).volume();
  const std::int64_t n = job.stand_in;
  const Index3 whole{v.x * n, v.y * n, v.z * n};
  return deal_like(play.flow, run_layout(whole, job.window, 1, job.order), job.order, ranks);
}

void print_predictions(const Job& job, const Play& play) {
  const double work = sum(play.seconds);
  const double path = longest_path(play.flow, play.seconds);
  std::cout
      << "| ranks | seconds | speed-up | efficiency | at most | parcels | GB | GB of one rank "
         "| GB held by one rank | GB to rank 0 |\n"
      << "|---|---|---|---|---|---|---|---|---|---|\n";
  for (int ranks : job.ranks) {
    Machines machines = job.machines;
    machines.ranks = ranks;
    const TeamSchedule s =
        team_schedule(play.flow, play.seconds, partition_of(job, play, ranks), machines);
    const double cores = static_cast<double>(machines.cores) * ranks;
    std::cout << "| " << ranks << " | " << s.seconds << " | " << work / s.seconds << " | "
              << 100 * work / s.seconds / cores << " % | " << std::min(cores, work / path) << " | "
              << total(s.parcels) << " | " << sum(s.bytes) / 1e9 << " | " << most(s.bytes) / 1e9
              << " | " << most(s.held) / 1e9 << " | " << s.output_bytes / 1e9 << " |" << std::endl;
  }
}

/// How many times the work volumes N times as long have: windows are counted, march by march.
double growth(const Job& job, const Play& play) {
  const engine::RunLayout& layout = play.flow.layout();
  const Index3 v = layout.grid(0).volume();
  const std::int64_t n = job.stand_in;
  double work = 0.0;
  for (std::uint32_t march = 0; march < layout.marches(); ++march) {
    const auto first = play.seconds.begin();
    const double here =
        std::accumulate(first + play.flow.first(march), first + play.flow.first(march + 1), 0.0);
    const engine::WindowGrid grid({v.x * n, v.y * n, v.z * n}, job.window << march);
    work += here * static_cast<double>(grid.windows().product()) /
            static_cast<double>(layout.grid(march).windows().product());
  }
  return work / sum(play.seconds);
}

/// N times as long with N * N times the cores: the wave's width, layers of bricks and the windows
/// of a core along its way grow alike, so efficiency stays; what is within bricks grows with N
/// cubed, what goes between them with N squared, over a time about N times as long.
void print_plan(const Job& job, const Play& play) {
  const auto n = static_cast<double>(job.stand_in);
  const double longer = growth(job, play) / (n * n);
  const double voxels =
      static_cast<double>(play.flow.layout().grid(0).volume().product()) * n * n * n;
  std::cout
      << "| ranks | cores of each | seconds | efficiency | TB between ranks | MB/s of one rank "
         "| TB held by one rank | TB of the output | hours through rank 0 "
         "| TB of labels for each rank |\n"
      << "|---|---|---|---|---|---|---|---|---|---|\n";
  for (int ranks : job.ranks) {
    Machines machines = job.machines;
    machines.ranks = ranks;
    machines.bandwidth /= n;
    const TeamSchedule s =
        team_schedule(play.flow, play.seconds, partition_of(job, play, ranks), machines);
    const double cores = static_cast<double>(machines.cores) * ranks;
    const double between = (sum(s.bytes) - s.output_bytes) * n * n;
    const double output = s.output_bytes * n * n * n;
    std::cout << "| " << ranks << " | " << static_cast<double>(machines.cores) * n * n << " | "
              << s.seconds * longer << " | " << 100 * sum(play.seconds) / s.seconds / cores
              << " % | " << between / 1e12 << " | " << between / ranks / (s.seconds * longer) / 1e6
              << " | " << most(s.held) * n * n * n / 1e12 << " | " << output / 1e12 << " | "
              << output / job.machines.bandwidth / 3600 << " | " << 8 * voxels / 1e12 << " |"
              << std::endl;
  }
}

/// Windows sleep for their seconds; messages have no bytes, so none are simulated.
void print_sleeping_runs(const Job& job, Play play) {
  const double factor =
      job.sleep_ms / 1e3 * static_cast<double>(play.seconds.size()) / sum(play.seconds);
  for (double& s : play.seconds) s *= factor;
  std::cout << "| ranks | simulated s | measured s | measured / simulated | parcels |\n"
            << "|---|---|---|---|---|\n";
  for (int ranks : job.ranks) {
    Machines machines{.ranks = ranks, .cores = job.machines.cores};
    machines.look_ahead = job.machines.look_ahead;
    const engine::Partition dealt = partition_of(job, play, ranks);
    const TeamSchedule simulated = team_schedule(play.flow, play.seconds, dealt, machines);
    const SleepingRun measured = sleeping_run(play.flow, play.seconds, dealt, machines);
    std::cout << "| " << ranks << " | " << simulated.seconds << " | " << measured.seconds << " | "
              << measured.seconds / simulated.seconds << " | "
              << std::accumulate(measured.parcels.begin(), measured.parcels.end(), std::uint64_t{0})
              << " |" << std::endl;
  }
}

void report(const Job& job) {
  std::cout << std::setprecision(4);
  const Play play = play_of(job);
  print_run(job, play);
  if (job.sleep_ms > 0) return print_sleeping_runs(job, play);
  job.stand_in > 1 ? print_plan(job, play) : print_predictions(job, play);
}

void add_run_options(CLI::App& app, Job& job) {
  app.add_option("TRACE", job.trace, "written by mwmesh mesh --trace")->required();
  const std::map<std::string, Order> orders{{"raster", Order::kRaster}, {"colour", Order::kColour}};
  app.add_option("--order", job.order, "in which the trace was taken")
      ->transform(CLI::CheckedTransformer(orders));
  app.add_option("--shape", job.shape, "voxels of the run, durations drawn from the trace")
      ->expected(3)
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  app.add_option("--window", job.window, "window edge of that run")->check(CLI::Range(2, 1024));
  app.add_option("--seed", job.seed, "of the draws");
  app.add_option("--factor", job.factor, "on all durations")->check(CLI::PositiveNumber);
  app.add_flag("--wall", job.wall, "wall instead of processor time of windows");
}

void add_machine_options(CLI::App& app, Job& job) {
  Machines& machines = job.machines;
  app.add_option("--ranks", job.ranks)->delimiter(',')->check(CLI::Range(1, 65536));
  app.add_option("--cores", machines.cores, "of a rank")->check(CLI::Range(1, 65536));
  app.add_option("--look-ahead", machines.look_ahead,
                 "of the march, in own windows; by default the march's own");
  app.add_option("--latency", machines.latency, "seconds")->check(CLI::NonNegativeNumber);
  app.add_option("--bandwidth", machines.bandwidth, "bytes a second that a rank sends")
      ->check(CLI::PositiveNumber);
  app.add_option("--block-bytes", machines.block_bytes, "of a parcel, by march")
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber);
  app.add_option(
         "--cut-every", job.cut_every,
         "colour: bricks end at rows that are a multiple of it; by default as the engine's do")
      ->check(CLI::PositiveNumber);
  app.add_option("--stand-in", job.stand_in,
                 "prints what volumes N times as long would take with N * N times the cores")
      ->check(CLI::Range(1, 64));
  app.add_option("--sleep", job.sleep_ms,
                 "runs the marches with windows that sleep MS milliseconds on the average")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace
}  // namespace mw::bench

int main(int argc, char** argv) {
  try {
    mw::bench::Job job;
    CLI::App app("predicts the marches' speed-up on several machines from a trace, as Markdown");
    mw::bench::add_run_options(app, job);
    mw::bench::add_machine_options(app, job);
    CLI11_PARSE(app, argc, argv);
    mw::bench::report(job);
  } catch (const std::exception& error) {
    std::cerr << "mw_scale_out: error: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
