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

[[noreturn]] void refuse(std::string_view file) {
  throw Error(ErrorKind::kInput,
              std::string(file) + ": not the report of mwmesh mesh with --threads 1");
}

}  // namespace

std::vector<engine::StageCost> read_stages(std::string_view text, std::string_view file) {
  const io::Json report = io::parse_json(text, file);
  try {
    return stages_of(report["performance"]);
  } catch (const std::out_of_range&) {
    refuse(file);
  } catch (const std::bad_variant_access&) {
    refuse(file);
  }
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
