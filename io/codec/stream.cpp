// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The loop around libraries that unpack piece by piece.
#include "io/codec/stream.h"

#include <algorithm>

#include "io/file/errors.h"

namespace mw::io {

void fail_packed(const PackedName& name, std::string_view reason) {
  fail_input(name.file, name.codec, reason, "get a whole copy of the store");
}

void fail_too_much(const PackedName& name, std::size_t max) {
  fail_packed(name, text("unpacks to more than the ", max, " bytes that it should hold"));
}

void fail_no_memory(const PackedName& name) {
  throw Error(ErrorKind::kResource, text(name.file, ": ", name.codec, ": no memory to unpack it"));
}

namespace {

constexpr std::size_t kPieceBytes = 1 << 20;

bool is_padding(std::span<const std::byte> bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte{0}; });
}

/// Bytes that come one piece after the other.  One byte more than allowed has a place, so that too
/// many are seen.
class Output {
 public:
  /// The address space is taken at once, so that nothing moves; memory comes as bytes are written.
  explicit Output(std::size_t max) : max_(max) { bytes_.reserve(max + 1); }

  [[nodiscard]] std::span<std::byte> room() {
    bytes_.resize(std::min(max_ + 1, count_ + kPieceBytes));
    return std::span(bytes_).subspan(count_);
  }
  void took(std::size_t count) { count_ += count; }
  [[nodiscard]] bool has_too_many() const { return count_ > max_; }
  [[nodiscard]] std::vector<std::byte> take() {
    bytes_.resize(count_);
    return std::move(bytes_);
  }

 private:
  std::size_t max_;
  std::size_t count_ = 0;
  std::vector<std::byte> bytes_;
};

}  // namespace

std::vector<std::byte> unpack_streams(StreamDecoder& decoder, std::span<const std::byte> packed,
                                      std::size_t max, const PackedName& name) {
  Output out(max);
  while (true) {
    const auto step =
        decoder.step(packed.first(std::min(packed.size(), kMaxStreamStep)), out.room());
    packed = packed.subspan(step.taken);
    out.took(step.given);
    if (step.wrong != nullptr) fail_packed(name, step.wrong);
    if (out.has_too_many()) fail_too_much(name, max);
    if (step.ended) {
      if (is_padding(packed)) return out.take();
      decoder.restart();
    } else if (step.taken == 0 && step.given == 0) {
      fail_packed(name, "truncated: the packed bytes end too early");
    }
  }
}

}  // namespace mw::io
