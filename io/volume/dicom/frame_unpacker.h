// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks pixels of a DICOM file through DCMTK, in the process in which DCMTK sees the file, and
// tells before whether a packed frame is what the file says, as DCMTK reads many that are not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/volume/dicom/open_dicom.h"

class DcmDataset;
class DcmPixelData;
class DcmPixelSequence;

namespace mw::io {

/// True if a DcmXfer has pixels in fragments; DCMTK 3.6.9 has another name for it than 3.6.7.
template <class Packing>
[[nodiscard]] bool is_packed(const Packing& packing) {
  if constexpr (requires { packing.usesEncapsulatedFormat(); }) {
    return packing.usesEncapsulatedFormat();
  } else {
    return packing.isEncapsulated();
  }
}

/// Returns what is wrong with a frame in RLE (PS3.5, annex G); empty: nothing.  DCMTK itself
/// follows the header out of the frame, fills up what is missing and leaves out what is too much.
[[nodiscard]] std::string fault_of_rle(std::span<const std::byte> frame, const DicomGrid& grid);

/// Returns what is wrong with a frame in lossless JPEG (ITU-T T.81, annex B) or JPEG-LS (T.87,
/// annex C): another size than that of the grid, or a loss; empty: nothing.
[[nodiscard]] std::string fault_of_jpeg(std::span<const std::byte> frame, const DicomGrid& grid);

/// Unpacks the frames of a file in RLE, JPEG-LS or lossless JPEG, one after the other.
class FrameUnpacker {
 public:
  /// REQUIRES: data, pixels, grid and file stay as long as this does.
  /// ERRORS: mw::Error(kInput) for packings that DCMTK does not undo, and for those that do not
  /// keep the numbers of voxels.
  FrameUnpacker(DcmDataset& data, DcmPixelData& pixels, const DicomGrid& grid,
                const std::string& file);

  /// Returns the voxels of the next frame, as DicomSegments has them, until the next call.
  /// ERRORS: mw::Error(kInput) naming the frame if it is damaged, also if DCMTK goes on with a
  /// warning.
  [[nodiscard]] std::span<const std::byte> next();

 private:
  [[noreturn]] void fail(const std::string& fault) const;
  [[nodiscard]] std::string fault_of_header() const;

  DcmDataset& data_;
  DcmPixelData& pixels_;
  DcmPixelSequence* fragments_ = nullptr;
  const DicomGrid& grid_;
  const std::string& file_;
  bool is_rle_ = false;
  std::uint32_t fragment_ = 1;  ///< the next frame begins with it; 0 is a table
  std::uint32_t frame_ = 0;
  std::size_t frame_bytes_ = 0;
  std::vector<std::byte> voxels_;
};

}  // namespace mw::io
