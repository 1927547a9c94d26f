// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Log lines, the bar, and lines of a trace.
#include "engine/cli/mesh/progress.h"

#include <unistd.h>

#include <cstdio>

#include "engine/cli/requests.h"

namespace mw::cli {
namespace {

constexpr double kPauseSeconds = 0.2;
constexpr std::uint64_t kBarCells = 30;

double seconds_between(std::chrono::steady_clock::time_point a,
                       std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

/// Returns "47 s", "12 min" or "3.4 h".
std::string rough_time(double seconds) {
  if (seconds < 100) return format_fixed(seconds, 0) + " s";
  if (seconds < 100 * 60) return format_fixed(seconds / 60, 0) + " min";
  return format_fixed(seconds / 3600, 1) + " h";
}

void show_bar(const engine::RunProgress& at) {
  const std::uint64_t cells = kBarCells * at.done / at.total;
  std::string text = "[" + std::string(cells, '#') + std::string(kBarCells - cells, '.') + "] " +
                     std::to_string(at.done) + "/" + std::to_string(at.total) + " windows";
  if (at.seconds_left) text += ", about " + rough_time(*at.seconds_left) + " left";
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
}

/// Prints a line of JSON; seconds are those since the run began.
void show_line(const engine::RunProgress& at, double seconds) {
  const std::string left = at.seconds_left ? format_fixed(*at.seconds_left, 3) : "null";
  const std::string text = "{\"event\":\"window\",\"done\":" + std::to_string(at.done) +
                           ",\"total\":" + std::to_string(at.total) +
                           ",\"wall_s\":" + format_fixed(seconds, 3) + ",\"left_s\":" + left + "}";
  std::fprintf(stderr, "%s\n", text.c_str());
}

constexpr int kDigits = 9;  // nanoseconds

}  // namespace

ProgressKind parse_progress(const std::string& text) {
  if (text == "jsonl") return ProgressKind::kJsonLines;
  return text == "auto" && ::isatty(STDERR_FILENO) == 1 ? ProgressKind::kBar : ProgressKind::kNone;
}

Progress::~Progress() {
  if (kind_ == ProgressKind::kBar && done_ > 0) std::fprintf(stderr, "\n");
}

void Progress::show(const engine::RunProgress& at) {
  const Clock::time_point now = Clock::now();
  const bool is_end = at.done == at.total && done_ != at.done;
  const bool due = at.done <= 1 || is_end || seconds_between(shown_, now) >= kPauseSeconds;
  if (kind_ == ProgressKind::kNone || !due) return;
  shown_ = now;
  done_ = at.done;
  if (kind_ == ProgressKind::kBar) {
    show_bar(at);
  } else {
    show_line(at, seconds_between(start_, now));
  }
}

TraceFile::TraceFile(const std::filesystem::path& path) : file_(path) {
  file_.append("march,x,y,z,start_s,end_s,cpu_s,slot,bytes\n");
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
  file_.append(line + std::to_string(event.slot) + "," + std::to_string(event.bytes) + "\n");
}

}  // namespace mw::cli
