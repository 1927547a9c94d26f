// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a DICOM segmentation as a volume of labels.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "io/file/source/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Whether this is the beginning of a DICOM file.
[[nodiscard]] bool has_dicom_magic(std::span<const std::byte> head);

/// Segments become labels as masks do, in the order of their numbers (MaskMerger), with their
/// names; slices without a frame are empty.  Voxels of FRACTIONAL segments count from half of the
/// largest value on.  Labels of a LABELMAP stay as they are, numbers of segments, and have their
/// names; slices without a frame have its Pixel Padding Value, or 0.
/// Array axes: columns, rows, slices along the normal.
/// ERRORS: those of read_dicom_segments() and MaskMerger; mw::Error(kInput) when frames do not lie
/// on one grid, or two frames of a segment, or of a label map, lie at one place.
[[nodiscard]] std::unique_ptr<LabelVolume> open_dicom(std::unique_ptr<ByteSource> source,
                                                      const OpenOptions& options);

}  // namespace mw::io
