// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Predicts how long the rest of a run will take.
#pragma once

#include <chrono>

#include "engine/forecast/run_work.h"
#include "engine/forecast/time_left.h"
#include "engine/march/wavefront.h"
#include "engine/store/run_layout.h"

namespace mw::engine {

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
