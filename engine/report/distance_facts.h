// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What can be said of the distance between a volume and its mesh, and how reports say it.
#pragma once

#include "io/json/json.h"
#include "io/labels/label_table.h"
#include "io/names/label_names.h"
#include "kernels/audit/distance/distance.h"

namespace mw::report {

/// "distance" of a report, in voxels.  Infinite figures are null, and so is the label of tets whose
/// label is not in the volume.
[[nodiscard]] io::Json distance_json(const audit::DistanceReport& distance,
                                     const io::LabelTable& table, const io::LabelNames& names);

/// Distance in one plain line.
void print_distance(const audit::DistanceReport& distance, const io::LabelTable& table,
                    const io::LabelNames& names);

}  // namespace mw::report
