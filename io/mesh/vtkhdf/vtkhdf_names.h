// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels, and the record of the run, in a .vtkhdf file.
#pragma once

#include <string>

#include "io/hdf5/hdf5_file.h"
#include "io/mesh/field_names.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/vtkhdf/hdf5_output.h"

namespace mw::io {

/// Writes what VTK reads, in a group FieldData of `grid`: the arrays of field_names.h.  Strings
/// have a variable length and are declared ASCII, though they are UTF-8: VTK 9.1 reads no others.
/// What we read: the numbers there, and in `file` the names once more, `mwmesh/label_name`, bytes
/// with a NUL behind each.  The HDF5 library does not survive damaged strings of variable length.
/// Nothing without names.  The record is `mwmesh/record`, bytes too.
/// ENSURES: file and grid have the groups that there are.  ERRORS: as Hdf5Output.
void add_vtkhdf_facts(Hdf5Output& output, const MeshHeader& header, Hdf5Group& file,
                      Hdf5Group& grid);

/// Nothing when the file has no such arrays.  `name` is what errors call it.
/// ERRORS: mw::Error(kInput) naming file and data set when they are damaged.
[[nodiscard]] LabelNames read_vtkhdf_names(hid_t file, hid_t grid, const std::string& name);
[[nodiscard]] MeshRecord read_vtkhdf_record(hid_t file, const std::string& name);

}  // namespace mw::io
