// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Collects what an HDF5 file says of where a data set lies.
#pragma once

#include <hdf5.h>

#include "io/volume/hdf5/description.h"

namespace mw::io {

/// Fills `numbers` and `axistags` of the description of the data set `set` of the file `hdf5`; the
/// geometry is that of the nearest group above the data set which has one.  What is there but not
/// numbers, or more than a few, is left out.  To be called apart (io/file/apart.h) only.
void find_place(hid_t hdf5, hid_t set, Hdf5Description& description);

}  // namespace mw::io
