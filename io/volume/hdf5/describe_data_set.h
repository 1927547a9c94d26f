// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the HDF5 library knows of one data set.
#pragma once

#include <string>

#include "io/hdf5/source_driver.h"
#include "io/volume/hdf5/description.h"

namespace mw::io {

/// hdf5: the file, opened through source.  To be called apart (io/file/apart.h) only.
/// ERRORS: mw::Error(kInput) for damage, and for types and storage that cannot be read.
[[nodiscard]] Hdf5Description describe_data_set(Hdf5Source& source, hid_t hdf5,
                                                const std::string& path);

}  // namespace mw::io
