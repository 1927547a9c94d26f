// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What can be said of label volumes and of the shape of interfaces, and how reports say it.
#pragma once

#include "io/json/json.h"
#include "io/labels/label_table.h"
#include "io/names/label_names.h"
#include "kernels/audit/shape/shape.h"
#include "kernels/audit/shape/volumes.h"

namespace mw::report {

/// "volume_error_..." and "labels_measured" of a report.
[[nodiscard]] io::Json volume_summary_json(const audit::VolumeSummary& volumes,
                                           const io::LabelTable& table);
/// A row of its "per_label".
[[nodiscard]] io::Json volume_row_json(const audit::VolumeRow& row, const io::LabelTable& table,
                                       const io::LabelNames& names);
/// Area and bends.
[[nodiscard]] io::Json interfaces_json(const audit::ShapeReport& shape);

/// A line each.
void print_volumes(const audit::VolumeReport& volumes, const io::LabelTable& table,
                   const io::LabelNames& names);
void print_interfaces(const audit::ShapeReport& shape);

}  // namespace mw::report
