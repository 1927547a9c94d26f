// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Groups and data sets of an HDF5 file that is written without the library.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace mw::io {

/// What a data set holds, least significant byte first.
enum class Hdf5Kind : std::uint8_t {
  kFloat64,
  kInt64,
  kUint64,
  kInt32,
  kUint8,
  kText,  ///< ASCII of variable length: a place in a heap (hdf5_text_heap.h)
};

[[nodiscard]] std::uint64_t byte_size(Hdf5Kind kind);

/// Numbers in one piece, the last dimension fastest.
struct Hdf5DataSet {
  std::string name;
  Hdf5Kind kind = Hdf5Kind::kUint8;
  std::vector<std::uint64_t> shape;
  std::uint64_t address = 0;  ///< of its first byte in the file; any when it is empty
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

/// Bytes at the begin of the file.
inline constexpr std::uint64_t kHdf5HeadBytes = 48;

/// What is written when all data are in the file.
struct Hdf5Metadata {
  std::string head;  ///< at 0, kHdf5HeadBytes
  std::string tail;  ///< from `address` to the end of the file
};

/// "HDF5 File Format Specification 3.0", what HDF5 1.8 (2008) and later read: superblock of
/// version 2, object headers of version 2, links in them, contiguous data.  No times.
/// REQUIRES: names of 1 to 255 bytes, no two alike in a group.
/// Cost: some hundred bytes a group or data set.
[[nodiscard]] Hdf5Metadata hdf5_metadata(const Hdf5Group& root, std::uint64_t address);

}  // namespace mw::io
