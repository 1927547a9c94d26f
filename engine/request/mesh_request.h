// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a job that meshes a volume is asked to do, by the program or through the library.
#pragma once

#include "engine/job/mesh_job.h"
#include "engine/request/volume_options.h"
#include "engine/settings/settings.h"
#include "io/mesh/element.h"
#include "io/mesh/mesh_extras.h"

namespace mw::request {

using engine::Certify;

struct MeshRequest {
  VolumeRequest volume;
  std::filesystem::path output;  ///< empty: the mesh stays in memory
  io::Element element = io::Element::kTet4;
  io::MeshExtras extras;                 ///< what the output has beside the mesh
  bool write_values = true;              ///< whether the output has the values of tets
  bool is_measured = true;               ///< in the library: whether there is a report
  bool force = false;                    ///< whether it may replace files of others, mesh images
  std::filesystem::path report;          ///< empty: none
  std::filesystem::path html;            ///< empty: none
  std::filesystem::path trace;           ///< empty: none
  std::filesystem::path config;          ///< the file that options come from; empty: none
  std::vector<std::string> size_tables;  ///< files that sizes come from
  std::optional<std::uint64_t> memory;   ///< bytes, as asked for
  std::filesystem::path keep;            ///< empty: nothing new is kept
  std::filesystem::path from;            ///< empty: no earlier run is used
  std::filesystem::path delta;           ///< empty: none
  engine::MeshJob job;                   ///< what the engine is asked to do
  std::string progress;
  std::string log_level;
};

/// Adds every option of the job, in the order of the documentation.
/// REQUIRES: request outlives options.
void add_mesh_options(OptionSet& options, MeshRequest& request);

/// Fills in what follows from other values.
/// ERRORS (both): mw::Error(kUsage) when values that are allowed by themselves contradict each
/// other.
void settle_mesh_request(MeshRequest& request);

/// Checks what the output is to have, and the settings.
void check_mesh_request(const MeshRequest& request);

/// Turns the boxes of --changed, which count as the data set does, to voxels of the volume.
/// ERRORS: kUsage if one is outside of a whole volume, where it can only be a mistake.
void settle_changed(MeshRequest& request, const io::VolumeInfo& volume);

/// Opens the image of sizes and the images that tets get values from.  ERRORS: those of io.
void open_images(const MeshRequest& request, engine::MeshJob& job);

}  // namespace mw::request
