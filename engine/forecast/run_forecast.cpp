// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Predicts costs of windows, and times from how long a run has taken so far.
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
  return layout_.grid(layout_.marches() - 1).block_box(block);
}

double RunForecast::now() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

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

namespace {

// Microseconds, by least squares from traces of runs (--trace).
constexpr double kPerWindow = 200;
constexpr double kPerBoxFace = 0.3;    // for each face of a voxel on the volume's box
constexpr double kPerDenseVoxel = 12;  // for each voxel of the start mesh of five tets a voxel
constexpr double kPerOutputBlock = 15, kPerOutputFace = 0.2;
// Constrained ODT by TetGen takes 3 to 9 times what the rest of its march does.
constexpr double kTetgenFactor = 5;

/// Returns the number of faces of voxels of `part` on the box of a volume.
double faces_on_box(const Box3& part, Index3 volume) {
  const Index3 s = part.shape();
  const auto ends = [](std::int64_t lo, std::int64_t hi, std::int64_t size) {
    return (lo == 0 ? 1 : 0) + (hi == size ? 1 : 0);
  };
  return static_cast<double>(s.y * s.z * ends(part.lo.x, part.hi.x, volume.x) +
                             s.x * s.z * ends(part.lo.y, part.hi.y, volume.y) +
                             s.x * s.y * ends(part.lo.z, part.hi.z, volume.z));
}

/// These return the first and the last of `windows` windows along an axis that hold the block.
std::int64_t first_with(std::int64_t block) {
  return std::max<std::int64_t>(0, block - 1);
}

std::int64_t last_with(std::int64_t block, std::int64_t windows) {
  return std::min(block, windows - 1);
}

}  // namespace

MarchWork::MarchWork(const BoundaryFaces& faces, const WindowOrder& order,
                     const MeshSettings& settings, MarchIndex position)
    : faces_(faces),
      order_(order),
      per_face_(position.is_first ? 5.5 : 3),
      per_new_face_(position.is_first ? 12 : 7),
      per_new_voxel_(position.is_first && settings.start == StartMesh::kDense ? kPerDenseVoxel : 0),
      density_factor_(position.is_first ? 1.5 : 4.5) {
  if (position.is_last && settings.optimizer == Optimizer::kTetgen) {
    per_face_ *= kTetgenFactor;
    per_new_face_ *= kTetgenFactor;
  }
}

double MarchWork::of(Index3 window) const {
  const WindowGrid& grid = order_.grid();
  double faces = 0, new_faces = 0, new_voxels = 0;
  for (const Index3 block : grid.blocks_of(window)) {
    const Box3 part = grid.block_box(block);
    const double more = faces_.in(part);
    faces += more;
    if (!sees_first(window, block)) continue;
    new_faces += more;
    new_voxels += static_cast<double>(part.voxels());
  }
  const Box3 box = grid.window_box(window);
  const double density = faces / static_cast<double>(box.voxels());
  return kPerWindow + kPerBoxFace * faces_on_box(box, grid.volume()) +
         per_face_ * faces * (1 + density_factor_ * density) + per_new_face_ * new_faces +
         per_new_voxel_ * new_voxels;
}

double MarchWork::of_all() const {
  double work = 0;
  for_each_index(order_.grid().windows(), [&](Index3 window) { work += of(window); });
  return work;
}

/// True if no earlier window of the sequence holds the block.
bool MarchWork::sees_first(Index3 window, Index3 block) const {
  const Index3 windows = order_.grid().windows();
  const Box3 holders{{first_with(block.x), first_with(block.y), first_with(block.z)},
                     {last_with(block.x, windows.x) + 1, last_with(block.y, windows.y) + 1,
                      last_with(block.z, windows.z) + 1}};
  const std::uint64_t rank = order_.rank(window);
  bool first = true;
  for_each_index(holders, [&](Index3 other) { first = first && order_.rank(other) >= rank; });
  return first;
}

double output_work(const BoundaryFaces& faces, const Box3& block) {
  return kPerOutputBlock + kPerOutputFace * faces.in(block);
}

}  // namespace mw::engine
