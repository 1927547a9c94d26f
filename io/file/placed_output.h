// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file that takes bytes at any place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace mw::io {

/// Where rows of columns go, whoever has made the file.
class PlacedOutput {
 public:
  virtual ~PlacedOutput() = default;
  /// Over what is there, and beyond the end.  ERRORS: as AtomicFile.
  virtual void write_at(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
};

}  // namespace mw::io
