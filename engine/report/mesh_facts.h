// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What can be said of a mesh, and how reports say it.
#pragma once

#include <filesystem>
#include <span>

#include "io/file/sink/atomic_file.h"
#include "io/json/json.h"
#include "io/labels/label_table.h"
#include "io/mesh/mesh_data.h"
#include "kernels/audit/shape/quality.h"

namespace mw::report {

/// "quality" of a report.
[[nodiscard]] io::Json quality_json(const audit::QualityReport& quality);

/// Quality in two plain lines.
void print_quality(const audit::QualityReport& quality);

/// A label as a JSON number.
[[nodiscard]] io::Json label_json(RawLabel label, bool is_signed);

/// Writes the value, indented, and gives the file its name.
void write_json(io::AtomicFile& file, const io::Json& value);

}  // namespace mw::report
