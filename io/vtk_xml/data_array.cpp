// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The numbers of one VTK DataArray from its bytes or text.
#include "io/vtk_xml/data_array.h"

#include <lz4.h>
#include <zlib.h>

#include <algorithm>

#include "io/codec/codec.h"
#include "io/file/errors.h"
#include "io/file/read_number.h"

namespace mw::io {
namespace {

/// The most bytes that a packed byte unpacks to.
std::uint64_t max_ratio(VtkPacking packing) {
  return packing == VtkPacking::kXz ? 16384 : 1040;
}

constexpr std::uint64_t kPieceBytes = 1 << 20;
/// The most packed bytes of an array whose size is not known from elsewhere.
constexpr std::uint64_t kMaxAnnounced = std::uint64_t{1} << 40U;

[[noreturn]] void fail(const ArrayName& name, std::string_view reason) {
  fail_input(name.file, text("array '", name.array, "'"), reason, "the file is damaged");
}

bool may_hold(const ByteStream& stream, std::uint64_t bytes) {
  return stream.left(bytes) >= bytes;
}

std::uint64_t read_word(ByteStream& stream, const VtkEncoding& encoding) {
  std::array<std::byte, 8> bytes{};
  const std::size_t size = encoding.header_bytes == 4 ? 4 : 8;
  stream.read(std::span(bytes).first(size));
  return size == 4 ? load<std::uint32_t>(bytes.data(), encoding.order)
                   : load<std::uint64_t>(bytes.data(), encoding.order);
}

void check_length(std::uint64_t found, std::uint64_t expected, const ArrayName& name) {
  if (found == expected) return;
  fail(name, text("holds ", found, " bytes, the counts of the piece need ", expected));
}

void inflate_zlib(const std::vector<std::byte>& packed, std::span<std::byte> out,
                  const ArrayName& name) {
  auto length = static_cast<uLongf>(out.size());
  const int verdict =
      uncompress(reinterpret_cast<Bytef*>(out.data()), &length,
                 reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
  if (verdict != Z_OK || length != out.size()) fail(name, "corrupt zlib data");
}

void inflate_lz4(const std::vector<std::byte>& packed, std::span<std::byte> out,
                 const ArrayName& name) {
  if (packed.size() > LZ4_MAX_INPUT_SIZE || out.size() > LZ4_MAX_INPUT_SIZE) {
    fail(name, "a block is above 2 GiB");
  }
  const int length = LZ4_decompress_safe(
      reinterpret_cast<const char*>(packed.data()), reinterpret_cast<char*>(out.data()),
      static_cast<int>(packed.size()), static_cast<int>(out.size()));
  if (length < 0 || static_cast<std::size_t>(length) != out.size()) {
    fail(name, "corrupt LZ4 data");
  }
}

void unpack_xz(const std::vector<std::byte>& packed, std::span<std::byte> out,
               const ArrayName& name) {
  const std::vector<std::byte> plain =
      unpack(Codec::kXz, packed, out.size(), text(name.file, ": array '", name.array, "'"));
  check_length(plain.size(), out.size(), name);
  std::copy(plain.begin(), plain.end(), out.begin());
}

void unpack_block(VtkPacking packing, const std::vector<std::byte>& packed,
                  std::span<std::byte> out, const ArrayName& name) {
  if (packing == VtkPacking::kXz) return unpack_xz(packed, out, name);
  if (packing == VtkPacking::kLz4) return inflate_lz4(packed, out, name);
  inflate_zlib(packed, out, name);
}

using UsePiece = std::function<void(std::span<const std::byte>)>;

/// Reads [blocks][bytes of a block][bytes of the last, 0 when whole][packed bytes of each] and then
/// the packed blocks.
void each_block(ByteStream& stream, const VtkEncoding& encoding, std::uint64_t expected,
                const ArrayName& name, const UsePiece& use) {
  const std::uint64_t blocks = read_word(stream, encoding);
  const std::uint64_t block_bytes = read_word(stream, encoding);
  const std::uint64_t last_bytes = read_word(stream, encoding);
  const std::uint64_t last = blocks == 0 || last_bytes != 0 ? last_bytes : block_bytes;
  const std::uint64_t ratio = max_ratio(encoding.packing);
  // The numbers of a damaged file may be anything, so that no product may overflow.
  const auto word = static_cast<std::uint64_t>(encoding.header_bytes);
  if (!may_hold(stream, saturating_product(blocks, word)) || !may_hold(stream, expected / ratio) ||
      last > block_bytes ||
      (blocks > 1 && (block_bytes == 0 || blocks - 1 > expected / block_bytes))) {
    fail(name, "block counts are not credible");
  }
  check_length(blocks == 0 ? 0 : (blocks - 1) * block_bytes + last, expected, name);
  std::vector<std::uint64_t> packed_bytes(blocks);
  for (std::uint64_t& size : packed_bytes) size = read_word(stream, encoding);
  std::vector<std::byte> out;
  std::vector<std::byte> packed;
  for (std::uint64_t i = 0; i < blocks; ++i) {
    const std::uint64_t bytes = i + 1 < blocks ? block_bytes : last;
    if (!may_hold(stream, packed_bytes[i])) fail(name, "truncated");
    if (bytes / ratio > packed_bytes[i]) fail(name, "a block is not credible");
    packed.resize(packed_bytes[i]);
    stream.read(packed);
    out.resize(bytes);
    unpack_block(encoding.packing, packed, out, name);
    use(out);
  }
}

/// Calls use(number) on each number of the bytes.
template <class T, class Use>
void visit_as(const std::vector<std::byte>& bytes, ByteOrder order, Use use) {
  for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T)) {
    use(load<T>(bytes.data() + at, order));
  }
}

template <class Use>
void visit_integers(const std::vector<std::byte>& bytes, NumberType type, ByteOrder order,
                    Use use) {
  switch (type.bytes * (type.is_signed ? -1 : 1)) {
    case 1:
      return visit_as<std::uint8_t>(bytes, order, use);
    case 2:
      return visit_as<std::uint16_t>(bytes, order, use);
    case 4:
      return visit_as<std::uint32_t>(bytes, order, use);
    case 8:
      return visit_as<std::uint64_t>(bytes, order, use);
    case -1:
      return visit_as<std::int8_t>(bytes, order, use);
    case -2:
      return visit_as<std::int16_t>(bytes, order, use);
    case -4:
      return visit_as<std::int32_t>(bytes, order, use);
    default:
      return visit_as<std::int64_t>(bytes, order, use);
  }
}

/// Calls use(word) on each word of the text.
template <class Use>
void visit_words(std::string_view text, Use use) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    use(text.substr(at, end - at));
    at = text.find_first_not_of(kBlanks, end);
  }
}

