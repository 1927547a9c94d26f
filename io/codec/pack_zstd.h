// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The counterpart of unpack_zstd(), for files of our own.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

struct ZSTD_CCtx_s;

namespace mw::io {

/// Makes frames of Zstandard (RFC 8878).  Memory: some 700 KiB at most.  Thread safety: none.
class ZstdPacker {
 public:
  /// REQUIRES: level 1 to 3.
  explicit ZstdPacker(int level);
  ~ZstdPacker();
  ZstdPacker(const ZstdPacker&) = delete;
  ZstdPacker& operator=(const ZstdPacker&) = delete;

  /// Appends one frame, which knows its content's size.  ERRORS: std::bad_alloc.
  void append(std::span<const std::byte> bytes, std::vector<std::byte>& out);

 private:
  ZSTD_CCtx_s* context_;
  int level_;
};

}  // namespace mw::io
