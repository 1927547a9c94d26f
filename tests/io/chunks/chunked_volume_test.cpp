// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Chunked volumes and their cache, over chunks in memory of every layout.
#include "io/chunks/chunked_volume.h"

#include <thread>

#include "io/file/errors.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

/// Chunks of a volume in memory, each laid out in its own way.
class MemoryChunks : public ChunkSource {
 public:
  MemoryChunks(Index3 shape, VoxelType type, std::vector<RawLabel> labels)
      : shape_(shape), type_(type), labels_(std::move(labels)) {}

  [[nodiscard]] std::string name() const override { return "memory"; }
  [[nodiscard]] std::string name_of(Index3 chunk) const override {
    return text("chunk ", chunk.x, " ", chunk.y, " ", chunk.z);
  }
  [[nodiscard]] std::uint64_t scratch_bytes() const override { return 7; }

  [[nodiscard]] std::optional<Chunk> load(Index3 number, const Box3& box,
                                          ChunkPlace /*place*/) const override {
    ++loads;
    if (failures.fetch_sub(1) > 0) fail_input(name_of(number), {}, "cannot be read now");
    if (is_missing && is_missing(number)) return std::nullopt;
    Chunk chunk = laid_out(box, static_cast<unsigned>(number.x * 7 + number.y * 5 + number.z * 3));
    if (change) change(chunk);
    return chunk;
  }

  mutable std::atomic<int> loads = 0;
  mutable std::atomic<int> failures = 0;  ///< how many of the next loads fail
  std::function<bool(Index3)> is_missing;
  std::function<void(Chunk&)> change;

 private:
  /// Axes in any order, with room between the voxels, and in front.
  [[nodiscard]] Chunk laid_out(const Box3& box, unsigned seed) const {
    Random random(seed);
    std::array<int, 3> order{0, 1, 2};
    std::shuffle(order.begin(), order.end(), random);
    const Index3 extent = box.shape();
    std::array<std::int64_t, 3> strides{};
    std::int64_t stride = pick(random, 1, 2);
    for (const int axis : order) {
      strides[static_cast<std::size_t>(axis)] = stride;
      stride *= (axis == 0 ? extent.x : axis == 1 ? extent.y : extent.z) + pick(random, 0, 1);
    }
    Chunk chunk{.first = random() % 3, .strides = {strides[0], strides[1], strides[2]}};
    const auto size = static_cast<std::size_t>(byte_size(type_));
    chunk.bytes.resize((chunk.first + static_cast<std::size_t>(stride)) * size, std::byte{0xee});
    each_chunk(extent, {1, 1, 1}, [&](Index3 v, const Box3&) {
      const auto at = chunk.first + static_cast<std::size_t>(v.x * strides[0] + v.y * strides[1] +
                                                             v.z * strides[2]);
      const Box3 all{{0, 0, 0}, shape_};
      const RawLabel label = labels_[static_cast<std::size_t>(all.offset(box.lo + v))];
      const std::string bytes = number_bytes(label, byte_size(type_), true);
      std::memcpy(chunk.bytes.data() + at * size, bytes.data(), size);
    });
    return chunk;
  }

  Index3 shape_;
  VoxelType type_;
  std::vector<RawLabel> labels_;
};

struct Volume {
  Index3 shape;
  std::vector<RawLabel> labels;
  MemoryChunks* chunks = nullptr;  ///< the volume's
  std::unique_ptr<ChunkedVolume> volume;
};

constexpr RawLabel kFill = 77;

Volume random_volume(Random& random, Index3 shape, Index3 chunk, std::uint64_t cache_bytes) {
  const VoxelType type = kAllTypes[random() % std::size(kAllTypes)];
  Volume out{.shape = shape, .labels = random_labels(random, shape, type)};
  auto source = std::make_unique<MemoryChunks>(shape, type, out.labels);
  out.chunks = source.get();
  const VolumeInfo info{.shape = shape, .type = type, .format = "memory", .chunk = chunk};
  const VoxelCoding coding{.type = type, .order = ByteOrder::kBig};
  const ChunkFill fill{.label = kFill, .number = kFill};
  out.volume = std::make_unique<ChunkedVolume>(info, coding, fill, std::move(source), cache_bytes);
  return out;
}

/// Some chunks are not there, and the labels are then the fill value.
void lose_chunks(Volume& volume, Index3 chunk, unsigned of) {
  const auto is_missing = [of](Index3 c) {
    return static_cast<unsigned>(c.x * 31 + c.y * 17 + c.z) % of == 0;
  };
  volume.chunks->is_missing = is_missing;
  each_chunk(volume.shape, chunk, [&](Index3 number, const Box3& box) {
    if (!is_missing(number)) return;
    each_chunk(box.shape(), {1, 1, 1}, [&](Index3 v, const Box3&) {
      const Box3 all{{0, 0, 0}, volume.shape};
      volume.labels[static_cast<std::size_t>(all.offset(box.lo + v))] = kFill;
    });
  });
}

