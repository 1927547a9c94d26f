// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The metadata of a Zarr array of version 2, and the fill value of both versions.
#include "io/volume/zarr/zarr_array.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "io/file/errors.h"
#include "io/json/json_fields.h"

namespace mw::io {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[noreturn]] void fail_fill(const Json& value, VoxelType type, std::string_view file) {
  const std::string shown =
      value.is_structured() ? "a structure" : value.dump_ascii().substr(0, 60);
  fail_input(file, "fill_value", text(shown, " is no ", name(type)), "the file is damaged");
}

std::optional<RawLabel> label_of(double value) {
  if (!(value >= -0x1p63 && value < 0x1p63) || value != std::floor(value)) return std::nullopt;
  return static_cast<RawLabel>(static_cast<std::int64_t>(value));
}

/// Returns the float whose bits the text has; "0x7fc00000" is the usual NaN.
std::optional<double> float_of_bits(std::string_view digits, VoxelType type) {
  if (digits.substr(0, 2) != "0x") return std::nullopt;
  digits.remove_prefix(2);
  std::uint64_t bits = 0;
  const char* end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, bits, 16);
  if (read.ec != std::errc{} || read.ptr != end) return std::nullopt;
  if (type == VoxelType::kF64) return std::bit_cast<double>(bits);
  if (bits > UINT32_MAX) return std::nullopt;
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

/// Returns what a voxel of the type is whose file was written with this number.
double as_stored(double number, VoxelType type) {
  if (type == VoxelType::kF64 || !std::isfinite(number)) return number;
  if (std::abs(number) > std::numeric_limits<float>::max()) return std::copysign(kInfinity, number);
  return static_cast<double>(static_cast<float>(number));
}

double parse_float(const Json& value, VoxelType type, std::string_view file) {
  if (value.is_number()) return as_stored(value.number(), type);
  if (!value.is_string()) fail_fill(value, type, file);
  const std::string& word = value.text();
  if (word == "NaN") return std::numeric_limits<double>::quiet_NaN();
  if (word == "Infinity") return kInfinity;
  if (word == "-Infinity") return -kInfinity;
  const auto number = float_of_bits(word, type);
  if (!number) fail_fill(value, type, file);
  return *number;
}

bool holds_signed(VoxelType type, std::int64_t number) {
  const std::int64_t max = INT64_MAX >> (64 - 8 * byte_size(type));
  return number >= -max - 1 && number <= max;
}

bool holds_unsigned(VoxelType type, std::uint64_t number) {
  return number <= UINT64_MAX >> (64 - 8 * byte_size(type));
}

RawLabel parse_integer(const Json& value, VoxelType type, std::string_view file) {
  if (value.is_boolean()) return value.boolean() ? 1 : 0;
  if (value.is_unsigned()) {
    const std::uint64_t number = value.integer();
    const bool fits = is_signed(type) ? number <= static_cast<std::uint64_t>(INT64_MAX) &&
                                            holds_signed(type, static_cast<std::int64_t>(number))
                                      : holds_unsigned(type, number);
    if (fits) return number;
  } else if (value.is_number()) {  // negative, or written as 0.0
    const auto label = value.is_float() ? label_of(value.number()) : std::optional(value.integer());
    if (label) {
      const auto number = static_cast<std::int64_t>(*label);
      if (is_signed(type) ? holds_signed(type, number)
                          : number >= 0 && holds_unsigned(type, *label)) {
        return *label;
      }
    }
  }
  fail_fill(value, type, file);
}

struct TypeName {
  std::string_view kind_and_bytes;
  VoxelType type;
};

constexpr std::array kTypes{
    TypeName{"b1", VoxelType::kU8},  TypeName{"u1", VoxelType::kU8},
    TypeName{"u2", VoxelType::kU16}, TypeName{"u4", VoxelType::kU32},
    TypeName{"u8", VoxelType::kU64}, TypeName{"i1", VoxelType::kI8},
    TypeName{"i2", VoxelType::kI16}, TypeName{"i4", VoxelType::kI32},
    TypeName{"i8", VoxelType::kI64}, TypeName{"f4", VoxelType::kF32},
    TypeName{"f8", VoxelType::kF64},
};

