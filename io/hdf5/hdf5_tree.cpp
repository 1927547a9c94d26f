// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes the metadata of an HDF5 file.
#include "io/hdf5/hdf5_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "kernels/core/assert.h"

namespace mw::io {
namespace {

using State = std::array<std::uint32_t, 3>;

void mix(State& s) {
  auto& [a, b, c] = s;
  a -= c, a ^= std::rotl(c, 4), c += b;
  b -= a, b ^= std::rotl(a, 6), a += c;
  c -= b, c ^= std::rotl(b, 8), b += a;
  a -= c, a ^= std::rotl(c, 16), c += b;
  b -= a, b ^= std::rotl(a, 19), a += c;
  c -= b, c ^= std::rotl(b, 4), b += a;
}

void finish(State& s) {
  auto& [a, b, c] = s;
  c ^= b, c -= std::rotl(b, 14);
  a ^= c, a -= std::rotl(c, 11);
  b ^= a, b -= std::rotl(a, 25);
  c ^= b, c -= std::rotl(b, 16);
  a ^= c, a -= std::rotl(c, 4);
  b ^= a, b -= std::rotl(a, 14);
  c ^= b, c -= std::rotl(b, 24);
}

/// Adds up to twelve bytes to the state, least significant first.
void add(std::string_view bytes, State& s) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    s[i / 4] += std::uint32_t{static_cast<unsigned char>(bytes[i])} << 8 * (i % 4);
  }
}

}  // namespace

std::uint32_t metadata_checksum(std::string_view bytes) {
  constexpr std::size_t kStep = 12;
  const std::uint32_t start = 0xdeadbeef + static_cast<std::uint32_t>(bytes.size());
  State s{start, start, start};
  if (bytes.empty()) return s[2];
  for (; bytes.size() > kStep; bytes.remove_prefix(kStep)) {
    add(bytes.substr(0, kStep), s);
    mix(s);
  }
  add(bytes, s);
  finish(s);
  return s[2];
}

namespace {

constexpr std::size_t kMaxObjects = 1000;
constexpr std::size_t kHeadBytes = 16;        ///< of a collection, and of an object in it too
constexpr std::size_t kMinCollection = 4096;  ///< what the library reads at once

std::size_t padded(std::size_t bytes) {
  return (bytes + 7) / 8 * 8;
}

/// Returns a collection of the strings; object 0, the last one, is its free space.
LittleBytes collection_of(std::span<const std::string> strings) {
  LittleBytes objects;
  for (std::size_t i = 0; i < strings.size(); ++i) {
    objects.number(i + 1, 2).number(1, 2).number(0, 4).number(strings[i].size(), 8);
    objects.text(strings[i]).pad_to(padded(objects.size()));
  }
  const std::size_t size = std::max(kMinCollection, 2 * kHeadBytes + objects.size());
  LittleBytes out;
  out.text("GCOL").number(1, 4).number(size, 8).text(objects.bytes());
  out.number(0, 8).number(size - kHeadBytes - objects.size(), 8).pad_to(size);
  return out;
}

}  // namespace

Hdf5Texts hdf5_texts(std::span<const std::string> strings, std::uint64_t address) {
  Hdf5Texts out;
  LittleBytes positions;
  for (; !strings.empty(); strings = strings.subspan(std::min(kMaxObjects, strings.size()))) {
    const auto some = strings.first(std::min(kMaxObjects, strings.size()));
    for (std::size_t i = 0; i < some.size(); ++i) {
      const bool empty = some[i].empty();  // an empty string has no object
      positions.number(some[i].size(), 4).number(empty ? 0 : address + out.heap.size(), 8);
      positions.number(empty ? 0 : i + 1, 4);
    }
    out.heap += collection_of(some).bytes();
  }
  out.positions = positions.bytes();
  return out;
}

