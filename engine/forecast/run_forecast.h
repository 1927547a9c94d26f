// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Predicts what windows cost before they are visited, and how long the rest of a run will take.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "engine/labels/label_counts.h"
#include "engine/march/wavefront.h"
#include "engine/settings/settings.h"
#include "engine/store/run_layout.h"
#include "engine/window/window_order.h"

namespace mw::engine {

/// The place of a march among the marches of its run.
struct MarchIndex {
  bool is_first = true;
  bool is_last = true;
};

/// The work of one march's windows in microseconds of one core, as measured for balls, grains,
/// noise, CT and EM volumes with one thread (within a factor of 1.5 of one another; other machines,
/// settings and volumes differ by factors that a run measures by itself).  A window costs the more
/// the more interfaces it holds, more again where they are dense, and most for a block that it is
/// the first to see.
class MarchWork {
 public:
  /// REQUIRES: the faces outlive this.
  MarchWork(const BoundaryFaces& faces, const WindowOrder& order, const MeshSettings& settings,
            MarchIndex position);

  [[nodiscard]] double of(Index3 window) const;
  [[nodiscard]] double of_all() const;

 private:
  [[nodiscard]] bool sees_first(Index3 window, Index3 block) const;

  const BoundaryFaces& faces_;
  WindowOrder order_;
  double per_face_;
  double per_new_face_;
  double per_new_voxel_;
  double density_factor_;
};

/// Returns the work of one of the two readings of a block for the output, in microseconds, too.
[[nodiscard]] double output_work(const BoundaryFaces& faces, const Box3& block);

/// The seconds left of work in several parts, one after the other.  The amounts of work need only
/// be right up to a factor, the speed, which is measured.  The speed may change from one part to
/// the next: a part's own speed soon replaces that of the parts before, as that of the first part
/// replaces a guess; a stall in the first window says nothing of the others.
/// It is a pure function of the calls, times included.
class TimeLeft {
 public:
  /// work holds the amount of work of each part, in any unit; none is negative.  guess is the
  /// seconds that one unit takes, and is positive.
  TimeLeft(std::vector<double> work, double guess);

  /// Begins the next part `now` seconds after any fixed moment; `skipped` of its work is done.
  void begin(double now, double skipped);
  /// Notes that this much work of the part has been done since the last call.
  void done(double now, double work);
  [[nodiscard]] double seconds() const;

 private:
  struct Pace {
    double seconds = 0;
    double work = 0;
  };

  [[nodiscard]] double work_left() const;

  std::vector<double> work_;  ///< the work left in each part
  std::size_t next_ = 0;      ///< part to begin
  double begun_ = 0;
  double size_ = 0;  ///< work of the part without what was skipped
  Pace before_;      ///< pace of all parts that are over, and of one guessed unit of work
  Pace part_;
};

/// Follows a run through its marches and its output.  The work follows from the labels, the speed
/// is measured in the run itself.  It has no effect on the mesh.
/// Cost: some microseconds a window.  Thread safety: none.
class RunForecast {
 public:
  /// REQUIRES: the references outlive it.
  RunForecast(const BoundaryFaces& faces, const RunLayout& layout, const MeshSettings& settings,
              int threads);

  /// Must be called when a march begins.
  void begin_march(const IsFinished& finished_before);
  void visited(Index3 window);
  void begin_output();
  /// Must be called when the output reads a block of the last march; finish() reads each twice.
  void reading(Index3 block);

  [[nodiscard]] double seconds_left() const { return left_.seconds(); }

 private:
  [[nodiscard]] std::vector<double> work_of_parts() const;
  [[nodiscard]] Box3 output_box(Index3 block) const;
  [[nodiscard]] double now() const;

  const BoundaryFaces& faces_;
  const RunLayout& layout_;
  std::vector<MarchWork> marches_;
  TimeLeft left_;
  std::size_t begun_ = 0;  ///< marches that have begun
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace mw::engine
