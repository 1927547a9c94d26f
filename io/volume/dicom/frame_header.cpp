// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The headers of packed frames: 16 numbers in RLE, marked segments in JPEG and JPEG-LS.
#include "io/volume/dicom/frame_unpacker.h"

#include <algorithm>
#include <optional>

#include "io/file/byte_order.h"
#include "io/file/errors.h"

namespace mw::io {
namespace {

using FrameBytes = std::span<const std::byte>;

std::uint32_t byte_at(FrameBytes bytes, std::size_t at) {
  return std::to_integer<std::uint32_t>(bytes[at]);
}
std::uint32_t big_16_at(FrameBytes bytes, std::size_t at) {
  return load<std::uint16_t>(bytes.data() + at, ByteOrder::kBig);
}
std::uint32_t little_32_at(FrameBytes bytes, std::size_t at) {
  return load<std::uint32_t>(bytes.data() + at, ByteOrder::kLittle);
}

struct JpegHeader {
  std::uint32_t process = 0;  ///< the marker of its frame
  std::uint32_t bits = 0;
  std::uint32_t rows = 0;
  std::uint32_t columns = 0;
  std::uint32_t components = 0;
  std::uint32_t deviation = 0;  ///< in JPEG-LS, how far a value may be from the original
  std::uint32_t shift = 0;      ///< low bits that were left out
};

constexpr std::uint32_t kLosslessJpeg = 0xC3, kJpegLs = 0xF7;

bool starts_frame(std::uint32_t marker) {
  constexpr std::uint32_t kTables = 0xC4, kExtension = 0xC8, kConditioning = 0xCC;
  const bool is_process = marker >= 0xC0 && marker <= 0xCF;
  return marker == kJpegLs ||
         (is_process && marker != kTables && marker != kExtension && marker != kConditioning);
}

bool read_frame_segment(FrameBytes body, JpegHeader& out) {
  if (body.size() < 6) return false;
  out.bits = byte_at(body, 0);
  out.rows = big_16_at(body, 1);
  out.columns = big_16_at(body, 3);
  out.components = byte_at(body, 5);
  return true;
}

bool read_scan_segment(FrameBytes body, JpegHeader& out) {
  if (body.empty()) return false;
  const std::size_t behind = 1 + 2 * byte_at(body, 0);
  if (body.size() < behind + 3) return false;
  if (out.process == kJpegLs) out.deviation = byte_at(body, behind);
  out.shift = byte_at(body, behind + 2) & 0xFU;
  return true;
}

/// Reads as far as the first scan.
std::optional<JpegHeader> read_jpeg_header(FrameBytes frame) {
  constexpr std::uint32_t kMark = 0xFF, kScan = 0xDA;
  JpegHeader out;
  for (std::size_t at = 2; at + 4 <= frame.size();) {
    const std::uint32_t marker = byte_at(frame, at + 1);
    if (byte_at(frame, at) != kMark) return std::nullopt;
    if (marker == kMark) {  // more of them may stand before a marker
      ++at;
      continue;
    }
    const std::size_t length = big_16_at(frame, at + 2);
    if (length < 2 || length > frame.size() - at - 2) return std::nullopt;
    const FrameBytes body = frame.subspan(at + 4, length - 2);
    if (marker == kScan) {
      return out.process != 0 && read_scan_segment(body, out) ? std::optional(out) : std::nullopt;
    }
    if (starts_frame(marker)) {
      if (!read_frame_segment(body, out)) return std::nullopt;
      out.process = marker;
    }
    at += 2 + length;
  }
  return std::nullopt;
}

std::uint32_t bytes_of_voxel(const DicomGrid& grid) {
  return static_cast<std::uint32_t>(grid.bits) / 8;
}

/// Whether a segment unpacks to that number of bytes, with only zeros behind them that make it
/// longer.  A length of -128 is that of a run, as for DCMTK; in the standard it stands for no
/// bytes, and nobody writes it.
bool holds_bytes(FrameBytes segment, std::uint64_t bytes) {
  std::uint64_t found = 0;
  std::size_t at = 0;
  while (found < bytes && at + 1 < segment.size()) {
    const std::uint32_t length = byte_at(segment, at);
    found += length < 128 ? length + 1 : 257 - length;
    at += length < 128 ? length + 2 : 2;
  }
  if (found != bytes || at > segment.size()) return false;
  const FrameBytes rest = segment.subspan(at);
  return std::all_of(rest.begin(), rest.end(), [](std::byte b) { return b == std::byte{0}; });
}

}  // namespace

std::string fault_of_rle(std::span<const std::byte> frame, const DicomGrid& grid) {
  constexpr std::size_t kHeaderBytes = 64;
  if (frame.size() <= kHeaderBytes) return "is cut short";
  const std::uint32_t segments = little_32_at(frame, 0), expected = bytes_of_voxel(grid);
  if (segments != expected) {
    return text("has ", segments, " segments of RLE, and its voxels ", expected, " bytes");
  }
  const std::uint64_t voxels =
      static_cast<std::uint64_t>(grid.rows) * static_cast<std::uint64_t>(grid.columns);
  std::size_t end = frame.size();
  for (std::size_t i = segments; i >= 1; --i) {
    const std::size_t first = little_32_at(frame, 4 * i);
    const bool is_inside = first >= kHeaderBytes && first <= end;
    if (!is_inside || !holds_bytes(frame.subspan(first, end - first), voxels)) {
      return text("is damaged: segment ", i, " of RLE does not have a byte for each of its voxels");
    }
    end = first;
  }
  return {};
}

std::string fault_of_jpeg(std::span<const std::byte> frame, const DicomGrid& grid) {
  const std::optional<JpegHeader> header = read_jpeg_header(frame);
  if (!header) return "is cut short, or has no header of JPEG";
  const bool is_lossless = header->process == kLosslessJpeg || header->process == kJpegLs;
  if (!is_lossless || header->deviation != 0 || header->shift != 0) {
    return "is packed with a loss, so that its voxels have other numbers than before";
  }
  const bool is_of_grid = header->rows == static_cast<std::uint32_t>(grid.rows) &&
                          header->columns == static_cast<std::uint32_t>(grid.columns) &&
                          (header->bits + 7) / 8 == bytes_of_voxel(grid) && header->components == 1;
  if (is_of_grid) return {};
  return text("has ", header->columns, " x ", header->rows, " voxels of ", header->components,
              " x ", header->bits, " bits, and the file says ", grid.columns, " x ", grid.rows,
              " of ", grid.bits);
}

}  // namespace mw::io
