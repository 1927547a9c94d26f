// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines of a trace.
#include "engine/cli/trace_file.h"

#include "engine/cli/options/values.h"

namespace mw::cli {
namespace {

constexpr int kDigits = 9;  // nanoseconds

}  // namespace

TraceFile::TraceFile(const std::filesystem::path& path) : file_(path) {
  file_.append("march,x,y,z,start_s,end_s,cpu_s,slot\n");
}

void TraceFile::add(const engine::TraceEvent& event) {
  std::string line;
  for (const std::int64_t number :
       {std::int64_t{event.march}, event.window.x, event.window.y, event.window.z}) {
    line += std::to_string(number) + ",";
  }
  for (const double seconds : {event.start_seconds, event.end_seconds, event.cpu_seconds}) {
    line += format_fixed(seconds, kDigits) + ",";
  }
  file_.append(line + std::to_string(event.slot) + "\n");
}

}  // namespace mw::cli
