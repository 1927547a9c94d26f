// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Groups, data sets and their strings in an HDF5 file that is written without the library.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mw::io {

/// Bytes to which numbers and texts are appended.
class LittleBytes {
 public:
  /// Appends the low `bytes` bytes of value, least significant first.
  LittleBytes& number(std::uint64_t value, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) bytes_ += static_cast<char>(value >> 8 * i & 0xffU);
    return *this;
  }
  LittleBytes& text(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  /// Appends zeros up to this size.
  LittleBytes& pad_to(std::size_t size) {
    if (size > bytes_.size()) bytes_.resize(size, '\0');
    return *this;
  }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Returns Jenkins' "lookup3" (hashlittle) from 0, as the HDF5 file format asks for.
[[nodiscard]] std::uint32_t metadata_checksum(std::string_view bytes);

/// Strings in global heap collections (HDF5 file format, III.E), and the data set of
/// Hdf5Kind::kText, which has the length, the collection and the place in there of each string.
struct Hdf5Texts {
  std::string heap;       ///< the collections, to be written at `address`
  std::string positions;  ///< the data set
};

/// REQUIRES: address is a multiple of 8.
[[nodiscard]] Hdf5Texts hdf5_texts(std::span<const std::string> strings, std::uint64_t address);

/// What a data set holds, least significant byte first.
enum class Hdf5Kind : std::uint8_t {
  kFloat64,
  kInt64,
  kUint64,
  kInt32,
  kUint8,
  kText,  ///< ASCII of variable length, as a place in a heap (hdf5_texts())
};

[[nodiscard]] std::uint64_t byte_size(Hdf5Kind kind);

/// Numbers in one piece, the last dimension fastest.
struct Hdf5DataSet {
  std::string name;
  Hdf5Kind kind = Hdf5Kind::kUint8;
  std::vector<std::uint64_t> shape;
  std::uint64_t address = 0;  ///< where it begins in the file; any number when it is empty
};

struct Hdf5Attribute {
  std::string name;
  std::variant<std::string, std::vector<std::int64_t>> value;
};

struct Hdf5Group {
  std::string name;
  std::vector<Hdf5Attribute> attributes;
  std::vector<Hdf5DataSet> sets;
  std::vector<Hdf5Group> groups;
};

/// The bytes of metadata at the start of the file.
inline constexpr std::uint64_t kHdf5HeadBytes = 48;

/// What is written when all data are in the file.
struct Hdf5Metadata {
  std::string head;  ///< at 0, of kHdf5HeadBytes
  std::string tail;  ///< from `address` to the end of the file
};

/// Returns metadata that HDF5 1.8 (2008) and later read ("HDF5 File Format Specification 3.0"):
/// superblock and object headers of version 2, links in them, contiguous data and no times.
/// REQUIRES: names of 1 to 255 bytes, no two alike in a group.
/// Cost: some hundred bytes a group or data set.
[[nodiscard]] Hdf5Metadata hdf5_metadata(const Hdf5Group& root, std::uint64_t address);

}  // namespace mw::io
