// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What can be said of a mesh, its labels, volumes and distances, as JSON.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/file/sink/atomic_file.h"
#include "io/json/json.h"
#include "io/labels/interpolated_volume.h"
#include "io/labels/label_table.h"
#include "io/labels/specks.h"
#include "io/labels/welded_volume.h"
#include "io/mesh/mesh_data.h"
#include "io/names/label_names.h"
#include "kernels/audit/distance/distance.h"
#include "kernels/audit/shape/quality.h"
#include "kernels/audit/shape/shape.h"
#include "kernels/audit/shape/volumes.h"
#include "kernels/audit/subject.h"
#include "kernels/audit/topology/betti.h"
#include "kernels/core/index.h"

namespace mw::report {

/// Stands for the rows as the value of the key "per_label".  As JSON values, rows would take some
/// 500 bytes each, which no budget has set aside.
inline constexpr const char* kRows = "@rows";

using AppendText = std::function<void(std::string_view)>;
using TakeRow = std::function<void(const io::Json&)>;

/// Appends value, indented, and a line end; a list of what for_each_row() passes on takes the place
/// of kRows.  REQUIRES: value has kRows once, in an object that is one of its members.
void append_with_rows(const io::Json& value,
                      const std::function<void(const TakeRow&)>& for_each_row,
                      const AppendText& append);

/// Returns "quality" of a report.
[[nodiscard]] io::Json quality_json(const audit::QualityReport& quality);

/// Returns a label as a JSON number.
[[nodiscard]] io::Json label_json(RawLabel label, bool is_signed);

/// Returns [b0, b1, b2].
[[nodiscard]] io::Json betti_json(const audit::Betti& betti);

/// Returns [x, y, z].
[[nodiscard]] io::Json index_json(Index3 at);

/// Writes the value, indented, and gives the file its name.
void write_json(io::AtomicFile& file, const io::Json& value);

/// Returns `7`, or `7 "liver"`.
[[nodiscard]] std::string label_text(RawLabel label, bool is_signed, const io::LabelNames& names);

/// Returns `label 7 "liver"` for dense labels, for audits.  REQUIRES: table outlives the result.
[[nodiscard]] audit::LabelText label_texts(const io::LabelTable& table, io::LabelNames names);

/// Returns {"label": 7, "name": "liver"}, the beginning of a row about a label; the name is there
/// only if the label has one.
[[nodiscard]] io::Json named_row_json(RawLabel label, bool is_signed, const io::LabelNames& names);

/// Adds "colour": [r, g, b, a], 0 to 255, where it is known.
void add_colour(io::Json& row, RawLabel label, const io::LabelNames& names);

/// Returns "volume_error_..." and "labels_measured" of a report.
[[nodiscard]] io::Json volume_summary_json(const audit::VolumeSummary& volumes,
                                           const io::LabelTable& table);
/// Returns a row of its "per_label".
[[nodiscard]] io::Json volume_row_json(const audit::VolumeRow& row, const io::LabelTable& table,
                                       const io::LabelNames& names);
/// Returns area and bends of interfaces.
[[nodiscard]] io::Json interfaces_json(const audit::ShapeReport& shape);

/// Returns "distance" of a report, in voxels.  Infinite figures are null, and so is the label of
/// tets whose label is not in the volume.
[[nodiscard]] io::Json distance_json(const audit::DistanceReport& distance,
                                     const io::LabelTable& table, const io::LabelNames& names);

/// Returns "specks" of a report; null when none were to be dropped.
[[nodiscard]] io::Json specks_json(const std::optional<io::SpeckFacts>& specks);

/// Returns "interpolated" of a report; null when no labels were made between slices.
[[nodiscard]] io::Json slices_json(const std::optional<io::SliceFacts>& slices);

/// Returns "welds" of a report; null when nothing was to be welded.
[[nodiscard]] io::Json welds_json(const std::optional<io::WeldFacts>& welds);

/// Returns a line each about specks that were to be dropped, about labels between slices, and about
/// what was to be welded: "specks", "interpolated" and "welds" of a report.
[[nodiscard]] std::string steps_text(const io::Json& facts);

}  // namespace mw::report
