// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels, and the record of the run, as field data of a .vtu file.
#pragma once

#include <string>

#include "io/mesh/field_names.h"
#include "io/mesh/mesh_sink.h"
#include "io/vtk_xml/vtk_document.h"

namespace mw::io {

/// The element FieldData with the arrays of field_names.h, where there are names, and a string
/// `mwmesh`, the record, where there is one; else empty.  Everything is
/// written as numbers, as VTK writes strings in text, so nothing needs escaping.
[[nodiscard]] std::string vtu_fields(const MeshHeader& header);

/// Nothing when the document has no such arrays; those of VTK's writers are read as well.
/// ERRORS: mw::Error(kInput) when they are damaged.
[[nodiscard]] LabelNames read_vtu_names(VtkDocument& document);
[[nodiscard]] MeshRecord read_vtu_record(VtkDocument& document);

}  // namespace mw::io
