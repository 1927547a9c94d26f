// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels as field data of a .vtkhdf file.
#pragma once

#include <string>

#include "io/mesh/field_names.h"
#include "io/mesh/vtkhdf/hdf5_handle.h"

namespace mw::io {

/// Writes the arrays of field_names.h into a group FieldData in `grid`; nothing without names.
/// Strings have a variable length and are declared ASCII, though they are UTF-8: VTK 9.1 reads no
/// others.  Returns whether all went well.
[[nodiscard]] bool write_vtkhdf_names(hid_t grid, const LabelNames& names, bool labels_signed);

/// Nothing when `grid` has no such arrays.
/// Memory: names are read one by one.
/// ERRORS: mw::Error(kInput) naming file and data set when they are damaged.
[[nodiscard]] LabelNames read_vtkhdf_names(hid_t grid, const std::string& file);

}  // namespace mw::io
