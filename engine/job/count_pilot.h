// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How sizes are to be scaled so that a mesh has the tets that are asked for (SizeSettings::count).
#pragma once

#include <cstdint>
#include <string>

#include "engine/job/mesh_job.h"
#include "engine/labels/size_image.h"

namespace mw::engine {

/// One part stands for volumes of up to this many voxels of the lattice, several for larger ones;
/// up to here a mesh that misses the number is made again.
inline constexpr std::int64_t kMaxOnePart = std::int64_t{1} << 23;

/// What a pilot works on.  All of it outlives the call.
struct PilotTask {
  const io::DenseVolume& labels;
  const MeshJob& job;  ///< its settings, labels that are written, threads, and who may stop it
  const SizeImage* image = nullptr;
  std::uint64_t memory = 0;                 ///< bytes that it may take
  std::uint64_t memory_beside = 0;          ///< see StoreOptions
  std::int64_t max_one_part = kMaxOnePart;  ///< voxels
};

/// Finds the factor on all sizes with which the mesh that is written has about SizeSettings::count
/// tets.  Where no size is given, all labels have size 1.
///
/// It meshes at up to six factors, the first by the volume of labels and the faces between them,
/// the others each by a secant through the logarithms of two counts, until a count is so near that
/// the secant tells the rest.  A volume too small for parts (PilotSample), or whose sizes are
/// those of an image, is meshed whole, which tells the count exactly.  Of a larger one parts are
/// meshed, a tenth or so of it, and a count is that of the parts times what they stand for.  So it
/// is a function of volume and settings, for any number of threads.
///
/// Where no factor gives the count, the factor is at an end of its range: the least sizes that
/// voxels allow, or sizes of 64 voxels, with which only the bound on the distance, the topology and
/// the quality floor keep tets.  Labels without a size keep theirs, where others have one: the
/// factor does not reach them.
/// REQUIRES: count > 0.
/// ERRORS: those of mesh_volume(), and what the job's functions throw.
[[nodiscard]] report::CountFacts scale_for_count(const PilotTask& task);

/// Returns how many tets the marches make with the factor.  ERRORS: as scale_for_count().
[[nodiscard]] std::uint64_t count_whole(const PilotTask& task, double scale);

/// True if a mesh that misses the count may be made again: parts told the factor, the volume is not
/// too large, and no more than one mesh was made again.
[[nodiscard]] bool may_be_remade(const report::CountFacts& count, const io::DenseVolume& labels);

/// Sets the factor for another mesh where the one with count.scale has `tets` tets and misses the
/// count by more than 9 %.  Returns whether it did; where no other factor is nearer, it notes that
/// the number cannot be had.  REQUIRES: may_be_remade().
[[nodiscard]] bool take_next_scale(report::CountFacts& count, std::uint64_t tets,
                                   const io::DenseVolume& labels, const MeshSettings& settings);

/// Returns the settings with all sizes multiplied; without any, all labels get size `scale`.
[[nodiscard]] MeshSettings with_scale(const MeshSettings& settings, double scale);

}  // namespace mw::engine
