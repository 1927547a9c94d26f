// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes below some 1.4 voxels: the marches make edges twice as long, and the mesh that is written
// has each tet cut into eight, with interfaces that are smoother than those of the marches.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/job/mesh_job.h"
#include "engine/output/written_block.h"
#include "io/mesh/grouped/halved_sink.h"

namespace mw::engine {

/// Returns how often the tets of a run are cut: as often as its least size asks for, where that is
/// below least_size() (1.39 voxels where these are cubes); never with a count, as sizes are weights
/// then.  in_image is the least size of the image, or infinity without one; what it asks for beyond
/// io::kMostHalvings is left out.
/// ERRORS: mw::Error(kUsage) when io::kMostHalvings cuts are not enough for another size, with the
/// least size that can be kept; when several processes would have to cut.
[[nodiscard]] int halvings_of(const io::VolumeInfo& volume, const MeshJob& job, double in_image);

/// Returns the settings for marches whose tets are cut this often afterwards: larger sizes, and a
/// smaller bound on the distance, as interfaces move when they become smoother.
[[nodiscard]] MeshSettings before_halvings(MeshSettings settings, int times);

/// The sinks that cut, one behind the other, and the figures of what they write.
class Halving {
 public:
  /// With times 0 the mesh is passed on as it is.  The job has the settings that were asked for;
  /// its stop() is called often while tets are cut.  sizes are by dense label, 0 where none is
  /// asked; if empty, edges are not measured.  REQUIRES: below and volume outlive it.
  Halving(int times, io::MeshSink& below, const MeshJob& job, const io::DenseVolume& volume,
          std::vector<double> sizes);

  /// Returns where the mesh of the marches goes.
  [[nodiscard]] io::MeshSink& sink() { return cuts_.empty() ? below_ : *cuts_.back(); }
  /// Puts the figures of what was written in the place of those of the marches' mesh; those of
  /// surfaces stay, and are of surfaces before they became smoother.
  /// REQUIRES: the sink is finished.
  void report(RunReport& out);

 private:
  void see(const std::array<io::Position, 4>& corners, RawLabel label);

  io::MeshSink& below_;
  const io::LabelTable& table_;
  std::function<void()> stop_;
  std::vector<std::unique_ptr<io::HalvedSink>> cuts_;  ///< the last one that cuts comes first
  std::optional<audit::QualityMeter> quality_;
  std::optional<LongestEdges> edges_;
  std::uint64_t tets_ = 0;
};

}  // namespace mw::engine
