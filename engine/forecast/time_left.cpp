// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How long a run will take, from how long it has taken so far.
#include "engine/forecast/time_left.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

/// The speed of the parts before counts as if this share of a part's work had been done at it.
constexpr double kShareOfBefore = 0.02;

}  // namespace

TimeLeft::TimeLeft(std::vector<double> work, double guess)
    : work_(std::move(work)), before_{guess, 1} {}

void TimeLeft::begin(double now, double skipped) {
  MW_ASSERT(next_ < work_.size());
  if (next_ > 0) work_[next_ - 1] = 0;
  before_.seconds += part_.seconds;
  before_.work += part_.work;
  part_ = {};
  begun_ = now;
  work_[next_] = std::max(0.0, work_[next_] - skipped);
  size_ = work_[next_++];
}

void TimeLeft::done(double now, double work) {
  part_.seconds = now - begun_;
  part_.work += work;
  double& left = work_[next_ - 1];
  left = std::max(0.0, left - work);
}

double TimeLeft::seconds() const {
  const double before = kShareOfBefore * size_;
  const double known = before_.seconds / before_.work;
  const double work = part_.work + before;
  return work_left() * (work > 0 ? (part_.seconds + before * known) / work : known);
}

double TimeLeft::work_left() const {
  return std::accumulate(work_.begin(), work_.end(), 0.0);
}

}  // namespace mw::engine
