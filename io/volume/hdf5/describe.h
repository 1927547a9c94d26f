// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the labels in an HDF5 file, by the HDF5 library in a process of its own.
#pragma once

#include <string>

#include "io/file/byte_source.h"
#include "io/volume/hdf5/description.h"

namespace mw::io {

/// data_set: "/a/b" of the labels or of a group that has them; empty: by convention, see
/// choose_data_set().  The library never sees the file in this process: damage makes it crash.
/// ENSURES: what is described is within the file and fits together, see check_description().
/// Memory: 24 bytes a chunk that the file has; time: some microseconds a chunk of the grid.
/// ERRORS: mw::Error(kInput) for damage, for a data set that is missing, none or one of several
/// that are fit, and for types and storage that cannot be read; kResource when no process can be
/// started.
[[nodiscard]] Hdf5Description describe_hdf5(const ByteSource& source, const std::string& data_set);

/// ERRORS: mw::Error(kInput) unless shapes have as many axes as each other, chunks are within the
/// file, in order and no more than it, and runs of bytes have the size that the shape needs.
void check_description(const ByteSource& source, const Hdf5Description& description);

}  // namespace mw::io
