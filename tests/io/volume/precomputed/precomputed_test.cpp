// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Precomputed volumes give back every region; broken and unsupported ones are refused by name.
#include <thread>

#include "tests/io/volume/precomputed/precomputed_sample.h"

namespace mw::io {
namespace {

ShardingSample random_sharding(Random& random) {
  return {.hashed = random() % 2 == 0,
          .preshift = static_cast<int>(pick(random, 0, 5)),
          .minishard = static_cast<int>(pick(random, 0, 4)),
          .shard = static_cast<int>(pick(random, 0, 6)),
          .packed_index = random() % 2 == 0,
          .packed_data = random() % 2 == 0};
}

PrecomputedSample random_sample(Random& random) {
  constexpr std::array kTypes{VoxelType::kU8, VoxelType::kU16, VoxelType::kU32, VoxelType::kU64,
                              VoxelType::kI8, VoxelType::kI16, VoxelType::kI32, VoxelType::kI64};
  PrecomputedSample out;
  out.shape = pick_shape(random, 30);
  out.chunk = pick_shape(random, 10) + Index3{2, 2, 2};
  out.offset = {pick(random, -50, 50), pick(random, -50, 50), pick(random, 0, 1) << 40};
  out.type = kTypes[random() % kTypes.size()];
  const bool segmentation = out.type == VoxelType::kU32 || out.type == VoxelType::kU64;
  if (segmentation && random() % 3 != 0) out.block = pick_shape(random, 8);
  out.packing = static_cast<PrecomputedSample::Packing>(random() % 3);
  if (random() % 2 == 0) out.sharding = random_sharding(random);
  return out;
}

/// Labels of which a corner is 0, so that chunks may be missing.
std::vector<RawLabel> sparse_labels(Random& random, Index3 shape, VoxelType type) {
  std::vector<RawLabel> labels = random_labels(random, shape, type);
  const std::int64_t empty = pick(random, 0, shape.x);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (static_cast<std::int64_t>(i) % shape.x < empty) labels[i] = 0;
  }
  return labels;
}

TEST(Precomputed, RandomStoresGiveBackEveryRegion) {
  Random random(11);
  for (int round = 0; round < 150; ++round) {
    SCOPED_TRACE(round);
    const TempDir dir;
    const PrecomputedSample sample = random_sample(random);
    const auto labels = sparse_labels(random, sample.shape, sample.type);
    sample.write(random, dir.path(), labels);
    OpenOptions options;
    options.cache_bytes = round % 3 == 0 ? 0 : 1 << 14;
    const auto volume = open_volume(dir.path(), options);
    EXPECT_EQ(volume->info().type, sample.type);
    EXPECT_EQ(volume->info().format, "precomputed");
    EXPECT_EQ(volume->info().offset, sample.offset);
    expect_regions(random, *volume, sample.shape, labels);
    if (HasFatalFailure()) return;
  }
}

TEST(Precomputed, ManyThreadsReadOneShardedStore) {
  Random random(12);
  const TempDir dir;
  PrecomputedSample sample{.shape = {40, 30, 20}, .chunk = {8, 8, 8}, .block = Index3{4, 4, 4}};
  sample.sharding =
      ShardingSample{.hashed = true, .minishard = 2, .shard = 3, .packed_index = true};
  const auto labels = random_labels(random, sample.shape, sample.type);
  sample.write(random, dir.path(), labels);
  OpenOptions options;
  options.cache_bytes = 5000;
  const auto volume = open_volume(dir.path(), options);
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] { right += read_all(*volume) == labels ? 1 : 0; });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 4);
  EXPECT_GE(volume->buffer_bytes(4), 5000U + 4 * 512 * 4);
}

TEST(Precomputed, PlaceIsInNanometresFromTheCorner) {
  Random random(13);
  const TempDir dir;
  PrecomputedSample sample{.shape = {3, 2, 2}, .offset = {10, -20, 30}};
  sample.resolution = "[4, 4.5, 40]";
  sample.write(random, dir.path(), random_labels(random, sample.shape, sample.type));
  const VolumeSpace space = open_volume(dir.path())->info().space;
  EXPECT_EQ(space.spacing, (Vector3{4, 4.5, 40}));
  EXPECT_EQ(space.origin, (Vector3{40, -90, 1200}));
  EXPECT_EQ(space.unit, "nm");
  EXPECT_TRUE(is_upright(space));
  OpenOptions options;
  options.spacing = Vector3{1, 2, 3};
  EXPECT_EQ(open_volume(dir.path(), options)->info().space.origin, (Vector3{10, -40, 90}));
  sample.resolution = "[0, -1, \"?\"]";
  write_file(dir.path() / "info", sample.info());
  EXPECT_EQ(open_volume(dir.path(), options)->info().space.spacing, *options.spacing);
  expect_not_opened(dir.path(), {"info", "scales[0].resolution"});
}

