// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Random access to bytes: the seam between the formats and the file system.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mw::io {

/// A readable run of bytes.  Thread safety: all members may be called from many threads.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// What error messages call it; the path for a file.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Fills out with the bytes from offset on.
  /// ERRORS: mw::Error(kInput) with name, offset and length when there are fewer, or on I/O errors.
  virtual void read_at(std::uint64_t offset, std::span<std::byte> out) const = 0;
};

/// The first `length` bytes, or all when there are fewer.
[[nodiscard]] std::vector<std::byte> read_prefix(const ByteSource& source, std::size_t length);

}  // namespace mw::io
