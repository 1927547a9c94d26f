// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The numbers of one VTK DataArray from its bytes or text.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_order.h"
#include "io/file/source/byte_source.h"

namespace mw::io {

class ByteStream {
 public:
  virtual ~ByteStream() = default;
  /// ERRORS: mw::Error(kInput) when there are fewer bytes or the text is no base64.
  virtual void read(std::span<std::byte> out) = 0;
  /// Returns an upper bound on the bytes left, counted up to `max`, to refuse absurd lengths before
  /// memory is taken.
  [[nodiscard]] virtual std::uint64_t left(std::uint64_t max) const = 0;
};

class SourceStream : public ByteStream {
 public:
  SourceStream(const ByteSource& source, std::uint64_t offset) : source_(source), next_(offset) {}
  void read(std::span<std::byte> out) override {
    source_.read_at(next_, out);
    next_ += out.size();
  }
  [[nodiscard]] std::uint64_t left(std::uint64_t max) const override {
    const std::uint64_t size = source_.size_within(saturating_sum(next_, max));
    return next_ < size ? size - next_ : 0;
  }

 private:
  const ByteSource& source_;
  std::uint64_t next_;
};

/// Decodes groups of four characters, in memory or in a source.  A padded group may stand in the
/// middle, as VTK encodes the header of an array and its data apart.  Blanks are skipped.
class Base64Stream : public ByteStream {
 public:
  Base64Stream(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}
  /// Takes the characters from `begin` to `end`, or to the end of the source, which outlives this.
  /// Memory: 64 KiB.
  Base64Stream(const ByteSource& source, std::uint64_t begin, std::uint64_t end)
      : file_(source.name()), source_(&source), begin_(begin), next_(begin), end_(end) {}
  void read(std::span<std::byte> out) override;
  [[nodiscard]] std::uint64_t left(std::uint64_t max) const override;

 private:
  void decode_group();
  [[nodiscard]] bool refill();
  [[nodiscard]] std::uint64_t unread(std::uint64_t max) const;

  std::string_view text_;
  std::string file_;
  const ByteSource* source_ = nullptr;  ///< null for characters in memory
  std::uint64_t begin_ = 0;             ///< where the first character is in the source
  std::uint64_t next_ = 0;              ///< behind those of the text
  std::uint64_t end_ = 0;
  std::string window_;
  std::size_t at_ = 0;
  std::array<std::byte, 3> group_{};
  std::size_t ready_ = 0;  ///< bytes of group_ not yet given out
  std::size_t used_ = 0;   ///< bytes of group_ given out
};

/// The type of an array's numbers: "Int8" .. "UInt64", "Float32" or "Float64".
struct NumberType {
  int bytes = 0;
  bool is_float = false;
  bool is_signed = false;
};
[[nodiscard]] std::optional<NumberType> parse_number_type(std::string_view name);

enum class VtkPacking { kNone, kZlib, kLz4, kXz };

/// How the file encodes binary arrays.
struct VtkEncoding {
  ByteOrder order = ByteOrder::kLittle;
  int header_bytes = 4;  ///< 4 or 8: UInt32 or UInt64 header words
  VtkPacking packing = VtkPacking::kNone;
};

/// The names of the file and the array in error messages.
struct ArrayName {
  std::string file;
  std::string array;
};

/// Returns the `expected` bytes of an array, decompressed.
/// ERRORS (here and below): mw::Error(kInput) naming file and array.
[[nodiscard]] std::vector<std::byte> read_payload(ByteStream& stream, const VtkEncoding& encoding,
                                                  std::uint64_t expected, const ArrayName& name);

/// Calls use() with these bytes piece by piece.  Memory: a block, and 8 bytes for each of them.
void each_piece(ByteStream& stream, const VtkEncoding& encoding, std::uint64_t expected,
                const ArrayName& name, const std::function<void(std::span<const std::byte>)>& use);

/// Returns the number of bytes that an array's own head announces, which is no more than the stream
/// could hold.  Takes the head off the stream.
[[nodiscard]] std::uint64_t announced_bytes(ByteStream& stream, const VtkEncoding& encoding,
                                            const ArrayName& name);

/// Returns the integers in two's complement of 64 bits.  REQUIRES: !type.is_float.
[[nodiscard]] std::vector<std::uint64_t> integers_of_bytes(const std::vector<std::byte>& bytes,
                                                           NumberType type, ByteOrder order);
[[nodiscard]] std::vector<double> reals_of_bytes(const std::vector<std::byte>& bytes,
                                                 NumberType type, ByteOrder order);

/// Return the numbers of the text of an array with `format="ascii"`.
[[nodiscard]] std::vector<std::uint64_t> integers_of_text(std::string_view text,
                                                          const ArrayName& name);
[[nodiscard]] std::vector<double> reals_of_text(std::string_view text, const ArrayName& name);

}  // namespace mw::io