TEST(Precomputed, FloatsHoldWholeNumbers) {
  const TempDir dir;
  PrecomputedSample sample{.shape = {2, 1, 1}, .chunk = {2, 1, 1}, .type = VoxelType::kF32};
  write_file(dir.path() / "info", sample.info());
  const auto store = [&](float a, float b) {
    const auto bits = [](float x) {
      return number_bytes(std::bit_cast<std::uint32_t>(x), 4, false);
    };
    write_file(dir.path() / "8_8_40" / "0-2_0-1_0-1", bits(a) + bits(b));
  };
  store(7, 9);
  EXPECT_EQ(read_all(*open_volume(dir.path())), (std::vector<RawLabel>{7, 9}));
  store(7, 9.5F);
  expect_not_read(dir.path(), {"8_8_40", "voxel (1, 0, 0)", "9.5"});
}

TEST(Precomputed, RawVoxelsThatLookLikeGzipAreVoxels) {
  const TempDir dir;
  PrecomputedSample sample{.shape = {8, 1, 1}, .chunk = {8, 1, 1}, .type = VoxelType::kU8};
  write_file(dir.path() / "info", sample.info());
  write_file(dir.path() / "8_8_40" / "0-8_0-1_0-1", "\x1f\x8b\x08zzzzz");
  EXPECT_EQ(read_all(*open_volume(dir.path())),
            (std::vector<RawLabel>{0x1f, 0x8b, 8, 'z', 'z', 'z', 'z', 'z'}));
}

TEST(Precomputed, ScalesByNumberAndByKey) {
  Random random(14);
  const TempDir dir;
  PrecomputedSample fine{.shape = {4, 4, 4}}, coarse{.shape = {2, 2, 2}, .key = "../other/16"};
  const auto fine_labels = random_labels(random, fine.shape, fine.type);
  const auto coarse_labels = random_labels(random, coarse.shape, coarse.type);
  const std::filesystem::path root = dir.path() / "store";
  coarse.write(random, root, coarse_labels);
  fine.write(random, root, fine_labels);
  std::string info = fine.info();
  const std::string second = coarse.info().substr(coarse.info().find("{\"key"));
  info.replace(info.rfind("]}"), 2, ", " + second);
  write_file(root / "info", info);
  EXPECT_EQ(read_all(*open_volume(root)), fine_labels);
  OpenOptions options;
  options.scale = 1;
  expect_error(ErrorKind::kInput, {"scales[1].key", "../other/16", "leads out", "--trust-paths"},
               [&] { static_cast<void>(open_volume(root, options)); });
  options.trust_paths = true;
  EXPECT_EQ(read_all(*open_volume(root, options)), coarse_labels);
  for (const int scale : {-1, 2}) {
    options.scale = scale;
    expect_misused(root, options, {"--scale", "2 scales", "8_8_40, ../other/16"});
  }
  options.scale.reset();
  options.dataset = "../other/16";
  EXPECT_EQ(read_all(*open_volume(root, options)), coarse_labels);
  options.dataset = "32";
  expect_misused(root, options, {"--dataset 32", "8_8_40"});
}

/// Replaces a piece of a good `info` and expects it to be refused.
void expect_info_refused(const std::string& from, const std::string& to,
                         std::vector<std::string> pieces) {
  Random random(15);
  const TempDir dir;
  PrecomputedSample sample;
  sample.block = Index3{8, 8, 8};
  sample.sharding = ShardingSample{};
  sample.write(random, dir.path(), random_labels(random, sample.shape, sample.type));
  std::string info = sample.info();
  const std::size_t at = info.find(from);
  ASSERT_NE(at, info.npos) << from;
  write_file(dir.path() / "info", info.replace(at, from.size(), to));
  pieces.push_back((dir.path() / "info").string());
  expect_not_opened(dir.path(), pieces);
}

