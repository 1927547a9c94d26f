// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What can be said of a mesh in memory, and how reports say it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>

#include "io/file/atomic_file.h"
#include "io/labels/label_table.h"
#include "io/mesh/mesh_data.h"
#include "kernels/audit/quality.h"

namespace mw::cli {

/// Labels of the tets as audit wants them; one that is not in the table is audit::kUnknown.
[[nodiscard]] std::vector<Label> dense_labels(const io::MeshData& mesh,
                                              const io::LabelTable& table);

/// A view of mesh; labels may be empty where nobody looks at them.
[[nodiscard]] audit::AuditMesh audit_view(const io::MeshData& mesh, std::span<const Label> labels);

/// "quality" of a report.
[[nodiscard]] nlohmann::ordered_json quality_json(const audit::QualityReport& quality);

/// Quality in two plain lines.
void print_quality(const audit::QualityReport& quality);

/// A label as a JSON number.
[[nodiscard]] nlohmann::ordered_json label_json(RawLabel label, bool is_signed);

/// Writes the value, indented, and gives the file its name.
void write_json(io::AtomicFile& file, const nlohmann::ordered_json& value);

}  // namespace mw::cli
