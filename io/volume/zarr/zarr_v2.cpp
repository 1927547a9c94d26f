// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parses .zarray.
#include "io/volume/zarr/zarr_metadata.h"

#include <array>
#include <numeric>
#include <string_view>
#include <utility>

#include "io/json/json_fields.h"
#include "io/volume/zarr/fill_value.h"

namespace mw::io {
namespace {

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

/// numpy's letters: byte order, kind, bytes.
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
  } else {
    array.fill = 0;
  }
  return array;
}

}  // namespace mw::io
