// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bytes in memory as a file.
#pragma once

#include <algorithm>
#include <memory>

#include "io/file/errors.h"
#include "io/file/source/byte_source.h"
#include "tests/fuzz/target.h"

namespace mw::fuzz {

/// Names of other files that it gives lead nowhere from its own.
/// REQUIRES: the bytes outlive it.
class ByteFile : public io::ByteSource {
 public:
  explicit ByteFile(Bytes bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  [[nodiscard]] const std::string& name() const override { return name_; }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override {
    if (offset > bytes_.size() || out.size() > bytes_.size() - offset) {
      io::fail_input(name_, {}, io::text("ends before ", offset, " + ", out.size()));
    }
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
  }

 private:
  Bytes bytes_;
  std::string name_ = "/nonexistent/fuzzed";
};

}  // namespace mw::fuzz
