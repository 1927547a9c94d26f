// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// PNG files byte by byte, by the PNG specification (second edition).
#pragma once

#include "tests/io/test_files.h"

namespace mw::io {

struct PngSample {
  std::int64_t width = 5;
  std::int64_t height = 4;
  int depth = 8;
  int kind = 0;  ///< 0: grey, 3: palette
  bool interlaced = false;

  /// Values x fastest, below 2^depth.
  [[nodiscard]] std::string file(const std::vector<RawLabel>& values) const {
    std::string header = number_bytes(static_cast<std::uint64_t>(width), 4, true) +
                         number_bytes(static_cast<std::uint64_t>(height), 4, true);
    header += static_cast<char>(depth);
    header += static_cast<char>(kind);
    header += std::string("\0\0", 2) + (interlaced ? '\1' : '\0');
    std::string rows;
    if (interlaced) {
      // Adam7: first column and row of each pass, and its steps.
      constexpr std::array<std::array<std::int64_t, 4>, 7> kPasses{{{0, 0, 8, 8},
                                                                    {4, 0, 8, 8},
                                                                    {0, 4, 4, 8},
                                                                    {2, 0, 4, 4},
                                                                    {0, 2, 2, 4},
                                                                    {1, 0, 2, 2},
                                                                    {0, 1, 1, 2}}};
      for (const auto& [x, y, dx, dy] : kPasses) rows += pass(values, {x, y, 0}, {dx, dy, 1});
    } else {
      rows = pass(values, {0, 0, 0}, {1, 1, 1});
    }
    std::string out = "\x89PNG\r\n\x1a\n" + chunk("IHDR", header);
    if (kind == 3) out += chunk("PLTE", std::string(3 * (std::size_t{1} << depth), 'p'));
    return out + chunk("IDAT", deflated(rows, 15)) + chunk("IEND", "");
  }

 private:
  [[nodiscard]] std::string pass(const std::vector<RawLabel>& values, Index3 first,
                                 Index3 step) const {
    std::string rows;
    for (std::int64_t y = first.y; y < height; y += step.y) {
      if (first.x >= width) break;
      rows += '\0';  // no filter
      std::uint64_t bits = 0;
      int filled = 0;
      for (std::int64_t x = first.x; x < width; x += step.x) {
        bits = bits << depth | values[static_cast<std::size_t>(y * width + x)];
        filled += depth;
        for (; filled >= 8; filled -= 8) rows += static_cast<char>(bits >> (filled - 8));
      }
      if (filled > 0) rows += static_cast<char>(bits << (8 - filled));
    }
    return rows;
  }

  [[nodiscard]] static std::string chunk(const std::string& name, const std::string& content) {
    const std::string body = name + content;
    const auto crc =
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return number_bytes(content.size(), 4, true) + body + number_bytes(crc, 4, true);
  }
};

}  // namespace mw::io
