// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// TIFF and BigTIFF files byte by byte, by the TIFF 6.0 specification.
#pragma once

#include "tests/io/test_files.h"

namespace mw::io {

enum class TiffPacking { kNone = 1, kLzw = 5, kDeflate = 8, kPackBits = 32773 };

/// A stack that can be bent field by field.
struct TiffSample {
  Index3 shape{5, 4, 3};
  VoxelType type = VoxelType::kU8;
  bool big_endian = false;
  bool big_tiff = false;
  std::int64_t rows_per_strip = 2;
  std::int64_t tile_width = 0;  ///< 0: strips
  std::int64_t tile_height = 0;
  TiffPacking packing = TiffPacking::kNone;
  std::string description{};
  std::array<std::uint32_t, 4> resolution{};  ///< x and y as fractions; 0: none
  int resolution_unit = 0;                    ///< 3: centimetres; 0: the file does not say it
  int samples = 1;
  int photometric = 1;
  std::int64_t thumbnail_at = -1;  ///< a smaller copy in front of that page
  bool leave_out_second_block = false;
  std::int64_t pages = -1;  ///< how many of the slices get a directory

  [[nodiscard]] std::string file(const std::vector<RawLabel>& labels) const;
};

class TiffWriter {
 public:
  TiffWriter(const TiffSample& sample, const std::vector<RawLabel>& labels)
      : sample_(sample), labels_(labels), file_(sample.big_endian ? "MM" : "II") {
    file_ += number(sample.big_tiff ? 43 : 42, 2);
    if (sample.big_tiff) file_ += number(8, 2) + number(0, 2);
    link_ = file_.size();
    file_ += number(0, wide());
  }

  void add_page(std::int64_t z, bool thumbnail) {
    const Index3 n = sample_.shape;
    const bool tiled = sample_.tile_width > 0;
    const std::int64_t width = tiled ? sample_.tile_width : n.x;
    const std::int64_t height = tiled ? sample_.tile_height : sample_.rows_per_strip;
    std::vector<std::uint64_t> offsets, lengths;
    for (std::int64_t y = 0; y < n.y; y += height) {
      for (std::int64_t x = 0; x < n.x; x += width) {
        const std::int64_t rows = tiled ? height : std::min(height, n.y - y);
        const std::string block = packed(pixels({x, y, z}, width, rows));
        const bool left_out = sample_.leave_out_second_block && offsets.size() == 1;
        offsets.push_back(left_out ? 0 : file_.size());
        lengths.push_back(left_out ? 0 : block.size());
        if (!left_out) file_ += block;
      }
    }
    std::string entries;
    std::uint64_t count = 0;
    const auto add = [&](int tag, int type, const std::vector<std::uint64_t>& values) {
      entries += entry(tag, type, values);
      ++count;
    };
    constexpr int kByte = 2, kShort = 3, kLong = 4, kRational = 5, kLong8 = 16;
    const int place_type = sample_.big_tiff ? kLong8 : kLong;
    const auto u = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
    add(254, kLong, {thumbnail ? 1U : 0U});
    add(256, kLong, {thumbnail ? 1 : u(n.x)});
    add(257, kLong, {u(n.y)});
    add(258, kShort, {8U * static_cast<std::uint64_t>(byte_size(sample_.type))});
    add(259, kShort, {static_cast<std::uint64_t>(sample_.packing)});
    add(262, kShort, {u(sample_.photometric)});
    if (!sample_.description.empty()) {
      std::vector<std::uint64_t> bytes;
      for (const char c : sample_.description) bytes.push_back(static_cast<unsigned char>(c));
      bytes.push_back(0);
      add(270, kByte, bytes);
    }
    if (!tiled) add(273, place_type, offsets);
    add(277, kShort, {u(sample_.samples)});
    if (!tiled) {
      add(278, kLong, {u(height)});
      add(279, place_type, lengths);
    }
    if (sample_.resolution[1] > 0) {
      const auto& r = sample_.resolution;
      add(282, kRational, {r[0], r[1]});
      add(283, kRational, {r[2], r[3]});
    }
    if (sample_.resolution_unit > 0) add(296, kShort, {u(sample_.resolution_unit)});
    if (tiled) {
      add(322, kLong, {u(width)});
      add(323, kLong, {u(height)});
      add(324, place_type, offsets);
      add(325, place_type, lengths);
    }
    add(339, kShort, {is_float(sample_.type) ? 3U : is_signed(sample_.type) ? 2U : 1U});
    file_.replace(link_, static_cast<std::size_t>(wide()), number(file_.size(), wide()));
    file_ += number(count, sample_.big_tiff ? 8 : 2) + entries;
    link_ = file_.size();
    file_ += number(0, wide());
  }

