// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Collects what an HDF5 file says of where a data set lies.
#pragma once

#include <hdf5.h>

#include <string_view>

#include "io/volume/hdf5/description.h"

namespace mw::io {

/// Fills `numbers` and `axistags` of the description of the data set `set` of the file `hdf5`; the
/// geometry is that of the nearest group above the data set which has one.  What is there but not
/// numbers, or more than a few, is left out, and so is what links of the file lead to elsewhere.
/// To be called apart (io/file/apart.h) only.
/// ERRORS: mw::Error(kInput) naming file and what cannot be read: a look-up that fails does not say
/// that there is nothing.
void find_geometry(hid_t hdf5, hid_t set, std::string_view file, Hdf5Description& description);

}  // namespace mw::io
