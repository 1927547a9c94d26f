// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Predicts times from how long a run has taken so far.
#include "engine/forecast/run_forecast.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "kernels/core/assert.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

constexpr double kSecondsPerWork = 1e-6;  // the unit of MarchWork

std::vector<MarchWork> marches_of(const BoundaryFaces& faces, const RunLayout& layout,
                                  const MeshSettings& settings) {
  std::vector<MarchWork> out;
  for (std::uint32_t i = 0; i < layout.marches(); ++i) {
    const bool is_last = i + 1 == layout.marches();
    out.emplace_back(faces, WindowOrder(layout.grid(i), settings.order), settings,
                     MarchIndex{.is_first = i == 0, .is_last = is_last});
  }
  return out;
}

/// The speed of the parts before counts as if this share of a part's work had been done at it.
constexpr double kShareOfBefore = 0.02;

}  // namespace

RunForecast::RunForecast(const BoundaryFaces& faces, const RunLayout& layout,
                         const MeshSettings& settings, int threads)
    : faces_(faces),
      layout_(layout),
      marches_(marches_of(faces, layout, settings)),
      left_(work_of_parts(), kSecondsPerWork / threads) {}

void RunForecast::begin_march(const IsFinished& finished_before) {
  const MarchWork& march = marches_[begun_];
  double skipped = 0;
  for_each_index(layout_.grid(static_cast<std::uint32_t>(begun_)).windows(), [&](Index3 window) {
    if (finished_before(window)) skipped += march.of(window);
  });
  left_.begin(now(), skipped);
  ++begun_;
}

void RunForecast::visited(Index3 window) {
  left_.done(now(), marches_[begun_ - 1].of(window));
}

void RunForecast::begin_output() {
  left_.begin(now(), 0);
}

void RunForecast::reading(Index3 block) {
  left_.done(now(), output_work(faces_, output_box(block)));
}

std::vector<double> RunForecast::work_of_parts() const {
  std::vector<double> work;
  for (const MarchWork& march : marches_) work.push_back(march.of_all());
  double output = 0;
  for_each_index(layout_.grid(layout_.marches() - 1).blocks(),
                 [&](Index3 block) { output += 2 * output_work(faces_, output_box(block)); });
  work.push_back(output);
  return work;
}

Box3 RunForecast::output_box(Index3 block) const {
  return layout_.output_grid().block_box(block);
}

double RunForecast::now() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

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
