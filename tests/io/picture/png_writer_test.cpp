// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pictures as libpng reads them back.
#include "io/picture/png_writer.h"

#include <png.h>

#include "tests/io/test_files.h"

namespace mw::io {
namespace {

constexpr std::uint32_t kWidth = 37, kHeight = 23;

std::vector<std::uint8_t> random_pixels() {
  std::mt19937 random(1);
  std::vector<std::uint8_t> out(4 * kWidth * kHeight);
  for (std::uint8_t& part : out) part = static_cast<std::uint8_t>(random());
  return out;
}

std::string written(const std::vector<std::uint8_t>& pixels, bool transparent) {
  std::string out;
  PngWriter png(kWidth, kHeight, transparent, [&](std::span<const std::byte> bytes) {
    out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  });
  for (std::size_t row = 0; row < kHeight; ++row) {
    png.write_row(std::span(pixels).subspan(4 * kWidth * row, 4 * kWidth));
  }
  png.finish();
  return out;
}

std::vector<std::uint8_t> read_back(const std::string& bytes, std::uint32_t format) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(image.width, kWidth);
  EXPECT_EQ(image.height, kHeight);
  EXPECT_EQ(image.format, format);
  std::vector<std::uint8_t> out(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, out.data(), 0, nullptr), 0) << image.message;
  return out;
}

TEST(PngWriter, KeepsPixelsAndTheirAlpha) {
  const std::vector<std::uint8_t> pixels = random_pixels();
  EXPECT_EQ(read_back(written(pixels, true), PNG_FORMAT_RGBA), pixels);
}

TEST(PngWriter, LaysPixelsOverWhite) {
  const std::vector<std::uint8_t> pixels = random_pixels();
  const std::vector<std::uint8_t> read = read_back(written(pixels, false), PNG_FORMAT_RGB);
  for (std::size_t i = 0; i < kWidth * kHeight; ++i) {
    const double alpha = pixels[4 * i + 3] / 255.0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(read[3 * i + k], pixels[4 * i + k] * alpha + 255 * (1 - alpha), 0.51);
    }
  }
}

TEST(PngWriter, HoldsNothingThatDiffersTheNextTime) {
  const std::vector<std::uint8_t> pixels = random_pixels();
  const std::string bytes = written(pixels, true);
  EXPECT_EQ(written(pixels, true), bytes);
  EXPECT_EQ(bytes.find("tIME"), std::string::npos);
  ASSERT_NE(bytes.find("tEXtSoftware"), std::string::npos);
  EXPECT_EQ(bytes.rfind("tEXt"), bytes.find("tEXtSoftware")) << "the only text names the program";
}

TEST(PngWriter, PassesOnTheErrorsOfItsTaker) {
  const auto full = [](std::span<const std::byte>) {
    throw Error(ErrorKind::kResource, "the disk is full");
  };
  expect_error(ErrorKind::kResource, {"full"}, [&] { PngWriter(kWidth, kHeight, true, full); });
}

}  // namespace
}  // namespace mw::io