TEST(PrecomputedErrors, Info) {
  expect_info_refused("\"scales\"", "\"scale\"", {"scales", "missing"});
  expect_info_refused("\"scales\": [", "\"scales\": [], \"x\": [", {"scales", "none"});
  expect_info_refused("neuroglancer_multiscale_volume", "neuroglancer_skeletons", {"no volume"});
  expect_info_refused("UINT32", "uint12", {"data_type", "uint12"});
  expect_info_refused("UINT32", "uint16", {"encoding", "u16"});
  expect_info_refused("\"num_channels\": 1", "\"num_channels\": 3", {"num_channels", "3"});
  expect_info_refused("[7, 6, 5]", "[7, 0, 5]", {"scales[0].size", "not positive"});
  expect_info_refused("[7, 6, 5]", "[7, 6]", {"scales[0].size", "2 numbers"});
  expect_info_refused("[7, 6, 5]", "[7, 6, 5.5]", {"scales[0].size", "whole numbers"});
  expect_info_refused("[7, 6, 5]", "[7, 6, 9999999]", {"scales[0].size", "9999999"});
  expect_info_refused("[0, 0, 0]", "[0, 0, 1e17]", {"voxel_offset", "2^48"});
  expect_info_refused("[8, 8, 40]", "[8, 0, 40]", {"scales[0].resolution"});
  expect_info_refused("[8, 8, 40]", "[8, NaN, 40]", {"JSON", "line 1"});
  expect_info_refused("[[4, 4, 4]]", "[[4, 0, 4]]", {"chunk_sizes", "not positive"});
  expect_info_refused("[[4, 4, 4]]", "[]", {"chunk_sizes", "empty"});
  expect_info_refused("\"compressed_segmentation\"", "\"compresso\"", {"encoding", "compresso"});
  expect_info_refused("\"compressed_segmentation\"", "\"jpeg\"", {"encoding", "jpeg"});
  expect_info_refused("[8, 8, 8]", "[8, 8, 10000000]", {"block_size", "10000000"});
  expect_info_refused("8_8_40", "/etc", {"scales[0].key", "leads out"});
  expect_info_refused("8_8_40", "../../8", {"scales[0].key", "leads out"});
  expect_info_refused("8_8_40", "a/../../../8", {"scales[0].key", "leads out"});
  expect_info_refused("8_8_40", "8_8_41", {"scales[0].key", "8_8_41", "missing"});
  expect_info_refused("uint64_sharded_v1", "uint64_sharded_v2", {"sharding.@type", "v2"});
  expect_info_refused("identity", "md5", {"sharding.hash", "md5"});
  expect_info_refused("\"minishard_bits\": 0", "\"minishard_bits\": 33", {"minishard_bits", "33"});
  expect_info_refused("\"shard_bits\": 0", "\"shard_bits\": -1", {"shard_bits", "-1"});
  expect_info_refused("\"data_encoding\": \"raw\"", "\"data_encoding\": \"zstd\"", {"zstd"});
  expect_info_refused("{", std::string(100, '['), {"JSON", "nested"});
  expect_info_refused("}", "", {"JSON"});
}

TEST(PrecomputedErrors, SizesThatNoMemoryHolds) {
  const auto huge = [](Index3 shape, Index3 chunk, std::optional<Index3> block) {
    const TempDir dir;
    PrecomputedSample sample{.shape = shape, .chunk = chunk, .type = VoxelType::kU64};
    sample.block = block;
    sample.sharding = ShardingSample{};
    write_file(dir.path() / "info", sample.info());
    std::filesystem::create_directory(dir.path() / sample.key);
    static_cast<void>(open_volume(dir.path()));
  };
  const Index3 max{1 << 20, 1 << 20, 1 << 20};
  expect_error(ErrorKind::kInput, {"chunk_sizes", "2 GiB"}, [&] { huge(max, max, {}); });
  expect_error(ErrorKind::kInput, {"minishard_bits", "more minishards"}, [&] {
    huge(max, {64, 64, 64}, {});
  });
  expect_error(ErrorKind::kInput, {"block_size", "4 GiB"}, [&] {
    huge({1, 1024, 1024}, {1, 1024, 1024}, Index3{1 << 24, 1, 1});
  });
}

TEST(PrecomputedErrors, Chunks) {
  Random random(16);
  const TempDir dir;
  PrecomputedSample sample;
  const auto labels = random_labels(random, sample.shape, sample.type);
  sample.write(random, dir.path(), labels);
  const std::filesystem::path chunk = dir.path() / "8_8_40" / "4-7_0-4_0-4";
  const auto expect = [&](const std::vector<std::string>& pieces) {
    expect_not_read(dir.path(), pieces);
  };
  const std::string good = content_of(chunk);
  write_file(chunk, good.substr(1));
  expect({chunk.string(), "191 bytes", "are 192"});
  write_file(chunk, good + std::string(1 << 20, 'x'));
  expect({chunk.string(), "at most"});
  write_file(chunk, gzip(std::string(1 << 24, '\0')));
  expect({chunk.string(), "gzip"});
  std::filesystem::remove(chunk);
  EXPECT_NE(read_all(*open_volume(dir.path())), labels);  // background now
  write_file(chunk.string() + ".br", good);
  expect({chunk.string() + ".br", "packing"});
}

