// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes are known before a shard is begun, so it is written from its first byte to its last.
#include "io/surface/precomputed/draco_segments.h"

#include <algorithm>
#include <bit>

#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
#include "io/surface/surface_sink.h"
#include "io/volume/precomputed/sharding.h"

namespace mw::io {
namespace {

/// What a shard and a minishard are meant to hold at most; chance makes some of them larger.
/// Readers fetch the index of a minishard, 24 bytes a segment, before its first segment.
constexpr std::uint64_t kShardBytes = std::uint64_t{1} << 28U;
constexpr std::uint64_t kMinishardSegments = 512;

/// Returns the least number of bits that have `count` different values.
int bits_for(std::uint64_t count) {
  return count <= 1 ? 0 : static_cast<int>(std::bit_width(count - 1));
}

Sharding sharding_for(std::uint64_t segments, std::uint64_t bytes) {
  const int shard_bits = bits_for((bytes + kShardBytes - 1) / kShardBytes);
  const int all_bits = bits_for((segments + kMinishardSegments - 1) / kMinishardSegments);
  return {.hashed = true,
          .minishard_bits = std::max(0, all_bits - shard_bits),
          .shard_bits = shard_bits};
}

Json sharding_json(const Sharding& sharding) {
  return {{"@type", "neuroglancer_uint64_sharded_v1"},
          {"preshift_bits", sharding.preshift_bits},
          {"hash", "murmurhash3_x86_128"},
          {"minishard_bits", sharding.minishard_bits},
          {"shard_bits", sharding.shard_bits},
          {"minishard_index_encoding", "raw"},
          {"data_encoding", "raw"}};
}

}  // namespace

/// Writes segments, sorted by shard, minishard and number.
class DracoSegments::ShardWriter {
 public:
  /// REQUIRES: waiting outlives it.
  ShardWriter(const std::filesystem::path& folder, ScratchFile& waiting, const Sharding& sharding)
      : folder_(folder), waiting_(waiting), sharding_(sharding) {}

  void write(std::vector<Entry> entries) {
    const auto place = [&](const Entry& e) {
      const ShardPosition at = position_of(sharding_, e.segment);
      return std::array<std::uint64_t, 3>{at.shard, at.minishard, e.segment};
    };
    std::sort(entries.begin(), entries.end(),
              [&](const Entry& a, const Entry& b) { return place(a) < place(b); });
    std::vector<std::vector<Entry>> minishards;
    std::uint64_t shard = 0;
    for (const Entry& entry : entries) {
      const ShardPosition at = position_of(sharding_, entry.segment);
      if (at.shard != shard) write_shard(shard, minishards);
      shard = at.shard;
      minishards.resize(std::size_t{1} << static_cast<unsigned>(sharding_.minishard_bits));
      minishards[at.minishard].push_back(entry);
    }
    write_shard(shard, minishards);
  }

 private:
  /// Offsets in a shard count from the end of its index.  A minishard's index follows its segments.
  void write_shard(std::uint64_t shard, std::vector<std::vector<Entry>>& minishards) {
    if (minishards.empty()) return;
    AtomicFile file(folder_ / shard_file_name(sharding_, shard));
    std::uint64_t end = 0;
    for (const std::vector<Entry>& minishard : minishards) {
      for (const Entry& e : minishard) end += e.fragment_bytes + e.manifest_bytes;
      append_little(file, end);
      end += 24 * minishard.size();
      append_little(file, end);
    }
    std::uint64_t at = 0;
    for (const std::vector<Entry>& minishard : minishards)
      at = write_minishard(minishard, at, file);
    file.commit();
    minishards.clear();
  }

  /// Returns where the next minishard begins.
  std::uint64_t write_minishard(const std::vector<Entry>& entries, std::uint64_t begin,
                                AtomicFile& file) {
    std::uint64_t bytes = 0;
    for (const Entry& e : entries) {
      waiting_.copy_to(file, e.offset, e.fragment_bytes + e.manifest_bytes);
      bytes += e.fragment_bytes + e.manifest_bytes;
    }
    std::uint64_t last = 0;
    for (const Entry& e : entries) append_little(file, e.segment - std::exchange(last, e.segment));
    // The index has the places of manifests; fragments lie in the gaps before them.
    std::uint64_t gap = begin;
    for (const Entry& e : entries) append_little(file, std::exchange(gap, 0) + e.fragment_bytes);
    for (const Entry& e : entries) append_little(file, e.manifest_bytes);
    return begin + bytes + 24 * entries.size();
  }

  std::filesystem::path folder_;
  ScratchFile& waiting_;
  Sharding sharding_;
};

void DracoSegments::add(std::uint64_t segment, std::string_view fragments,
                        std::string_view manifest) {
  entries_.push_back({segment, waiting_.size(), fragments.size(), manifest.size()});
  waiting_.append(fragments);
  waiting_.append(manifest);
}

void DracoSegments::write_single(const Entry& entry) {
  const std::filesystem::path path = folder_ / text(entry.segment);
  AtomicFile fragments(path), manifest(path.string() + ".index");
  waiting_.copy_to(fragments, entry.offset, entry.fragment_bytes);
  waiting_.copy_to(manifest, entry.offset + entry.fragment_bytes, entry.manifest_bytes);
  fragments.commit();
  manifest.commit();
}

Json DracoSegments::finish(std::size_t most_single) {
  if (entries_.size() <= most_single) {
    for (const Entry& entry : entries_) write_single(entry);
    return nullptr;
  }
  const Sharding sharding = sharding_for(entries_.size(), waiting_.size());
  ShardWriter(folder_, waiting_, sharding).write(entries_);
  return sharding_json(sharding);
}

}  // namespace mw::io
