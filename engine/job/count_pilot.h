// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How sizes are to be scaled so that a mesh has the tets that are asked for (SizeSettings::count).
#pragma once

#include <cstdint>
#include <string>

#include "engine/job/mesh_job.h"
#include "engine/labels/size_image.h"

namespace mw::engine {

/// A pilot meshes volumes of up to this many voxels of the lattice whole.
inline constexpr std::int64_t kMaxWholePilot = std::int64_t{1} << 23;

/// What a pilot works on.  All of it outlives the call.
struct PilotTask {
  const io::DenseVolume& labels;
  const MeshJob& job;  ///< its settings, labels that are written, threads, and who may stop it
  const SizeImage* image = nullptr;
  std::uint64_t memory = 0;                 ///< bytes that it may take
  std::uint64_t memory_beside = 0;          ///< see StoreOptions
  std::int64_t max_whole = kMaxWholePilot;  ///< voxels
};

/// Finds the factor on all sizes with which the mesh that is written has about SizeSettings::count
/// tets.  Where no size is given, all labels have size 1.
///
/// It meshes at up to six factors, the first by the volume of labels, the others each by a secant
/// through the logarithms of two counts, until a count is so near that the secant tells the rest. A
/// volume of up to max_whole voxels is meshed whole, which tells the count exactly.  In a larger
/// one some cubes of 64 voxels are meshed, with 16 voxels around them whose tets are not counted.
/// Cubes are drawn evenly along the volume, without any random number, with a chance that grows
/// with their faces between labels and their voxels that are written; a count is then the mean of
/// tets per chance.  So it is a function of volume and settings, for any number of threads.
///
/// Where no factor gives the count, the factor is at an end of its range: the least sizes that
/// voxels allow, or sizes of 64 voxels, with which only the bound on the distance, the topology and
/// the quality floor keep tets.  Labels without a size keep theirs, where others have one: the
/// factor does not reach them.
/// REQUIRES: count > 0.
/// ERRORS: those of mesh_volume(), and what the job's functions throw.
[[nodiscard]] report::CountFacts scale_for_count(const PilotTask& task);

/// Returns the settings with all sizes multiplied; without any, all labels get size `scale`.
[[nodiscard]] MeshSettings with_scale(const MeshSettings& settings, double scale);

}  // namespace mw::engine
