// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the metadata of an N5 array say.
#include "io/volume/n5/open_n5.h"

#include "io/file/byte_order.h"
#include "io/volume/checks.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

/// The most axes that an array may have.
constexpr std::size_t kMaxAxes = 16;

Codec codec_of_name(const JsonFields& attributes, const std::string& field,
                    const std::string& type) {
  if (type == "raw") return Codec::kNone;
  if (type == "gzip") return Codec::kGzip;
  if (type == "zlib") return Codec::kZlib;
  if (type == "bzip2") return Codec::kBzip2;
  if (type == "xz") return Codec::kXz;
  if (type == "lz4") return Codec::kLz4Java;
  if (type == "blosc") return Codec::kBlosc;
  if (type == "zstd") return Codec::kZstd;
  attributes.fail(field, text("compression '", type, "' is not read here"),
                  "supported are raw, gzip, zlib, bzip2, xz, lz4, blosc and zstd");
}

/// Below version 1.0 of N5 the compression is one text, "compressionType".
Codec codec_of(const JsonFields& attributes) {
  if (!attributes.has("compression") && attributes.has("compressionType")) {
    return codec_of_name(attributes, "compressionType", attributes.text("compressionType"));
  }
  const JsonFields compression = attributes.object("compression");
  const Codec codec = codec_of_name(attributes, "compression.type", compression.text("type"));
  const bool zlib = compression.has("useZlib") && compression.flag("useZlib");
  if (codec == Codec::kGzip && zlib) return Codec::kZlib;
  // zarr-python gives an id to what is in the framing of numcodecs.
  if (codec == Codec::kLz4Java && compression.has("id")) return Codec::kLz4;
  return codec;
}

/// Returns the axes that make the volume: of more than three, the slowest of extent 1 are left out.
std::array<int, 3> axes_of(const JsonFields& attributes,
                           const std::vector<std::int64_t>& dimensions) {
  std::vector<int> kept;
  for (std::size_t i = 0; i < dimensions.size(); ++i) kept.push_back(static_cast<int>(i));
  for (std::size_t i = kept.size(); i-- > 0 && kept.size() > 3;) {
    if (dimensions[i] == 1) kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (kept.size() > 3) {
    attributes.fail("dimensions", text(kept.size(), " axes are longer than 1, and a volume has 3"),
                    "pick one of the volumes in it, and write that to an array of its own");
  }
  kept.resize(3, -1);
  return {kept[0], kept[1], kept[2]};
}

Index3 picked(const N5Array& array, const std::vector<std::int64_t>& of) {
  const auto at = [&](std::size_t i) {
    return array.axes[i] < 0 ? 1 : of[static_cast<std::size_t>(array.axes[i])];
  };
  return {at(0), at(1), at(2)};
}

void check_block_size(const JsonFields& attributes, const N5Array& array) {
  if (array.block_size.size() != array.dimensions.size()) {
    attributes.fail(
        "blockSize",
        text("has ", array.block_size.size(), " numbers, and dimensions ", array.dimensions.size()),
        "the file is damaged");
  }
  std::uint64_t max = kMaxChunkBytes / static_cast<std::uint64_t>(byte_size(array.type));
  for (const std::int64_t extent : array.block_size) {
    if (extent < 1) {
      attributes.fail("blockSize", text("extent ", extent, " is not positive"),
                      "the file is damaged");
    }
    max /= static_cast<std::uint64_t>(extent);
  }
  if (max > 0) return;
  attributes.fail("blockSize", text("blocks of ", name(array.type), " are larger than 2 GiB"),
                  "write the volume in smaller blocks");
}

}  // namespace

bool is_n5_array(const JsonFields& attributes) {
  return attributes.has("dimensions");
}

N5Array parse_n5_array(const JsonFields& attributes) {
  if (attributes.has("isLabelMultiset") && attributes.flag("isLabelMultiset")) {
    attributes.fail("isLabelMultiset", "voxels that have several labels are not read here",
                    "export the array with one label a voxel");
  }
  N5Array array{.type = store_type(attributes, "dataType"),
                .codec = codec_of(attributes),
                .dimensions = attributes.integers("dimensions"),
                .block_size = attributes.integers("blockSize")};
  const std::size_t count = array.dimensions.size();
  if (count < 2 || count > kMaxAxes) {
    attributes.fail("dimensions",
                    text("the array has ", count, " axes, and a volume 3 (a slice 2)"),
                    "give another array with --dataset");
  }
  array.axes = axes_of(attributes, array.dimensions);
  const Index3 shape = shape_of(array);
  static_cast<void>(checked_shape(attributes.file(), attributes.name_of("dimensions"),
                                  {shape.x, shape.y, shape.z}));
  check_block_size(attributes, array);
  return array;
}

Index3 shape_of(const N5Array& array) {
  return picked(array, array.dimensions);
}

Index3 block_of(const N5Array& array) {
  return picked(array, array.block_size);
}

}  // namespace mw::io