namespace {

constexpr std::uint64_t kNowhere = ~std::uint64_t{0};

/// The types of messages in object headers (HDF5 file format, IV.A.2, as all sections below).
enum Message : std::uint8_t {
  kDataspace = 0x01,
  kLinkInfo = 0x02,
  kDatatype = 0x03,
  kFillValue = 0x05,
  kLink = 0x06,
  kLayout = 0x08,
  kGroupInfo = 0x0a,
  kAttribute = 0x0c,
};

void add_message(LittleBytes& out, Message type, const LittleBytes& body) {
  out.number(type, 1).number(body.size(), 2).number(0, 1).text(body.bytes());
}

/// Returns the message of IV.A.2.b, version 2; without extents it is that of a scalar.
LittleBytes dataspace(const std::vector<std::uint64_t>& shape) {
  LittleBytes out;
  out.number(2, 1).number(shape.size(), 1).number(0, 1).number(shape.empty() ? 0 : 1, 1);
  for (const std::uint64_t extent : shape) out.number(extent, 8);
  return out;
}

/// Returns the start of a type (IV.A.2.d, version 1); bits are the flags of its class.
LittleBytes type_head(unsigned of_class, unsigned bits, std::uint64_t bytes) {
  LittleBytes out;
  out.number(0x10U | of_class, 1).number(bits, 3).number(bytes, 4);
  return out;
}

LittleBytes integer_type(bool is_signed, std::uint64_t bytes) {
  LittleBytes out = type_head(0, is_signed ? 0x08 : 0, bytes);
  out.number(0, 2).number(8 * bytes, 2);  // all bits matter
  return out;
}

/// Returns the type of IEEE 754 numbers: the mantissa's leading 1 is implied, the sign is bit 63;
/// then come exponent and mantissa, each by first bit and number of bits, and the bias.
LittleBytes float64_type() {
  LittleBytes out = type_head(1, 0x3f20, 8);
  out.number(0, 2).number(64, 2).number(52, 1).number(11, 1).number(0, 1).number(52, 1);
  out.number(1023, 4);
  return out;
}

LittleBytes datatype(Hdf5Kind kind) {
  switch (kind) {
    case Hdf5Kind::kFloat64:
      return float64_type();
    case Hdf5Kind::kInt64:
      return integer_type(true, 8);
    case Hdf5Kind::kUint64:
      return integer_type(false, 8);
    case Hdf5Kind::kInt32:
      return integer_type(true, 4);
    case Hdf5Kind::kUint8:
      return integer_type(false, 1);
    case Hdf5Kind::kText:
      break;
  }
  LittleBytes out = type_head(9, 1, byte_size(Hdf5Kind::kText));
  out.text(integer_type(false, 1).bytes());
  return out;
}

/// Returns the message of IV.A.2.m, version 3.
LittleBytes attribute(const Hdf5Attribute& a) {
  LittleBytes type, space, value;
  if (const auto* const text = std::get_if<std::string>(&a.value)) {
    constexpr unsigned kPaddedByNulls = 1;
    type = type_head(3, kPaddedByNulls, text->size());
    space = dataspace({});
    value.text(*text);
  } else {
    const auto& numbers = std::get<std::vector<std::int64_t>>(a.value);
    type = integer_type(true, 8);
    space = dataspace({numbers.size()});
    for (const std::int64_t n : numbers) value.number(static_cast<std::uint64_t>(n), 8);
  }
  LittleBytes out;
  out.number(3, 1).number(0, 1).number(a.name.size() + 1, 2);
  out.number(type.size(), 2).number(space.size(), 2).number(0, 1);
  out.text(a.name).number(0, 1).text(type.bytes()).text(space.bytes()).text(value.bytes());
  return out;
}

/// Returns the message of a hard link (IV.A.2.g, version 1).
LittleBytes link(const std::string& name, std::uint64_t address) {
  MW_ASSERT(!name.empty() && name.size() < 256);
  LittleBytes out;
  out.number(1, 1).number(0, 1).number(name.size(), 1).text(name).number(address, 8);
  return out;
}

std::uint64_t bytes_of(const Hdf5DataSet& set) {
  return std::accumulate(set.shape.begin(), set.shape.end(), byte_size(set.kind),
                         std::multiplies<>());
}

/// Returns the message of contiguous data (IV.A.2.i, version 3).
LittleBytes layout(const Hdf5DataSet& set) {
  const std::uint64_t bytes = bytes_of(set);
  LittleBytes out;
  out.number(3, 1).number(1, 1).number(bytes == 0 ? kNowhere : set.address, 8).number(bytes, 8);
  return out;
}

/// Writes object headers, children before their parents, and knows where each will be.
class Tail {
 public:
  explicit Tail(std::uint64_t address) : address_(address) {}

