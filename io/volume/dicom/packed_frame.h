// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tells whether a packed frame is what the file says, as DCMTK reads many that are not.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "io/volume/dicom/dicom_segments.h"

namespace mw::io {

/// Returns what is wrong with a frame in RLE (PS3.5, annex G); empty: nothing.  DCMTK itself
/// follows the header out of the frame, fills up what is missing and leaves out what is too much.
[[nodiscard]] std::string fault_of_rle(std::span<const std::byte> frame, const DicomGrid& grid);

/// Returns what is wrong with a frame in lossless JPEG (ITU-T T.81, annex B) or JPEG-LS (T.87,
/// annex C): another size than that of the grid, or a loss; empty: nothing.
[[nodiscard]] std::string fault_of_jpeg(std::span<const std::byte> frame, const DicomGrid& grid);

}  // namespace mw::io
