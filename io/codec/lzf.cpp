// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks LZF.
#include "io/codec/codec.h"
#include "io/codec/stream.h"

namespace mw::io {
namespace {

/// A first byte below this is the length of a run less 1.  Otherwise its upper 3 bits are the
/// length of a copy less 2 (if they are 7, another byte adds to it), and its lower 5 bits with the
/// next byte are the distance less 1.
constexpr std::size_t kFirstCopy = 32;
constexpr std::size_t kLongCopy = 7;

class Decoder {
 public:
  Decoder(std::span<const std::byte> packed, std::size_t max, std::string_view name)
      : packed_(packed), max_(max), name_{"lzf", name} {}

  [[nodiscard]] std::vector<std::byte> decode() {
    while (at_ < packed_.size()) {
      const std::size_t first = next();
      if (first < kFirstCopy) {
        run(first + 1);
      } else {
        copy(first);
      }
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::size_t next() {
    if (at_ == packed_.size()) fail_packed(name_, "truncated");
    return std::to_integer<std::size_t>(packed_[at_++]);
  }

  void make_room(std::size_t length) {
    if (length > max_ - out_.size()) fail_too_much(name_, max_);
  }

  void run(std::size_t length) {
    if (length > packed_.size() - at_) fail_packed(name_, "truncated");
    make_room(length);
    const auto begin = packed_.begin() + static_cast<std::ptrdiff_t>(at_);
    out_.insert(out_.end(), begin, begin + static_cast<std::ptrdiff_t>(length));
    at_ += length;
  }

  void copy(std::size_t first) {
    std::size_t length = first >> 5U;
    if (length == kLongCopy) length += next();
    length += 2;
    const std::size_t distance = ((first & 31U) << 8U) + next() + 1;
    if (distance > out_.size()) fail_packed(name_, "damaged: a copy begins before the data");
    make_room(length);
    // It goes byte by byte, since a copy may overlap itself.
    for (std::size_t i = 0; i < length; ++i) out_.push_back(out_[out_.size() - distance]);
  }

  std::span<const std::byte> packed_;
  std::size_t max_;
  PackedName name_;
  std::size_t at_ = 0;
  std::vector<std::byte> out_;
};

}  // namespace

std::vector<std::byte> unpack_lzf(std::span<const std::byte> packed, std::size_t max,
                                  std::string_view name) {
  return Decoder(packed, max, name).decode();
}

}  // namespace mw::io
