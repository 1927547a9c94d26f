// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How far a run is, on stderr.
#include "engine/cli/progress.h"

#include <unistd.h>

#include <cstdio>

#include "engine/cli/values.h"

namespace mw::cli {
namespace {

constexpr double kPauseSeconds = 0.2;
constexpr std::uint64_t kBarCells = 30;

double seconds_between(std::chrono::steady_clock::time_point a,
                       std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

ProgressKind parse_progress(const std::string& text) {
  if (text == "jsonl") return ProgressKind::kJsonLines;
  return text == "auto" && ::isatty(STDERR_FILENO) == 1 ? ProgressKind::kBar : ProgressKind::kNone;
}

void Progress::show(std::uint64_t done, std::uint64_t total) {
  const Clock::time_point now = Clock::now();
  const bool due = done <= 1 || done == total || seconds_between(shown_, now) >= kPauseSeconds;
  if (kind_ == ProgressKind::kNone || !due) return;
  shown_ = now;
  if (kind_ == ProgressKind::kBar) {
    show_bar(done, total, seconds_between(start_, now));
  } else {
    show_line(done, total, seconds_between(start_, now));
  }
}

void Progress::show_bar(std::uint64_t done, std::uint64_t total, double seconds) const {
  const std::uint64_t cells = kBarCells * done / total;
  const double left = seconds * static_cast<double>(total - done) / static_cast<double>(done);
  const std::string text = "[" + std::string(cells, '#') + std::string(kBarCells - cells, '.') +
                           "] " + std::to_string(done) + "/" + std::to_string(total) +
                           " windows, " + format_fixed(left, 0) + " s left";
  std::fprintf(stderr, "\r\033[K%s%s", text.c_str(), done == total ? "\n" : "");
}

void Progress::show_line(std::uint64_t done, std::uint64_t total, double seconds) {
  const std::string text = "{\"event\":\"window\",\"done\":" + std::to_string(done) +
                           ",\"total\":" + std::to_string(total) +
                           ",\"wall_s\":" + format_fixed(seconds, 3) + "}";
  std::fprintf(stderr, "%s\n", text.c_str());
}

}  // namespace mw::cli
