// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The codecs of a Zarr array of version 3, and its shards.
#include "io/volume/zarr/zarr_array.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "io/chunks/chunk.h"
#include "io/file/errors.h"

namespace mw::io {
namespace {

/// The most bytes of the index of a shard, which is read at once.
constexpr std::uint64_t kMaxIndexBytes = 64ULL << 20U;

/// A chain of codecs while it is read.
struct Chain {
  std::vector<std::size_t> order;  ///< axes of the array, from the slowest
  std::optional<ByteOrder> bytes;  ///< once voxels have become bytes
  std::optional<Extension> shards;
  std::vector<PackStep> steps;
};

[[noreturn]] void fail_codec(const Extension& codec, const std::string& file,
                             std::string_view reason, std::string_view way_out) {
  fail_input(file, "codec " + codec.name.substr(0, 60), reason, way_out);
}

/// Adds a transposition behind those before: axis i of its result is axis order[i] of theirs.
void add_transpose(const Extension& codec, const std::string& file, Chain& chain) {
  const std::vector<std::int64_t> order = codec.fields(file).integers("order");
  std::vector<bool> seen(chain.order.size(), false);
  std::vector<std::size_t> result;
  for (const std::int64_t axis : order) {
    const auto at = static_cast<std::size_t>(axis);
    if (axis < 0 || at >= seen.size() || seen[at]) break;
    seen[at] = true;
    result.push_back(chain.order[at]);
  }
  if (result.size() != seen.size() || order.size() != seen.size()) {
    fail_codec(codec, file, text("'order' is no permutation of the ", seen.size(), " axes"),
               "the file is damaged");
  }
  chain.order = std::move(result);
}

/// Returns the byte order; it may be missing where it does not matter.
ByteOrder parse_endian(const Extension& codec, const std::string& file, int bytes) {
  const JsonFields fields = codec.fields(file);
  if (bytes == 1 && !fields.has("endian")) return ByteOrder::kLittle;
  const std::string endian = fields.text("endian");
  if (endian == "little") return ByteOrder::kLittle;
  if (endian == "big") return ByteOrder::kBig;
  fields.fail("endian", "'" + endian + "' is neither 'little' nor 'big'", "the file is damaged");
}

std::optional<PackStep> pack_step(const std::string& name) {
  if (name == "gzip") return PackStep{.codec = Codec::kGzip};
  if (name == "zstd") return PackStep{.codec = Codec::kZstd};
  if (name == "blosc") return PackStep{.codec = Codec::kBlosc};
  if (name == "crc32c") return PackStep{.is_crc32c = true};
  return std::nullopt;
}

void add_codec(Extension codec, const std::string& file, int voxel_bytes, Chain& chain) {
  const bool is_bytes = chain.bytes || chain.shards;
  if (const auto step = pack_step(codec.name)) {
    if (!is_bytes) {
      fail_codec(codec, file, "stands before the codec that makes bytes", "the file is damaged");
    }
    if (chain.shards) {
      fail_codec(codec, file, "packs whole shards, so that no chunk can be read alone",
                 "give it to the codecs within 'sharding_indexed'");
    }
    chain.steps.push_back(*step);
    return;
  }
  const bool is_known =
      codec.name == "transpose" || codec.name == "bytes" || codec.name == "sharding_indexed";
  if (!is_known) {
    fail_codec(codec, file, "is not known here",
               "write the array with bytes, transpose, gzip, zstd, blosc, crc32c or "
               "sharding_indexed");
  }
  if (is_bytes) {
    fail_codec(codec, file, "stands behind the codec that makes bytes", "the file is damaged");
  }
  if (codec.name == "transpose") {
    add_transpose(codec, file, chain);
  } else if (codec.name == "bytes") {
    chain.bytes = parse_endian(codec, file, voxel_bytes);
  } else {
    chain.shards = std::move(codec);
  }
}

Chain parse_chain(const Json& codecs, const std::string& file, const std::string& where,
                  std::vector<std::size_t> order, int voxel_bytes) {
  if (!codecs.is_array()) fail_input(file, where, "is no array", "the file is damaged");
  Chain chain{.order = std::move(order)};
  for (std::size_t i = 0; i < codecs.elements().size(); ++i) {
    add_codec(parse_extension(codecs.elements()[i], file, text(where, "[", i, "]")), file,
              voxel_bytes, chain);
  }
  if (!chain.bytes && !chain.shards) {
    fail_input(file, where, "no codec makes bytes of the voxels", "the file is damaged");
  }
  return chain;
}

/// Reads the coding of the index, which is an array of two numbers of 64 bits a chunk; so it has an
/// axis more than chunks have.
void parse_index(const Extension& shards, const std::string& file, ShardCoding& shard) {
  const JsonFields fields = shards.fields(file);
  const std::string where = fields.name_of("index_codecs");
  static_cast<void>(fields.count("index_codecs"));  // checks that it is there
  std::vector<std::size_t> order(shard.chunks.size() + 1);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const Chain index = parse_chain(shards.configuration["index_codecs"], file, where, order, 8);
  const bool is_plain =
      index.order == order &&
      std::all_of(index.steps.begin(), index.steps.end(), [](auto step) { return step.is_crc32c; });
  if (index.shards || !is_plain || index.steps.size() > 1) {
    fail_input(file, where, "an index of other codecs than bytes and crc32c is not read here",
               "write the array anew");
  }
  shard.byte_order = *index.bytes;
  shard.has_checksum = !index.steps.empty();
  if (!fields.has("index_location")) return;
  const std::string location = fields.text("index_location");
  if (location != "start" && location != "end") {
    fields.fail("index_location", "'" + location + "' is neither 'start' nor 'end'",
                "the file is damaged");
  }
  shard.index_at_end = location == "end";
}

/// Finds how many chunks a shard has along each axis; array.chunk.shape becomes that of chunks.
void parse_chunks_of_shard(const Extension& shards, const std::string& file,
                           const std::vector<std::size_t>& order, ZarrArray& array,
                           ShardCoding& shard) {
  const JsonFields fields = shards.fields(file);
  const std::vector<std::int64_t> chunk = fields.integers("chunk_shape");
  const std::string where = fields.name_of("chunk_shape");
  check_chunk(file, where, chunk, array.shape.size(), array.type);
  shard.chunks.resize(chunk.size());
  std::uint64_t count = 1;
  for (std::size_t i = 0; i < chunk.size(); ++i) {
    std::int64_t& extent = array.chunk.shape[order[i]];
    if (extent % chunk[i] != 0) {
      fail_input(file, where,
                 text("chunks of ", chunk[i], " do not divide a shard of ", extent, " voxels"),
                 "the file is damaged");
    }
    shard.chunks[order[i]] = extent / chunk[i];
    extent = chunk[i];
    const auto more = static_cast<std::uint64_t>(shard.chunks[order[i]]);
    if (more > kMaxIndexBytes / 16 / count) {
      fail_input(file, where, "shards have more than 4194304 chunks, too many to be read here",
                 "write the array in larger chunks or smaller shards");
    }
    count *= more;
  }
}

}  // namespace

void parse_codecs(const Json& codecs, const std::string& file, ZarrArray& array) {
  std::vector<std::size_t> order(array.shape.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const int bytes = byte_size(array.type);
  Chain chain = parse_chain(codecs, file, "codecs", std::move(order), bytes);
  if (chain.shards) {
    const Extension shards = std::move(*chain.shards);
    ShardCoding shard{.order = chain.order};
    parse_chunks_of_shard(shards, file, shard.order, array, shard);
    parse_index(shards, file, shard);
    array.shard = std::move(shard);
    const JsonFields fields = shards.fields(file);
    static_cast<void>(fields.count("codecs"));  // checks that it is there
    chain = parse_chain(shards.configuration["codecs"], file, fields.name_of("codecs"),
                        std::move(chain.order), bytes);
    if (chain.shards) {
      fail_codec(*chain.shards, file, "shards within shards are not read here",
                 "write the array with shards of one level");
    }
  }
  array.chunk.order = std::move(chain.order);
  array.chunk.byte_order = *chain.bytes;
  array.chunk.steps = std::move(chain.steps);
}

}  // namespace mw::io
