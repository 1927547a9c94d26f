// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file of a store whose bytes are in memory.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/file/errors.h"
#include "io/file/source/byte_source.h"

namespace mw::io {

class HeldBytes : public ByteSource {
 public:
  HeldBytes(std::vector<std::byte> bytes, std::string name)
      : bytes_(std::move(bytes)), name_(std::move(name)) {}

  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  [[nodiscard]] const std::string& name() const override { return name_; }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override {
    if (offset > bytes_.size() || out.size() > bytes_.size() - offset) {
      fail_input(name_, {},
                 text("expected ", out.size(), " bytes at offset ", offset, ", and the file has ",
                      bytes_.size()),
                 "get a whole copy of the store");
    }
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
  }

 private:
  std::vector<std::byte> bytes_;
  std::string name_;
};

}  // namespace mw::io
