// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes that a job asks for, as the marches and the passes behind them take them.
#pragma once

#include <optional>
#include <vector>

#include "engine/job/mesh_job.h"
#include "engine/labels/size_image.h"

namespace mw::engine {

/// The image of sizes as the marches take it, and what follows from it.
struct JobSizes {
  std::optional<SizeImage> image;
  int halvings = 0;  ///< how often tets are cut behind the marches
  report::RaisedSizes raised;
};

/// Returns the job with sizes in physical units.
[[nodiscard]] MeshJob with_physical_sizes(const io::LabelVolume& opened, MeshJob job);

/// Settles sizes, and gives the job the settings of the marches.
/// ERRORS: those of SizeImage and halvings_of(); mw::Error(kUsage) when the job lacks the image,
/// and kInput when that asks for no size.
[[nodiscard]] JobSizes settle_sizes(const io::VolumeInfo& opened, const MeshJob& asked,
                                    MeshJob& job);

/// Returns sizes by dense label, as EdgesTask has them.
[[nodiscard]] std::vector<double> edge_sizes(const SizeRules& rules, const io::LabelTable& table);

/// Returns the pairs of labels that are written and whose interface has a size of its own, as
/// ConnectOptions::watched has them.
[[nodiscard]] std::vector<LabelPair> sized_interfaces(const MeshJob& job,
                                                      const io::LabelTable& table);

}  // namespace mw::engine
