// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The metadata of a Zarr array of version 3.
#include "io/volume/zarr/zarr_array.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "io/chunks/chunk.h"

namespace mw::io {

Extension parse_extension(const Json& value, const std::string& file, const std::string& where) {
  Extension out{.configuration = Json::object(), .where = where + ".configuration"};
  if (value.is_string()) {
    out.name = value.text();
    return out;
  }
  const JsonFields fields(value, file, where);
  out.name = fields.text("name");
  if (fields.has("configuration")) {
    static_cast<void>(fields.object("configuration"));  // checks that it is one
    out.configuration = value["configuration"];
  }
  return out;
}

namespace {

bool is_optional(const Json& extension) {
  const Json* needed = extension.is_object() ? extension.find("must_understand") : nullptr;
  return needed != nullptr && needed->is_boolean() && !needed->boolean();
}

/// Refuses an unknown field that does not say that it may be passed over: it is an extension that
/// changes what the bytes mean.
void check_fields(const Json& document, const JsonFields& fields) {
  constexpr std::array<std::string_view, 11> kKnown{
      "zarr_format",    "node_type", "shape",      "data_type",          "chunk_grid",
      "fill_value",     "codecs",    "attributes", "chunk_key_encoding", "storage_transformers",
      "dimension_names"};
  for (const auto& [key, value] : document.items()) {
    if (std::find(kKnown.begin(), kKnown.end(), key) != kKnown.end()) continue;
    if (is_optional(value)) continue;
    fields.fail(key, "an extension that is not known here", "write the array without it");
  }
  if (fields.has("storage_transformers") && fields.count("storage_transformers") > 0) {
    fields.fail("storage_transformers", "none is known here", "write the array without them");
  }
}

VoxelType parse_type(const Json& document, const JsonFields& fields) {
  const Extension type = parse_extension(document["data_type"], fields.file(), "data_type");
  if (type.name == "bool") return VoxelType::kU8;
  const auto known = parse_store_type(type.name);
  if (known && type.configuration.empty()) return *known;
  fields.fail("data_type", "'" + type.name.substr(0, 60) + "' is no type of labels that is read",
              "read are bool, integers of 8 to 64 bits, float32 and float64");
}

std::vector<std::int64_t> parse_grid(const Json& document, const JsonFields& fields) {
  const Extension grid = parse_extension(document["chunk_grid"], fields.file(), "chunk_grid");
  if (grid.name != "regular") {
    fields.fail("chunk_grid", "'" + grid.name.substr(0, 60) + "' is not known here",
                "write the array with a regular grid");
  }
  return grid.fields(fields.file()).integers("chunk_shape");
}

ChunkKeys parse_keys(const Json& document, const JsonFields& fields) {
  const Extension keys =
      parse_extension(document["chunk_key_encoding"], fields.file(), "chunk_key_encoding");
  const bool is_default = keys.name == "default";
  if (!is_default && keys.name != "v2") {
    fields.fail("chunk_key_encoding", "'" + keys.name.substr(0, 60) + "' is not known here",
                "write the array with 'default' or 'v2'");
  }
  const JsonFields configuration = keys.fields(fields.file());
  std::string separator = is_default ? "/" : ".";
  if (configuration.has("separator")) separator = configuration.text("separator");
  if (separator != "." && separator != "/") {
    configuration.fail("separator", "'" + separator.substr(0, 60) + "' is neither '.' nor '/'",
                       "the file is damaged");
  }
  return {.prefix = is_default ? "c" + separator : "", .separator = separator[0]};
}

/// Returns the names of the axes; one without a name is null in the metadata, and empty here.
std::vector<std::string> parse_axis_names(const Json& document, const JsonFields& fields) {
  std::vector<std::string> names;
  if (!fields.has("dimension_names")) return names;
  const std::size_t count = fields.count("dimension_names");
  for (const Json& name : document["dimension_names"].elements()) {
    names.push_back(name.is_string() ? name.text() : "");
  }
  if (count != fields.count("shape")) {
    fields.fail("dimension_names", "are not as many as the array has axes", "the file is damaged");
  }
  return names;
}

void check_is_there(const JsonFields& fields) {
  for (const char* key :
       {"data_type", "chunk_grid", "chunk_key_encoding", "codecs", "fill_value"}) {
    if (!fields.has(key)) fields.fail(key, "the field is missing", "get a whole copy of the store");
  }
}

}  // namespace

ZarrArray parse_zarr_v3(const Json& document, const std::string& file) {
  const JsonFields fields(document, file);
  if (fields.integer("zarr_format") != 3) fields.fail("zarr_format", "is not 3");
  check_is_there(fields);
  check_fields(document, fields);
  ZarrArray array;
  array.type = parse_type(document, fields);
  array.shape = fields.integers("shape");
  check_axes(file, "shape", array.shape.size());
  array.chunk.shape = parse_grid(document, fields);
  check_grid(file, "chunk_grid.configuration.chunk_shape", array.chunk.shape, array.shape.size());
  array.keys = parse_keys(document, fields);
  array.axis_names = parse_axis_names(document, fields);
  parse_codecs(document["codecs"], file, array);
  // With shards, parse_codecs() bounds the chunks; this bounds those of arrays without shards.
  check_chunk(file, "chunk_grid.configuration.chunk_shape", array.chunk.shape, array.shape.size(),
              array.type);
  array.fill = parse_fill_value(document["fill_value"], array.type, file);
  return array;
}

}  // namespace mw::io
