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

/// From `fill_value` of either version: null is 0; true and false are 1 and 0; numbers are exact up
/// to 64 bits; floats may be "NaN", "Infinity", "-Infinity" or the hexadecimal of their bits.
/// ENSURES: empty for a float that is no whole number: an error only when such a voxel is read.
/// ERRORS: mw::Error(kInput) naming file and field for what the type cannot hold.
[[nodiscard]] std::optional<RawLabel> parse_fill_value(const Json& value, VoxelType type,
                                                       std::string_view file);

// Of both: file is what errors name.  ERRORS: mw::Error(kInput) naming file and field for what is
// missing, wrong or not read here.

/// .zarray (Zarr specification, version 2).  Not read: filters, structured types and compressors
/// beyond those of Codec.
[[nodiscard]] ZarrArray parse_zarr_v2(const Json& document, const std::string& file);

/// zarr.json (Zarr core specification, version 3.0), with the codecs bytes, transpose, gzip, zstd,
/// blosc, crc32c and sharding_indexed.  Not read: extensions that must be understood.
[[nodiscard]] ZarrArray parse_zarr_v3(const Json& document, const std::string& file);

/// "NAME", or {"name": "NAME", "configuration": {...}}.
struct Extension {
  std::string name;
  Json configuration;  ///< an object, empty when there is none
  std::string where;   ///< what errors call the configuration

  [[nodiscard]] JsonFields fields(const std::string& file) const {
    return {configuration, file, where};
  }
};

/// ERRORS: mw::Error(kInput) naming file and `where` for another form.
[[nodiscard]] Extension parse_extension(const Json& value, const std::string& file,
                                        const std::string& where);

/// Reads `codecs` into array.chunk and array.shard.
/// REQUIRES: type and shape of the array are set, and array.chunk.shape is the one of the grid:
/// with sharding it becomes that of the shards' chunks. ERRORS: mw::Error(kInput) naming file and
/// codec for an unknown one, a wrong order, and sharding within shards or below further codecs.
void parse_codecs(const Json& codecs, const std::string& file, ZarrArray& array);

}  // namespace mw::io
