// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a data set of an HDF5 file as a volume.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "io/file/source/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Whether the superblock of HDF5 begins at 0 or, behind a block of the user's, at 512, 1024 and so
/// on within the bytes.
[[nodiscard]] bool has_hdf5_magic(std::span<const std::byte> head);

/// Opens the data set that options.dataset names, else the labels by the conventions of CREMI,
/// ilastik and DREAM.3D, else the only array of integers with three or two axes.  Spacing and
/// origin are as those tools write them (see choose_data_set, find_axes, hdf5_space).
/// The HDF5 library sees the file in a child process only; voxels are read without it.
/// ERRORS: mw::Error(kInput) for damage, for what cannot be read here, and when no or several data
/// sets are fit.
[[nodiscard]] std::unique_ptr<LabelVolume> open_hdf5(std::unique_ptr<ByteSource> source,
                                                     const OpenOptions& options);

}  // namespace mw::io
