// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A part of a ByteSource under a name of its own.
#pragma once

#include <memory>
#include <string>

#include "io/file/byte_source.h"
#include "io/file/errors.h"

namespace mw::io {

class PartSource : public ByteSource {
 public:
  /// The bytes [offset, offset + size).  REQUIRES: they are within whole.
  PartSource(std::unique_ptr<ByteSource> whole, std::uint64_t offset, std::uint64_t size,
             std::string name)
      : whole_(std::move(whole)), offset_(offset), size_(size), name_(std::move(name)) {}

  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] const std::string& name() const override { return name_; }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override {
    if (offset > size_ || out.size() > size_ - offset) {
      fail_input(
          name_, {},
          text("expected ", out.size(), " bytes at offset ", offset, ", but it ends at ", size_),
          "it is truncated: get a whole copy");
    }
    whole_->read_at(offset_ + offset, out);
  }

 private:
  std::unique_ptr<ByteSource> whole_;
  std::uint64_t offset_;
  std::uint64_t size_;
  std::string name_;
};

}  // namespace mw::io
