// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines of a trace to durations.
#include "bench/scaling/trace_table.h"

#include <algorithm>
#include <istream>
#include <map>
#include <string>

#include "engine/window/window_grid.h"
#include "kernels/core/error.h"
#include "kernels/core/index.h"

namespace mw::bench {
namespace {

struct Visit {
  Index3 window;
  double seconds = 0.0;
  std::uint64_t bytes = 0;
};

/// march, x, y, z, start_s, end_s, cpu_s, slot, bytes
std::vector<double> numbers(const std::string& line, std::size_t line_number) {
  std::vector<double> out;
  try {
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find(',', begin), line.size());
      out.push_back(std::stod(line.substr(begin, end - begin)));
      begin = end + 1;
    }
  } catch (const std::exception&) {
    out.clear();
  }
  if (out.size() == 9) return out;
  throw Error(ErrorKind::kInput,
              "line " + std::to_string(line_number) + " is not one of a trace: " + line);
}

MarchTrace table(const std::vector<Visit>& visits) {
  MarchTrace out;
  for (const Visit& v : visits) {
    out.windows = {std::max(out.windows.x, v.window.x + 1), std::max(out.windows.y, v.window.y + 1),
                   std::max(out.windows.z, v.window.z + 1)};
  }
  out.seconds.assign(static_cast<std::size_t>(out.windows.product()), 0.0);
  if (out.seconds.size() != visits.size()) {
    throw Error(ErrorKind::kInput, "not the trace of a whole run: a march has " +
                                       std::to_string(visits.size()) + " visits of " +
                                       std::to_string(out.seconds.size()) + " windows");
  }
  out.bytes.assign(out.seconds.size(), 0);
  for (const Visit& v : visits) {
    const std::size_t row = raster(v.window, out.windows);
    out.seconds[row] = v.seconds;
    out.bytes[row] = v.bytes;
  }
  return out;
}

}  // namespace

std::vector<MarchTrace> read_trace(std::istream& in, Clock clock) {
  std::map<int, std::vector<Visit>> marches;
  std::string line;
  std::getline(in, line);  // names
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    const std::vector<double> row = numbers(line, number);
    const auto whole = [&](std::size_t column) { return static_cast<std::int64_t>(row[column]); };
    marches[static_cast<int>(row[0])].push_back(
        {.window = {whole(1), whole(2), whole(3)},
         .seconds = clock == Clock::kCpu ? row[6] : row[5] - row[4],
         .bytes = static_cast<std::uint64_t>(whole(8))});
  }
  std::vector<MarchTrace> out;
  for (const auto& [march, visits] : marches) out.push_back(table(visits));
  return out;
}

}  // namespace mw::bench
