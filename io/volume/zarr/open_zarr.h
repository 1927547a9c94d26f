// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an array or a multiscale image of a Zarr store as a volume.
#pragma once

#include "io/store/place.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Whether the folder is a node of a store, or its name ends in .zarr.
[[nodiscard]] bool is_zarr(const Place& folder);

/// Opens the node that options.dataset names below the folder, or the folder itself: an array, a
/// multiscale image of OME-NGFF, or a group with only one of them below it.  options.scale is the
/// level of an image.  Axes are z, y, x unless the metadata name them; levels of images are placed
/// by their transformations, also when they are opened as arrays.
/// ERRORS: mw::Error(kInput) naming file and field; kUsage when there is no such dataset or scale.
[[nodiscard]] std::unique_ptr<LabelVolume> open_zarr(const Place& folder,
                                                     const OpenOptions& options);

/// Returns how many levels the image at the folder, or at options.dataset in it, has; 1 for what is
/// no image.  ERRORS: mw::Error(kInput) when its metadata are damaged.
[[nodiscard]] std::size_t count_zarr_scales(const Place& folder, const OpenOptions& options);

}  // namespace mw::io