  std::uint64_t add(const Hdf5Group& group) {
    LittleBytes messages;
    LittleBytes info;
    info.number(0, 2).number(kNowhere, 8).number(kNowhere, 8);  // links are messages
    add_message(messages, kLinkInfo, info);
    add_message(messages, kGroupInfo, LittleBytes().number(0, 2));
    for (const Hdf5Attribute& a : group.attributes) {
      add_message(messages, kAttribute, attribute(a));
    }
    for (const Hdf5DataSet& s : group.sets) add_message(messages, kLink, link(s.name, add(s)));
    for (const Hdf5Group& g : group.groups) add_message(messages, kLink, link(g.name, add(g)));
    return add_header(messages);
  }

  [[nodiscard]] std::uint64_t end() const { return address_ + bytes_.size(); }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::uint64_t add(const Hdf5DataSet& set) {
    // The library allocates space late, and fills it only if a fill value is set.
    constexpr unsigned kLate = 2, kIfSet = 2 << 2;
    LittleBytes messages;
    add_message(messages, kDataspace, dataspace(set.shape));
    add_message(messages, kDatatype, datatype(set.kind));
    add_message(messages, kFillValue, LittleBytes().number(3, 1).number(kLate | kIfSet, 1));
    add_message(messages, kLayout, layout(set));
    return add_header(messages);
  }

  /// Adds an object header (IV.A.1.b, version 2) in one chunk, whose size has four bytes.
  std::uint64_t add_header(const LittleBytes& messages) {
    constexpr unsigned kFourBytes = 2;
    LittleBytes out;
    out.text("OHDR").number(2, 1).number(kFourBytes, 1).number(messages.size(), 4);
    out.text(messages.bytes());
    out.number(metadata_checksum(out.bytes()), 4);
    const std::uint64_t at = end();
    bytes_ += out.bytes();
    return at;
  }

  std::uint64_t address_;
  std::string bytes_;
};

}  // namespace

std::uint64_t byte_size(Hdf5Kind kind) {
  switch (kind) {
    case Hdf5Kind::kFloat64:
    case Hdf5Kind::kInt64:
    case Hdf5Kind::kUint64:
      return 8;
    case Hdf5Kind::kInt32:
      return 4;
    case Hdf5Kind::kUint8:
      return 1;
    case Hdf5Kind::kText:
      return 16;
  }
  return 0;
}

// The head is a superblock of version 2 (II.B).
Hdf5Metadata hdf5_metadata(const Hdf5Group& root, std::uint64_t address) {
  Tail tail(address);
  const std::uint64_t first = tail.add(root);
  LittleBytes head;
  head.text("\x89HDF\r\n\x1a\n").number(2, 1).number(8, 1).number(8, 1).number(0, 1);
  head.number(0, 8).number(kNowhere, 8).number(tail.end(), 8).number(first, 8);
  head.number(metadata_checksum(head.bytes()), 4);
  MW_ASSERT(head.size() == kHdf5HeadBytes);
  return {head.bytes(), tail.bytes()};
}

}  // namespace mw::io