template <class T>
T parse_word(std::string_view word, const ArrayName& name) {
  T number{};
  if (!read_number(word, number)) {
    fail(name, text("'", word.substr(0, 40), "' is no valid number"));
  }
  return number;
}

}  // namespace

std::optional<NumberType> parse_number_type(std::string_view name) {
  if (name == "Float32") return NumberType{4, true, true};
  if (name == "Float64") return NumberType{8, true, true};
  const bool is_unsigned = name.starts_with("UInt");
  if (!is_unsigned && !name.starts_with("Int")) return std::nullopt;
  const std::string_view bits = name.substr(is_unsigned ? 4 : 3);
  for (const int bytes : {1, 2, 4, 8}) {
    if (bits == std::to_string(8 * bytes)) return NumberType{bytes, false, !is_unsigned};
  }
  return std::nullopt;
}

void each_piece(ByteStream& stream, const VtkEncoding& encoding, std::uint64_t expected,
                const ArrayName& name, const UsePiece& use) {
  if (encoding.packing != VtkPacking::kNone) {
    return each_block(stream, encoding, expected, name, use);
  }
  check_length(read_word(stream, encoding), expected, name);
  const std::uint64_t left = stream.left(expected);
  if (expected > left) {
    fail(name, text("truncated: needs ", expected, " bytes, at most ", left, " are left"));
  }
  std::vector<std::byte> piece;
  for (std::uint64_t done = 0; done < expected; done += piece.size()) {
    piece.resize(static_cast<std::size_t>(std::min(expected - done, kPieceBytes)));
    stream.read(piece);
    use(piece);
  }
}

std::vector<std::byte> read_payload(ByteStream& stream, const VtkEncoding& encoding,
                                    std::uint64_t expected, const ArrayName& name) {
  std::vector<std::byte> all;
  each_piece(stream, encoding, expected, name, [&](std::span<const std::byte> piece) {
    // The first piece shows that the size is credible, so that memory for all is taken then.
    if (all.empty()) all.reserve(expected);
    all.insert(all.end(), piece.begin(), piece.end());
  });
  return all;
}