/// Reads numpy's three letters: byte order, kind, bytes.
void parse_type(const JsonFields& fields, ZarrArray& array) {
  const std::string text = fields.text("dtype");
  for (const TypeName& type : kTypes) {
    if (text.size() != 3 || text.substr(1) != type.kind_and_bytes) continue;
    if (text[0] != '<' && text[0] != '>' && (text[0] != '|' || text[2] != '1')) break;
    array.type = type.type;
    array.chunk.byte_order = text[0] == '>' ? ByteOrder::kBig : ByteOrder::kLittle;
    return;
  }
  fields.fail("dtype", "'" + text + "' is no type of labels that is read here",
              "read are booleans, integers of 8 to 64 bits and floats of 32 and 64");
}

Codec codec_of(const JsonFields& compressor) {
  constexpr std::array kCodecs{
      std::pair{"zlib", Codec::kZlib}, std::pair{"gzip", Codec::kGzip},
      std::pair{"zstd", Codec::kZstd}, std::pair{"blosc", Codec::kBlosc},
      std::pair{"lz4", Codec::kLz4},   std::pair{"bz2", Codec::kBzip2},
      std::pair{"lzma", Codec::kXz},
  };
  const std::string id = compressor.text("id");
  for (const auto& [known, codec] : kCodecs) {
    if (id == known) return codec;
  }
  compressor.fail("id", "'" + id + "' is no compressor that is read here",
                  "write the array with zlib, gzip, zstd, blosc, lz4, bz2 or lzma");
}

void parse_compressor(const JsonFields& fields, ZarrArray& array) {
  if (!fields.has("compressor")) return;
  const JsonFields compressor = fields.object("compressor");
  const Codec codec = codec_of(compressor);
  if (codec == Codec::kXz && compressor.has("format") && compressor.integer("format") != 1) {
    compressor.fail("format", "lzma is read as .xz (format 1) only", "write the array anew");
  }
  array.chunk.steps = {{.codec = codec}};
}

void parse_order(const JsonFields& fields, ZarrArray& array) {
  const std::string order = fields.text("order");
  array.chunk.order.resize(array.shape.size());
  if (order == "C") {
    std::iota(array.chunk.order.begin(), array.chunk.order.end(), std::size_t{0});
  } else if (order == "F") {
    std::iota(array.chunk.order.rbegin(), array.chunk.order.rend(), std::size_t{0});
  } else {
    fields.fail("order", "'" + order + "' is neither 'C' nor 'F'", "the file is damaged");
  }
}

void parse_separator(const JsonFields& fields, ZarrArray& array) {
  if (!fields.has("dimension_separator")) return;
  const std::string separator = fields.text("dimension_separator");
  if (separator != "." && separator != "/") {
    fields.fail("dimension_separator", "'" + separator + "' is neither '.' nor '/'",
                "the file is damaged");
  }
  array.keys.separator = separator[0];
}

void check_filters(const JsonFields& fields) {
  if (!fields.has("filters") || fields.count("filters") == 0) return;
  const JsonFields filter = fields.element("filters", 0);
  filter.fail("id", "filter '" + filter.text("id") + "' is not read here",
              "write the array without filters");
}

}  // namespace

ChunkFill parse_fill_value(const Json& value, VoxelType type, std::string_view file) {
  if (value.is_null()) return {};
  if (is_float(type)) {
    const double number = parse_float(value, type, file);
    return {.label = label_of(number), .number = number};
  }
  const RawLabel label = parse_integer(value, type, file);
  return {.label = label,
          .number = is_signed(type) ? static_cast<double>(static_cast<std::int64_t>(label))
                                    : static_cast<double>(label)};
}

ZarrArray parse_zarr_v2(const Json& document, const std::string& file) {
  const JsonFields fields(document, file);
  if (fields.integer("zarr_format") != 2) {
    fields.fail("zarr_format", "is not 2", "the file is damaged");
  }
  ZarrArray array;
  parse_type(fields, array);
  array.shape = fields.integers("shape");
  check_axes(fields.file(), "shape", array.shape.size());
  array.chunk.shape = fields.integers("chunks");
  check_chunk(file, "chunks", array.chunk.shape, array.shape.size(), array.type);
  parse_order(fields, array);
  parse_separator(fields, array);
  check_filters(fields);
  parse_compressor(fields, array);
  if (fields.has("fill_value")) {
    array.fill = parse_fill_value(document["fill_value"], array.type, file);
  }
  return array;
}

}  // namespace mw::io