std::int64_t count_of(Index3 shape, Index3 chunk) {
  std::int64_t count = 0;
  each_chunk(shape, chunk, [&](Index3, const Box3&) { ++count; });
  return count;
}

TEST(ChunkedVolume, RandomBoxesOfAnyLayoutAndCache) {
  Random random(1);
  for (int round = 0; round < 100; ++round) {
    const Index3 shape = pick_shape(random, 17), chunk = pick_shape(random, 9);
    const std::uint64_t cache = round % 3 == 0 ? 0 : round % 3 == 1 ? 900 : 1 << 20;
    Volume volume = random_volume(random, shape, chunk, cache);
    if (round % 2 == 0) lose_chunks(volume, chunk, 3);
    expect_regions(random, *volume.volume, shape, volume.labels);
  }
}

TEST(ChunkedVolume, LoadsAChunkOnceWhileItHasRoom) {
  Random random(2);
  const Index3 shape{17, 15, 13}, chunk{4, 5, 6};
  Volume volume = random_volume(random, shape, chunk, 1 << 20);
  lose_chunks(volume, chunk, 4);
  std::vector<std::thread> threads;
  for (unsigned seed = 0; seed < 6; ++seed) {
    threads.emplace_back([&, seed] {
      Random own(seed);
      expect_regions(own, *volume.volume, shape, volume.labels);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(volume.chunks->loads, count_of(shape, chunk));
  volume.volume->drop_buffers();
  static_cast<void>(read_all(*volume.volume));
  EXPECT_EQ(volume.chunks->loads, 2 * count_of(shape, chunk));
}

TEST(ChunkedVolume, ManyThreadsWithATinyCache) {
  Random random(3);
  for (const std::uint64_t cache : {0U, 700U, 3000U}) {
    const Index3 shape{21, 18, 16}, chunk{5, 4, 7};
    Volume volume = random_volume(random, shape, chunk, cache);
    lose_chunks(volume, chunk, 5);
    std::vector<std::thread> threads;
    for (unsigned seed = 0; seed < 6; ++seed) {
      threads.emplace_back([&, seed] {
        Random own(seed);
        for (int i = 0; i < 3; ++i) expect_regions(own, *volume.volume, shape, volume.labels);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
}

// A chunk that could not be read is tried again when it is asked for next.
TEST(ChunkedVolume, ErrorsAreNotKept) {
  Random random(4);
  const Index3 shape{12, 11, 10}, chunk{5, 5, 5};
  Volume volume = random_volume(random, shape, chunk, 1 << 20);
  for (int failures = 1; failures < 5; ++failures) {
    volume.volume->drop_buffers();
    volume.chunks->failures = failures;
    for (int i = 0; i < failures; ++i) {
      expect_error(ErrorKind::kInput, {"chunk 0 0 0", "cannot be read now"},
                   [&] { static_cast<void>(read_all(*volume.volume)); });
    }
    expect_regions(random, *volume.volume, shape, volume.labels);
  }
}

TEST(ChunkedVolume, ErrorsWhileManyThreadsRead) {
  Random random(5);
  const Index3 shape{12, 11, 10}, chunk{3, 4, 5};
  Volume volume = random_volume(random, shape, chunk, 2000);
  volume.chunks->failures = 200;
  std::atomic<int> refused = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i) {
    threads.emplace_back([&] {
      bool has_read = false;
      while (!has_read) {
        try {
          EXPECT_EQ(read_all(*volume.volume), volume.labels);
          has_read = true;
        } catch (const Error& error) {
          EXPECT_EQ(error.kind(), ErrorKind::kInput);
          ++refused;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(refused, 200);  // each failure reached the one who asked
}

TEST(ChunkedVolume, ChunksThatCannotHoldTheirVoxelsAreRefused) {
  Random random(6);
  const std::vector<std::function<void(Chunk&)>> changes{
      [](Chunk& c) { c.bytes.clear(); },
      [](Chunk& c) { c.first = c.bytes.size(); },
      [](Chunk& c) { c.strides.x = -1; },
      [](Chunk& c) { c.strides.y = static_cast<std::int64_t>(c.bytes.size()); },
      [](Chunk& c) { c.strides.z = 1 << 30; },
  };
  for (const auto& change : changes) {
    Volume volume = random_volume(random, {4, 4, 4}, {4, 4, 4}, 1 << 20);
    volume.chunks->change = change;
    expect_error(ErrorKind::kInput, {"chunk 0 0 0", "too short", "whole copy"},
                 [&] { static_cast<void>(read_all(*volume.volume)); });
  }
}

// Chunks that are large against what may be kept wait in files: each is unpacked once, in whatever
// order its voxels are read, and takes no memory between reads.
TEST(ChunkedVolume, UnpacksALargeChunkOnce) {
  Random random(10);
  const Index3 shape{110, 110, 100}, chunk{110, 100, 100};
  Volume volume = random_volume(random, shape, chunk, 1 << 16);
  for (int i = 0; i < 3; ++i) expect_regions(random, *volume.volume, shape, volume.labels);
  volume.volume->drop_buffers();
  EXPECT_EQ(read_all(*volume.volume), volume.labels);
  EXPECT_EQ(volume.chunks->loads, count_of(shape, chunk));
}

TEST(ChunkedVolume, EmptyBoxesReadNothing) {
  Random random(7);
  const Volume volume = random_volume(random, {4, 4, 4}, {2, 2, 2}, 1 << 20);
  volume.volume->read({{1, 1, 1}, {1, 3, 3}}, {});
  EXPECT_EQ(volume.chunks->loads, 0);
}

TEST(ChunkedVolume, SaysWhatItHoldsAtMost) {
  Random random(8);
  const Volume volume = random_volume(random, {40, 40, 40}, {8, 4, 2}, 5000);
  const auto chunk = 64 * static_cast<std::uint64_t>(byte_size(volume.volume->info().type));
  EXPECT_EQ(volume.volume->buffer_bytes(3), 5000 + 3 * (chunk + 7));
}

std::optional<Chunk> chunk_of(std::size_t bytes) {
  return Chunk{.bytes = std::vector<std::byte>(bytes), .strides = {}};
}

// What nobody uses is gone when the bound is passed, and what was used last is there.
TEST(ChunkCache, KeepsWhatWasUsedLastWithinItsBound) {
  Random random(9);
  constexpr std::uint64_t kMax = 20000;
  ChunkCache cache(kMax);
  std::map<std::uint64_t, std::weak_ptr<const Chunk>> made;
  std::vector<std::uint64_t> used;  // the last one last
  for (int round = 0; round < 5000; ++round) {
    const std::uint64_t number = random() % 60;
    const std::size_t bytes = 100 + 37 * number;
    bool is_loaded = false;
    made[number] = cache.get(number, [&] {
      is_loaded = true;
      return chunk_of(bytes);
    });
    // Six of the largest have room.
    const auto last_six = used.end() - std::min<std::ptrdiff_t>(6, std::ssize(used));
    const bool was_used = std::find(last_six, used.end(), number) != used.end();
    EXPECT_FALSE(is_loaded && was_used);
    std::uint64_t kept = 0;
    for (const auto& [key, chunk] : made) kept += chunk.expired() ? 0 : 100 + 37 * key;
    EXPECT_LE(kept, kMax);
    used.push_back(number);
  }
}

TEST(ChunkCache, MissingChunksAreRememberedToo) {
  ChunkCache cache(10000);
  int loads = 0;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(cache.get(5,
                        [&]() -> std::optional<Chunk> {
                          ++loads;
                          return std::nullopt;
                        }),
              nullptr);
  }
  EXPECT_EQ(loads, 1);
  // But not without end: the cache forgets them like others.
  for (std::uint64_t number = 100; number < 300; ++number) {
    static_cast<void>(cache.get(number, [] { return std::optional<Chunk>(); }));
  }
  static_cast<void>(cache.get(5, [&]() -> std::optional<Chunk> {
    ++loads;
    return std::nullopt;
  }));
  EXPECT_EQ(loads, 2);
}

TEST(ChunkCache, AChunkInUseOutlivesItsPlace) {
  ChunkCache cache(0);
  const auto chunk = cache.get(1, [] { return chunk_of(1000); });
  static_cast<void>(cache.get(2, [] { return chunk_of(1000); }));
  cache.clear();
  EXPECT_EQ(chunk->bytes.size(), 1000U);
}

TEST(ChunkCache, OneLoadForAllWhoWait) {
  ChunkCache cache(1 << 20);
  std::atomic<int> loads = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      const auto chunk = cache.get(9, [&] {
        ++loads;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return chunk_of(10);
      });
      EXPECT_EQ(chunk->bytes.size(), 10U);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(loads, 1);
}

}  // namespace
}  // namespace mw::io