std::uint64_t announced_bytes(ByteStream& stream, const VtkEncoding& encoding,
                              const ArrayName& name) {
  const std::uint64_t first = read_word(stream, encoding);
  if (encoding.packing == VtkPacking::kNone) {
    if (!may_hold(stream, first)) fail(name, "truncated");
    return first;
  }
  const std::uint64_t block_bytes = read_word(stream, encoding);
  const std::uint64_t last_bytes = read_word(stream, encoding);
  if (first == 0) return 0;
  const std::uint64_t max = stream.left(kMaxAnnounced) * max_ratio(encoding.packing);
  if (block_bytes > max || last_bytes > block_bytes ||
      (block_bytes != 0 && first > max / block_bytes)) {
    fail(name, "block counts are not credible");
  }
  return last_bytes == 0 ? first * block_bytes : (first - 1) * block_bytes + last_bytes;
}

std::vector<std::uint64_t> integers_of_bytes(const std::vector<std::byte>& bytes, NumberType type,
                                             ByteOrder order) {
  std::vector<std::uint64_t> numbers;
  numbers.reserve(bytes.size() / static_cast<std::size_t>(type.bytes));
  visit_integers(bytes, type, order,
                 [&](auto number) { numbers.push_back(static_cast<std::uint64_t>(number)); });
  return numbers;
}

std::vector<double> reals_of_bytes(const std::vector<std::byte>& bytes, NumberType type,
                                   ByteOrder order) {
  std::vector<double> numbers;
  numbers.reserve(bytes.size() / static_cast<std::size_t>(type.bytes));
  const auto use = [&](auto number) { numbers.push_back(static_cast<double>(number)); };
  if (!type.is_float) {
    visit_integers(bytes, type, order, use);
  } else if (type.bytes == 4) {
    visit_as<float>(bytes, order, use);
  } else {
    visit_as<double>(bytes, order, use);
  }
  return numbers;
}

std::vector<std::uint64_t> integers_of_text(std::string_view text, const ArrayName& name) {
  std::vector<std::uint64_t> numbers;
  visit_words(text, [&](std::string_view word) {
    numbers.push_back(word[0] == '-'
                          ? static_cast<std::uint64_t>(parse_word<std::int64_t>(word, name))
                          : parse_word<std::uint64_t>(word, name));
  });
  return numbers;
}

std::vector<double> reals_of_text(std::string_view text, const ArrayName& name) {
  std::vector<double> numbers;
  visit_words(text,
              [&](std::string_view word) { numbers.push_back(parse_word<double>(word, name)); });
  return numbers;
}

namespace {

constexpr std::array<std::int8_t, 256> make_values() {
  std::array<std::int8_t, 256> values{};
  for (std::int8_t& value : values) value = -1;
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  }
  return values;
}
constexpr std::array<std::int8_t, 256> kValues = make_values();

}  // namespace

std::uint64_t Base64Stream::unread(std::uint64_t max) const {
  if (source_ == nullptr) return 0;
  const std::uint64_t end = source_->size_within(std::min(end_, saturating_sum(next_, max)));
  return end > next_ ? end - next_ : 0;
}

std::uint64_t Base64Stream::left(std::uint64_t max) const {
  return std::min<std::uint64_t>(ready_ + (text_.size() - at_) + unread(max), max);
}

/// Reads the next characters of the source; false where there are none.
bool Base64Stream::refill() {
  constexpr std::uint64_t kWindowBytes = 64 << 10;
  const std::uint64_t count = unread(kWindowBytes);
  if (count == 0) return false;
  window_.resize(count);
  source_->read_at(next_, std::as_writable_bytes(std::span(window_)));
  next_ += count;
  text_ = window_;
  at_ = 0;
  return true;
}

void Base64Stream::decode_group() {
  std::uint32_t bits = 0;
  std::size_t digits = 0;
  std::size_t padding = 0;
  while (digits + padding < 4) {
    if (at_ == text_.size() && !refill()) fail_input(file_, "base64 data", "truncated");
    const char c = text_[at_++];
    if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
    const std::int8_t value = kValues[static_cast<unsigned char>(c)];
    if (c == '=' && digits >= 2) {
      ++padding;
    } else if (value < 0 || padding > 0) {
      fail_input(file_, "base64 data",
                 text("invalid character at position ", next_ - begin_ - window_.size() + at_ - 1));
    } else {
      bits |= static_cast<std::uint32_t>(value) << (18 - 6 * digits++);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    group_[i] = static_cast<std::byte>((bits >> (16 - 8 * i)) & 255U);
  }
  ready_ = digits - 1;
  used_ = 0;
}

void Base64Stream::read(std::span<std::byte> out) {
  for (std::byte& byte : out) {
    if (ready_ == 0) decode_group();
    byte = group_[used_++];
    --ready_;
  }
}

}  // namespace mw::io
