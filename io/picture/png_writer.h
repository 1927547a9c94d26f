// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a PNG picture row by row.
// Format: https://www.w3.org/TR/png/
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace mw::io {

using TakeBytes = std::function<void(std::span<const std::byte>)>;

/// Writes red, green, blue and alpha of 8 bits each (alpha only with `transparent`) as sRGB.  The
/// same rows always give the same bytes.
/// Memory: some 300 KiB.  ERRORS: whatever take throws.  Thread safety: none.
class PngWriter {
 public:
  /// REQUIRES: width and height from 1 to 65535.
  PngWriter(std::uint32_t width, std::uint32_t height, bool transparent, TakeBytes take);
  ~PngWriter();
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  /// Writes the next row from the top.  Without `transparent` it is laid over white.
  /// REQUIRES: rgba.size() == 4 * width; called at most height times.
  void write_row(std::span<const std::uint8_t> rgba);
  /// REQUIRES: all rows are written; called once.
  void finish();

 private:
  struct Library;

  void pass_on();

  std::unique_ptr<Library> library_;
  TakeBytes take_;
};

}  // namespace mw::io
