// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A TIFF file in the hands of libtiff.
#pragma once

#include <tiffio.h>

#include <memory>
#include <string>
#include <string_view>

#include "io/file/byte_source.h"

namespace mw::io {

/// libtiff over a ByteSource: it opens nothing itself, prints nothing, and takes no piece of memory
/// that is large against the file.  Thread safety: none; handles of one source may be used at once.
class TiffHandle {
 public:
  /// Stands at the first page.
  /// ERRORS: mw::Error(kInput) naming the file when it is no TIFF file.
  explicit TiffHandle(std::shared_ptr<const ByteSource> source);
  ~TiffHandle();
  TiffHandle(const TiffHandle&) = delete;
  TiffHandle& operator=(const TiffHandle&) = delete;

  /// Stands at the page whose directory begins there.
  /// ERRORS: mw::Error(kInput) naming file and place.
  void go_to(std::uint64_t directory);

  [[nodiscard]] TIFF* get() const { return tiff_; }
  [[nodiscard]] const std::string& file() const { return stream_.source->name(); }
  /// Throws mw::Error(kInput) with what libtiff said last.
  [[noreturn]] void fail(std::string_view field, std::string_view reason) const;

  /// What libtiff reads from, and where it complains.
  struct Stream {
    std::shared_ptr<const ByteSource> source;
    std::uint64_t at = 0;
    std::string complaint;
  };

 private:
  Stream stream_;
  TIFF* tiff_ = nullptr;
};

}  // namespace mw::io
