// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/system/stages.h"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <utility>

#include "engine/system/stopwatch.h"

namespace mw::engine {
namespace {

std::atomic<double> shared_seconds = 0.0;
thread_local bool is_sharing = false;

double process_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

SharedWork::SharedWork() : is_outermost_(!std::exchange(is_sharing, true)) {
  if (is_outermost_) begin_ = thread_cpu_seconds();
}

SharedWork::~SharedWork() {
  if (!is_outermost_) return;
  is_sharing = false;
  shared_seconds += thread_cpu_seconds() - begin_;
}

double SharedWork::seconds() {
  return shared_seconds;
}

StageMeter::StageMeter() : cpu_(process_cpu_seconds()), shared_(SharedWork::seconds()) {}

void StageMeter::end(const std::string& name) {
  auto stage = std::find_if(costs_.begin(), costs_.end(),
                            [&](const StageCost& cost) { return cost.name == name; });
  if (stage == costs_.end()) stage = costs_.insert(stage, {.name = name});
  const double cpu = process_cpu_seconds(), shared = SharedWork::seconds();
  const double spent = cpu - std::exchange(cpu_, cpu);
  stage->cpu_seconds += spent;
  stage->alone_seconds += std::max(0.0, spent - (shared - std::exchange(shared_, shared)));
}

}  // namespace mw::engine
