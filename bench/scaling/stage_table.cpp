// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/stage_table.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <variant>

#include "io/json/json.h"
#include "kernels/core/error.h"

namespace mw::bench {
namespace {

engine::StageCost stage_of(const io::Json& row) {
  return {.name = row["name"].text(),
          .cpu_seconds = row["cpu_s"].number(),
          .alone_seconds = row["alone_s"].number()};
}

std::vector<engine::StageCost> stages_of(const io::Json& performance) {
  std::vector<engine::StageCost> out;
  double rest = performance["cpu_s"].number();
  for (const io::Json& row : performance["costs"].elements()) {
    out.push_back(stage_of(row));
    rest -= out.back().cpu_seconds;
  }
  rest = std::max(rest, 0.0);
  out.push_back({.name = "rest", .cpu_seconds = rest, .alone_seconds = rest});
  return out;
}

/// Returns what is taken from a report.
template <typename Take>
auto read(std::string_view text, std::string_view file, const Take& take) {
  const io::Json report = io::parse_json(text, file);
  try {
    return take(report);
  } catch (const std::out_of_range&) {
  } catch (const std::bad_variant_access&) {
  }
  throw Error(ErrorKind::kInput,
              std::string(file) + ": not the report of mwmesh mesh with --threads 1");
}

}  // namespace

std::vector<engine::StageCost> read_stages(std::string_view text, std::string_view file) {
  return read(text, file, [](const io::Json& report) { return stages_of(report["performance"]); });
}

std::uint64_t read_held_bytes(std::string_view text, std::string_view file) {
  return read(text, file, [](const io::Json& report) {
    const io::Json& peaks = report["engine"]["peak_bytes_by_purpose"];
    double sum = 0.0;
    for (const char* purpose : {"program", "index"}) sum += peaks[purpose].number();
    return static_cast<std::uint64_t>(sum);
  });
}

std::size_t fed_cores(std::size_t cores, double traffic, double seconds, double bandwidth) {
  const double fed = bandwidth * seconds / traffic;
  return fed < static_cast<double>(cores) ? std::max<std::size_t>(1, static_cast<std::size_t>(fed))
                                          : cores;
}

double shared_by(const engine::StageCost& stage, std::size_t cores) {
  const double shared = stage.cpu_seconds - stage.alone_seconds;
  return stage.alone_seconds + shared / static_cast<double>(cores);
}

double seconds_beside_visits(std::span<const engine::StageCost> stages, std::size_t cores) {
  double sum = 0.0;
  for (const engine::StageCost& stage : stages) {
    sum += stage.name == "march" ? stage.alone_seconds : shared_by(stage, cores);
  }
  return sum;
}

}  // namespace mw::bench