TEST(PrecomputedErrors, Shards) {
  Random random(17);
  const TempDir dir;
  PrecomputedSample sample;
  sample.sharding = ShardingSample{};
  sample.write(random, dir.path(), random_labels(random, sample.shape, sample.type));
  const std::filesystem::path shard = dir.path() / "8_8_40" / "0.shard";
  const std::string good = content_of(shard);
  const auto expect = [&](const std::string& bytes, std::vector<std::string> pieces) {
    write_file(shard, bytes);
    pieces.push_back(shard.string());
    expect_not_read(dir.path(), pieces);
  };
  const std::string huge = number_bytes(~std::uint64_t{0}, 8, false);
  expect(good.substr(0, 12), {"truncated"});
  expect(good.substr(0, 8) + huge + good.substr(16), {"minishard 0", "shard index"});
  expect(huge + good.substr(8), {"minishard 0", "shard index"});
  expect(good.substr(0, good.size() - 24 * 8) + huge + good.substr(good.size() - 24 * 8 + 8),
         {"8_8_40"});
  std::filesystem::rename(shard, dir.path() / "8_8_40" / "0.index");
  expect_not_read(dir.path(), {"0.index", "old form"});
}

/// Files with a hole of 64 GiB: a reader that believes their size runs out of memory.
TEST(PrecomputedErrors, FilesThatAreFarTooLarge) {
  constexpr std::uint64_t kHuge = std::uint64_t{1} << 36;
  Random random(21);
  const auto expect = [&](const PrecomputedSample& sample, const std::string& file,
                          const std::string& start, const std::string& piece) {
    const TempDir dir;
    sample.write(random, dir.path(), random_labels(random, sample.shape, sample.type));
    const std::filesystem::path path = dir.path() / file;
    write_file(path, start.empty() ? content_of(path) : start);
    std::filesystem::resize_file(path, kHuge);
    expect_not_read(dir.path(), {path.string(), piece});
  };
  PrecomputedSample sample;
  expect(sample, "info", "", "68719476736 bytes");
  expect(sample, "8_8_40/0-4_0-4_0-4", "", "68719476736 bytes");
  sample.sharding = ShardingSample{};
  const auto number = [](std::uint64_t n) { return number_bytes(n, 8, false); };
  expect(sample, "8_8_40/0.shard", number(0) + number(kHuge - 16), "an index of 68719476720 bytes");
  sample.sharding->packed_index = true;
  expect(sample, "8_8_40/0.shard", number(0) + number(kHuge - 16), "an index of 68719476720 bytes");
  // One chunk, number 0, of all bytes.
  sample.sharding->packed_index = false;
  expect(sample, "8_8_40/0.shard",
         number(0) + number(24) + number(0) + number(0) + number(kHuge - 16),
         "the chunk has 68719476720 bytes");
}

TEST(PrecomputedDamage, InfoIsReadOrRefused) {
  Random random(18);
  const TempDir dir;
  PrecomputedSample sample{.shape = {5, 4, 3}};
  sample.block = Index3{4, 4, 4};
  sample.sharding = ShardingSample{.hashed = true, .minishard = 1, .shard = 1};
  sample.write(random, dir.path(), random_labels(random, sample.shape, sample.type));
  EXPECT_GT(refused_when_damaged(dir.path(), dir.path() / "info", 1), 1000);
}

TEST(PrecomputedDamage, ChunksAreReadOrRefused) {
  Random random(19);
  for (const auto packing : {PrecomputedSample::kPlain, PrecomputedSample::kGzipped,
                             PrecomputedSample::kGzippedWithEnding}) {
    const TempDir dir;
    PrecomputedSample sample{.shape = {5, 4, 3}, .chunk = {5, 4, 3}};
    sample.block = Index3{4, 4, 4};
    sample.packing = packing;
    sample.write(random, dir.path(), random_labels(random, sample.shape, sample.type));
    const char* ending = packing == PrecomputedSample::kGzippedWithEnding ? ".gz" : "";
    const auto chunk = dir.path() / "8_8_40" / (std::string("0-5_0-4_0-3") + ending);
    EXPECT_GT(refused_when_damaged(dir.path(), chunk, 1), 200);
  }
}

TEST(PrecomputedDamage, ShardsAreReadOrRefused) {
  Random random(20);
  for (const bool packed : {false, true}) {
    const TempDir dir;
    PrecomputedSample sample{.shape = {5, 4, 3}};
    sample.sharding = ShardingSample{.minishard = 1, .packed_index = packed, .packed_data = packed};
    sample.write(random, dir.path(), random_labels(random, sample.shape, sample.type));
    EXPECT_GT(refused_when_damaged(dir.path(), dir.path() / "8_8_40" / "0.shard", 1), 300);
  }
}

}  // namespace
}  // namespace mw::io