  /// Bytes that no directory leads to.
  void append(const std::string& bytes) { file_ += bytes; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  [[nodiscard]] int wide() const { return sample_.big_tiff ? 8 : 4; }
  [[nodiscard]] std::string number(std::uint64_t value, int size) const {
    return number_bytes(value, size, sample_.big_endian);
  }

  /// Width x rows pixels; those behind the page's edge are 0xee.
  [[nodiscard]] std::string pixels(Index3 lo, std::int64_t width, std::int64_t rows) const {
    const Index3 n = sample_.shape;
    const int size = byte_size(sample_.type);
    std::string bytes;
    for (std::int64_t y = lo.y; y < lo.y + rows; ++y) {
      for (std::int64_t x = lo.x; x < lo.x + width; ++x) {
        const bool inside = x < n.x && y < n.y;
        bytes += inside
                     ? number(labels_[static_cast<std::size_t>((lo.z * n.y + y) * n.x + x)], size)
                     : std::string(static_cast<std::size_t>(size), '\xee');
      }
    }
    return bytes;
  }

  [[nodiscard]] std::string packed(const std::string& plain) const {
    if (sample_.packing == TiffPacking::kNone) return plain;
    if (sample_.packing == TiffPacking::kDeflate) return deflated(plain, 15);
    if (sample_.packing == TiffPacking::kLzw) return lzw(plain);
    // PackBits packs each row apart; all bytes literal is a valid packing.
    std::string out;
    for (std::size_t at = 0; at < plain.size(); at += 100) {
      const std::string run = plain.substr(at, 100);
      out += static_cast<char>(run.size() - 1) + run;
    }
    return out;
  }

  /// All bytes literal, in codes of 9 bits: the table is cleared before they get longer.
  [[nodiscard]] static std::string lzw(const std::string& plain) {
    constexpr unsigned kClear = 256, kDone = 257, kBits = 9;
    std::string out;
    unsigned bits = 0, filled = 0;
    const auto put = [&](unsigned code) {
      bits = bits << kBits | code;
      filled += kBits;
      for (; filled >= 8; filled -= 8) out += static_cast<char>(bits >> (filled - 8));
    };
    for (std::size_t i = 0; i < plain.size(); ++i) {
      if (i % 200 == 0) put(kClear);
      put(static_cast<unsigned char>(plain[i]));
    }
    put(kDone);
    if (filled > 0) out += static_cast<char>(bits << (8 - filled));
    return out;
  }

  /// Puts values that do not fit into the entry at the end of the file.
  std::string entry(int tag, int type, const std::vector<std::uint64_t>& values) {
    const int size = type == 2 ? 1 : type == 3 ? 2 : type == 16 ? 8 : 4;
    const std::size_t count = type == 5 ? values.size() / 2 : values.size();
    std::string bytes;
    for (const std::uint64_t value : values) bytes += number(value, size);
    if (bytes.size() > static_cast<std::size_t>(wide())) {
      const std::uint64_t position = file_.size();
      file_ += bytes;
      bytes = number(position, wide());
    }
    bytes.resize(static_cast<std::size_t>(wide()), '\0');
    return number(static_cast<std::uint64_t>(tag), 2) +
           number(static_cast<std::uint64_t>(type), 2) + number(count, wide()) + bytes;
  }

  const TiffSample& sample_;
  const std::vector<RawLabel>& labels_;
  std::string file_;
  std::size_t link_ = 0;  ///< where the place of the next directory is
};

inline std::string TiffSample::file(const std::vector<RawLabel>& labels) const {
  TiffWriter writer(*this, labels);
  for (std::int64_t z = 0; z < (pages < 0 ? shape.z : pages); ++z) {
    if (z == thumbnail_at) writer.add_page(z, true);
    writer.add_page(z, false);
  }
  return writer.file();
}

}  // namespace mw::io
