// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Packed frames of 3 x 2 voxels: what is whole, and what is too short, too long or of another kind.
#include "io/volume/dicom/frame_unpacker.h"

#include <gmock/gmock.h>

#include "tests/testing.h"

namespace mw::io {
namespace {

using Bytes = std::vector<std::uint8_t>;
using ::testing::HasSubstr;

DicomGrid grid_of(std::int32_t bits) {
  DicomGrid out;
  out.rows = 2;
  out.columns = 3;
  out.bits = bits;
  return out;
}

Bytes joined(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Segments one after the other, behind a header that says so.
Bytes rle_of(const std::vector<Bytes>& segments) {
  Bytes header(64), body;
  header[0] = static_cast<std::uint8_t>(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    header[4 * i + 4] = static_cast<std::uint8_t>(header.size() + body.size());
    body = joined(std::move(body), segments[i]);
  }
  return joined(std::move(header), body);
}

std::string rle_fault(const Bytes& frame, std::int32_t bits = 8) {
  return fault_of_rle(std::as_bytes(std::span(frame)), grid_of(bits));
}

const Bytes kRun{251, 7, 0, 0};                // six times 7, and padding
const Bytes kMixed{2, 1, 2, 3, 254, 9, 0, 0};  // 1, 2, 3, and three times 9

TEST(PackedFrame, RleIsWhole) {
  EXPECT_EQ(rle_fault(rle_of({kRun})), "");
  EXPECT_EQ(rle_fault(rle_of({kMixed})), "");
  EXPECT_EQ(rle_fault(rle_of({kRun, kMixed}), 16), "");
}

TEST(PackedFrame, RleIsCutShortOrTooLong) {
  for (const Bytes& segment : {Bytes{}, Bytes{251}, Bytes{252, 7}, Bytes{250, 7}, Bytes{5, 1, 2, 3},
                               Bytes{251, 7, 252, 7}, Bytes{2, 1, 2, 3}, Bytes{128, 7, 251, 7}}) {
    EXPECT_NE(rle_fault(rle_of({segment})), "");
    EXPECT_NE(rle_fault(rle_of({segment, kRun}), 16), "");
    EXPECT_NE(rle_fault(rle_of({kRun, segment}), 16), "");
  }
  const Bytes whole = rle_of({kRun});
  for (std::size_t size = 0; size < 66; ++size) {
    EXPECT_NE(rle_fault(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))),
              "")
        << size;
  }
}

TEST(PackedFrame, RleHasAHeader) {
  EXPECT_THAT(rle_fault(rle_of({kRun}), 16), HasSubstr("1 segments"));
  EXPECT_THAT(rle_fault(rle_of({kRun, kRun})), HasSubstr("2 segments"));
  Bytes swapped = rle_of({kRun, kMixed});
  std::swap(swapped[4], swapped[8]);
  EXPECT_THAT(rle_fault(swapped, 16), HasSubstr("segment"));
  for (const std::size_t at : {4U, 7U}) {
    Bytes outside = rle_of({kRun});
    outside[at] = 255;
    EXPECT_THAT(rle_fault(outside), HasSubstr("segment 1"));
  }
}

struct Jpeg {
  std::uint8_t process = 0xF7;
  std::uint8_t bits = 8;
  std::uint8_t rows = 2;
  std::uint8_t columns = 3;
  std::uint8_t components = 1;
  std::uint8_t deviation = 0;
  std::uint8_t shift = 0;
};

/// A comment, the two segments that count, fill bytes between them, and a voxel.
Bytes bytes_of(const Jpeg& jpeg) {
  return {0xFF,
          0xD8,
          0xFF,
          0xFE,
          0,
          4,
          'h',
          'i',
          0xFF,
          jpeg.process,
          0,
          11,
          jpeg.bits,
          0,
          jpeg.rows,
          0,
          jpeg.columns,
          jpeg.components,
          1,
          0x11,
          0,
          0xFF,
          0xFF,
          0xDA,
          0,
          8,
          1,
          1,
          0,
          jpeg.deviation,
          0,
          jpeg.shift,
          42};
}

std::string jpeg_fault(const Jpeg& jpeg, std::int32_t bits = 8) {
  const Bytes frame = bytes_of(jpeg);
  return fault_of_jpeg(std::as_bytes(std::span(frame)), grid_of(bits));
}

TEST(PackedFrame, JpegIsOfTheGrid) {
  EXPECT_EQ(jpeg_fault({}), "");
  EXPECT_EQ(jpeg_fault({.process = 0xC3}), "");
  EXPECT_EQ(jpeg_fault({.process = 0xC3, .deviation = 6}), "");  // there it is a predictor
  EXPECT_EQ(jpeg_fault({.bits = 12}, 16), "");
  for (const Jpeg& other :
       {Jpeg{.bits = 16}, Jpeg{.rows = 3}, Jpeg{.columns = 2}, Jpeg{.components = 3}}) {
    EXPECT_THAT(jpeg_fault(other), HasSubstr("the file says 3 x 2 of 8"));
  }
  EXPECT_THAT(jpeg_fault({}, 16), HasSubstr("of 16"));
}

TEST(PackedFrame, JpegHasALoss) {
  for (const Jpeg& lossy : {Jpeg{.process = 0xC0}, Jpeg{.process = 0xC1}, Jpeg{.deviation = 1},
                            Jpeg{.shift = 1}, Jpeg{.process = 0xC3, .shift = 2}}) {
    EXPECT_THAT(jpeg_fault(lossy), HasSubstr("loss"));
  }
}

TEST(PackedFrame, JpegIsCutShort) {
  const Bytes whole = bytes_of({});
  for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
    const std::span<const std::uint8_t> part(whole.data(), size);
    EXPECT_THAT(fault_of_jpeg(std::as_bytes(part), grid_of(8)), HasSubstr("cut short")) << size;
  }
}

}  // namespace
}  // namespace mw::io
