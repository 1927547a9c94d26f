// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The metadata of a Zarr array, in both versions of the format.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/json/json.h"
#include "io/json/json_fields.h"
#include "io/volume/label_volume.h"
#include "io/volume/zarr/zarr_array.h"

namespace mw::io {

/// Reads `fill_value` of either version: null is 0; true and false are 1 and 0; numbers are exact
/// up to 64 bits; floats may be "NaN", "Infinity", "-Infinity" or the hexadecimal of their bits.
/// ENSURES: there is no label for a float that is no whole number.
/// ERRORS: mw::Error(kInput) naming file and field for what the type cannot hold.
[[nodiscard]] ChunkFill parse_fill_value(const Json& value, VoxelType type, std::string_view file);

// The two functions below: errors name `file`.  ERRORS: mw::Error(kInput) naming file and field for
// what is missing, wrong or not read here.

/// Reads a .zarray (Zarr specification, version 2), but no filters, structured types or compressors
/// beyond those of Codec.
[[nodiscard]] ZarrArray parse_zarr_v2(const Json& document, const std::string& file);

/// Reads a zarr.json (Zarr core specification, version 3.0) with the codecs bytes, transpose, gzip,
/// zstd, blosc, crc32c and sharding_indexed, but no extensions that must be understood.
[[nodiscard]] ZarrArray parse_zarr_v3(const Json& document, const std::string& file);

/// An extension, written as "NAME" or {"name": "NAME", "configuration": {...}}.
struct Extension {
  std::string name;
  Json configuration;  ///< an object, empty when there is none
  std::string where;   ///< what errors call the configuration

  [[nodiscard]] JsonFields fields(const std::string& file) const {
    return {configuration, file, where};
  }
};

/// Reads an extension.  ERRORS: mw::Error(kInput) naming file and `where` for another form.
[[nodiscard]] Extension parse_extension(const Json& value, const std::string& file,
                                        const std::string& where);

/// Reads `codecs` into array.chunk and array.shard.
/// REQUIRES: type and shape of the array are set, and array.chunk.shape is the one of the grid:
/// with sharding it becomes that of the shards' chunks.
/// ERRORS: mw::Error(kInput) naming file and codec for an unknown one, a wrong order, and sharding
/// within shards or below further codecs.
void parse_codecs(const Json& codecs, const std::string& file, ZarrArray& array);

}  // namespace mw::io
