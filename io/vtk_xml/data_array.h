// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The numbers of one VTK DataArray from its bytes or text.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_order.h"
#include "io/vtk_xml/byte_stream.h"

namespace mw::io {

/// The type of an array's numbers: "Int8" .. "UInt64", "Float32" or "Float64".
struct NumberType {
  int bytes = 0;
  bool is_float = false;
  bool is_signed = false;
};
[[nodiscard]] std::optional<NumberType> parse_number_type(std::string_view name);

enum class VtkPacking { kNone, kZlib, kLz4 };

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
