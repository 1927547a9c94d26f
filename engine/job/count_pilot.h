// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How sizes are to be scaled so that a mesh has the tets that are asked for (SizeSettings::count).
#pragma once

#include <cstdint>
#include <string>

#include "engine/job/mesh_job.h"
#include "engine/labels/size_image.h"

namespace mw::engine {

/// Volumes up to that many voxels of the lattice are meshed whole by a pilot.
inline constexpr std::int64_t kMaxWholePilot = std::int64_t{1} << 23;

/// What a pilot works on.  All of it outlives the call.
struct PilotTask {
  const io::DenseVolume& labels;
  const MeshJob& job;  ///< its settings, labels that are written, threads, and who may stop it
  const SizeImage* image = nullptr;
  std::uint64_t memory = 0;                 ///< bytes that it may take
  std::int64_t max_whole = kMaxWholePilot;  ///< voxels
};

/// Finds the factor on all sizes (where none is given, on a size of 1 of all labels) with which the
/// mesh that is written has about SizeSettings::count tets.
///
/// It meshes at up to six factors, each by the secant through the logarithms of the two counts
/// nearest to what is asked.  A volume of up to max_whole voxels is meshed whole, which tells the
/// count exactly.  Of a larger one some cubes of 64 voxels are meshed, with 16 voxels around them
/// whose tets are not counted.  They are drawn with a chance that grows with the faces between
/// labels and with the voxels that are written in them, evenly along the volume, and without any
/// random number; a count is then the mean of tets per chance.  So it is a function of volume and
/// settings, for any number of threads.
///
/// A count that cannot be had leaves the factor at the end of its range: the sizes that voxels
/// allow, and sizes of 64 voxels, with which only the bound on the distance, the topology and the
/// quality floor keep tets.
/// REQUIRES: count > 0.
/// ERRORS: those of mesh_volume(), and what the job's functions throw.
[[nodiscard]] report::CountFacts scale_for_count(const PilotTask& task);

/// The settings of the run: sizes multiplied, and the rest as it was.
[[nodiscard]] MeshSettings with_scale(const MeshSettings& settings, double scale);

}  // namespace mw::engine
