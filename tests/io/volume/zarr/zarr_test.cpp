// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Arrays of Zarr 2 and 3, with and without shards, give back the labels that were written.
#include <cmath>
#include <limits>
#include <thread>

#include "io/volume/number_volume.h"
#include "tests/io/volume/zarr/zarr_sample.h"

namespace mw::io {
namespace {

TEST(ZarrV2, RandomArraysOfEveryKind) {
  Random random(1);
  const std::vector<std::string> codecs{"",    "zlib",  "gzip", "zstd", "zstd-stream",
                                        "lz4", "blosc", "bz2",  "lzma"};
  for (int round = 0; round < 90; ++round) {
    const TempDir dir;
    ZarrSample sample = random_sample(random, 14);
    const std::string& codec = codecs[static_cast<std::size_t>(round) % codecs.size()];
    if (!codec.empty()) sample.packing = {codec};
    sample.fortran = random() % 2 == 0;
    sample.write_v2(dir.path());
    SCOPED_TRACE(sample.v2_metadata().dump());
    const auto volume = open_volume(dir.path());
    EXPECT_EQ(volume->info().format, "zarr");
    EXPECT_EQ(volume->info().type, sample.type);
    expect_regions(random, *volume, sample.shape, sample.labels);
  }
}

TEST(ZarrV3, RandomArraysOfEveryKind) {
  Random random(2);
  const std::vector<std::vector<std::string>> chains{
      {},        {"gzip"},   {"zstd"},           {"zstd-stream", "crc32c"},
      {"blosc"}, {"crc32c"}, {"crc32c", "gzip"}, {"blosc", "gzip", "crc32c"}};
  for (int round = 0; round < 160; ++round) {
    const TempDir dir;
    ZarrSample sample = random_sample(random, 14);
    sample.packing = chains[static_cast<std::size_t>(round) % chains.size()];
    for (std::size_t i = random() % 3; i > 0; --i) {
      sample.transposes.push_back(random_order(random, sample.axes()));
    }
    sample.v2_keys = random() % 4 == 0;
    if (round % 2 == 1) make_shards(random, sample);
    sample.write_v3(dir.path());
    SCOPED_TRACE(sample.v3_metadata().dump());
    const auto volume = open_volume(dir.path());
    EXPECT_EQ(volume->info().format, "zarr");
    EXPECT_EQ(volume->info().type, sample.type);
    expect_regions(random, *volume, sample.shape, sample.labels);
  }
}

TEST(Zarr, ChunksOfTheVolumeAreWhatIsReadAtOnce) {
  Random random(3);
  const TempDir dir;
  ZarrSample sample{.shape = {7, 8, 9}, .chunk = {6, 4, 2}};
  sample.labels = random_labels(random, sample.shape, sample.type);
  sample.write_v2(dir.path() / "a");
  EXPECT_EQ(open_volume(dir.path() / "a")->info().chunk, (Index3{2, 4, 6}));
  sample.inner = {3, 2, 1};
  sample.write_v3(dir.path() / "b");
  EXPECT_EQ(open_volume(dir.path() / "b")->info().chunk, (Index3{1, 2, 3}));
}

// Many threads, and a cache that holds next to nothing.
TEST(Zarr, ManyThreadsReadWhatIsThere) {
  Random random(4);
  for (const bool sharded : {false, true}) {
    const TempDir dir;
    ZarrSample sample = random_sample(random, 9);
    sample.shape = {40, 31, 29};
    sample.leading = 1;
    sample.chunk = {1, 6, 7, 5};
    sample.labels = random_labels(random, sample.shape, sample.type);
    sample.packing = {"zstd", "crc32c"};
    if (sharded) make_shards(random, sample);
    sample.write_v3(dir.path());
    const auto volume = open_volume(dir.path(), {.cache_bytes = 2000});
    std::vector<std::thread> threads;
    for (unsigned seed = 0; seed < 6; ++seed) {
      threads.emplace_back([&, seed] {
        Random own(seed);
        for (int i = 0; i < 2; ++i) expect_regions(own, *volume, sample.shape, sample.labels);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
}

TEST(Zarr, SlicesAndFurtherAxes) {
  const TempDir dir;
  const auto write = [&](const Extents& shape, const std::string& names) {
    Json json{{"zarr_format", 3},
              {"node_type", "array"},
              {"shape", shape},
              {"data_type", "uint8"},
              {"chunk_grid", {{"name", "regular"}, {"configuration", {{"chunk_shape", shape}}}}},
              {"chunk_key_encoding", {{"name", "default"}}},
              {"fill_value", 0},
              {"codecs", Json::array({"bytes"})}};
    if (!names.empty()) json["dimension_names"] = Json::parse(names);
    std::filesystem::remove_all(dir.path() / "c");
    write_file(dir.path() / "zarr.json", json.dump());
    std::string key = "c";
    for (std::size_t i = 0; i < shape.size(); ++i) key += "/0";
    write_file(dir.path() / key, "abcdef");
    const auto volume = open_volume(dir.path());
    return std::pair(volume->info().shape, read_all(*volume));
  };
  const std::vector<RawLabel> straight{'a', 'b', 'c', 'd', 'e', 'f'};
  const std::vector<RawLabel> crossed{'a', 'd', 'b', 'e', 'c', 'f'};
  using Answer = std::pair<Index3, std::vector<RawLabel>>;
  EXPECT_EQ(write({2, 3}, ""), Answer({3, 2, 1}, straight));
  EXPECT_EQ(write({2, 3}, R"(["x", "y"])"), Answer({2, 3, 1}, crossed));
  EXPECT_EQ(write({1, 2, 3}, ""), Answer({3, 2, 1}, straight));
  EXPECT_EQ(write({1, 1, 2, 3}, ""), Answer({3, 2, 1}, straight));
  EXPECT_EQ(write({1, 1, 1, 2, 3}, ""), Answer({3, 2, 1}, straight));
  EXPECT_EQ(write({2, 1, 3, 1}, ""), Answer({1, 3, 2}, straight));
  EXPECT_EQ(write({1, 1, 1, 6}, ""), Answer({6, 1, 1}, straight));
  EXPECT_EQ(write({2, 1, 3, 1}, R"(["x", "y", "z", null])"), Answer({2, 1, 3}, crossed));
  EXPECT_EQ(write({2, 1, 3, 1}, R"(["rows", "t", "cols", "c"])"), Answer({1, 3, 2}, straight));
  EXPECT_EQ(write({2, 3}, R"(["z", "x"])"), Answer({3, 2, 1}, straight));
}

struct Fill {
  const char* type;
  std::string json;
  RawLabel label;
};

TEST(Zarr, FillValuesAreExact) {
  const TempDir dir;
  ZarrSample sample{.shape = {1, 1, 1}, .chunk = {1, 1, 1}};
  const std::vector<Fill> fills{
      {"uint64", "18446744073709551615", ~0ULL},
      {"uint64", "9007199254740993", 9007199254740993},
      {"int64", "-9223372036854775808", 1ULL << 63U},
      {"int64", "9007199254740993", 9007199254740993},
      {"int8", "-128", static_cast<RawLabel>(-128)},
      {"uint8", "255", 255},
      {"uint32", "7.0", 7},
      {"int16", "-7.0", static_cast<RawLabel>(-7)},
      {"bool", "true", 1},
      {"bool", "false", 0},
      {"float32", "3.0", 3},
      {"float32", "0", 0},
      {"float64", "-2", static_cast<RawLabel>(-2)},
      {"float32", "\"0x40a00000\"", 5},
      {"float64", "\"0x4014000000000000\"", 5},
  };
  for (const Fill& fill : fills) {
    Json json = sample.v3_metadata();
    json["data_type"] = fill.type;
    json["fill_value"] = Json::parse(fill.json);
    write_file(dir.path() / "zarr.json", json.dump());
    EXPECT_EQ(read_all(*open_volume(dir.path())), std::vector<RawLabel>{fill.label})
        << fill.type << " " << fill.json;
  }
  for (const char* null : {"null", "18446744073709551614"}) {
    Json json = sample.v2_metadata();
    json["dtype"] = "<u8";
    json["fill_value"] = Json::parse(null);
    std::filesystem::remove(dir.path() / "zarr.json");
    write_file(dir.path() / ".zarray", json.dump());
    EXPECT_EQ(read_all(*open_volume(dir.path())),
              std::vector<RawLabel>{null[0] == 'n' ? 0 : ~0ULL - 1});
  }
}

TEST(Zarr, FillValuesThatAreNoLabelsMatterOnlyWhereTheyAreRead) {
  const TempDir dir;
  for (const char* fill : {"\"NaN\"", "\"-Infinity\"", "0.5", "1e300", "\"0x7fc00000\""}) {
    ZarrSample sample{.shape = {1, 1, 2}, .chunk = {1, 1, 1}};
    Json json = sample.v3_metadata();
    json["data_type"] = "float32";
    json["fill_value"] = Json::parse(fill);
    write_file(dir.path() / "zarr.json", json.dump());
    write_file(dir.path() / "c.0.0.0", std::string("\0\0\x40\x40", 4));
    const auto volume = open_volume(dir.path());
    std::vector<RawLabel> out(1);
    volume->read({{0, 0, 0}, {1, 1, 1}}, out);
    EXPECT_EQ(out[0], 3U);
    expect_error(ErrorKind::kInput, {"c.1.0.0", "fill value", "no label"}, [&] {
      volume->read({{0, 0, 1}, {1, 1, 2}}, out);
    });
  }
}

TEST(Zarr, FillValuesAreNumbersWhereThoseAreRead) {
  const TempDir dir;
  const ZarrSample sample{.shape = {1, 1, 1}, .chunk = {1, 1, 1}};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto read = [&](const char* type, const char* fill) {
    Json json = sample.v3_metadata();
    json["data_type"] = type;
    json["fill_value"] = Json::parse(fill);
    write_file(dir.path() / "zarr.json", json.dump());
    const auto volume = open_volume(dir.path());
    double out = 0;
    dynamic_cast<const NumberVolume&>(*volume).read_numbers({{0, 0, 0}, {1, 1, 1}}, {&out, 1});
    return out;
  };
  EXPECT_EQ(read("float32", "0.25"), 0.25);
  EXPECT_EQ(read("float32", "0.1"), static_cast<double>(0.1F));
  EXPECT_EQ(read("float64", "0.1"), 0.1);
  EXPECT_EQ(read("float32", "1e300"), kInfinity);
  EXPECT_EQ(read("float32", "\"-Infinity\""), -kInfinity);
  EXPECT_TRUE(std::isnan(read("float32", "\"0x7fc00000\"")));
  EXPECT_EQ(read("int16", "-7"), -7);
  EXPECT_EQ(read("uint64", "18446744073709551615"), 0x1p64);
}

TEST(ZarrV2, SeparatorThatIsNotSaid) {
  Random random(5);
  for (const char separator : {'.', '/'}) {
    const TempDir dir;
    ZarrSample sample{.shape = {7, 6, 5}, .chunk = {2, 3, 4}, .separator = separator};
    sample.labels = random_labels(random, sample.shape, sample.type);
    sample.write_v2(dir.path());
    Json json = sample.v2_metadata();
    json.erase("dimension_separator");
    write_file(dir.path() / ".zarray", json.dump());
    EXPECT_EQ(read_all(*open_volume(dir.path())), sample.labels);
  }
}

// Chunks of several entries along an axis that has one.
TEST(Zarr, MemoryCountsWholeChunks) {
  Random random(6);
  const TempDir dir;
  ZarrSample sample{.shape = {4, 4, 4}, .leading = 1, .chunk = {5, 2, 2, 2}};
  sample.labels = random_labels(random, sample.shape, sample.type);
  sample.write_v2(dir.path());
  const auto wide = open_volume(dir.path())->buffer_bytes(1);
  sample.chunk = {1, 2, 2, 2};
  sample.write_v2(dir.path());
  EXPECT_GE(wide, open_volume(dir.path())->buffer_bytes(1) + 4 * 8);
}

// Booleans, floats, and consolidated metadata that are wrong and nobody reads.
TEST(ZarrV2, OtherTypesAndFilesBeside) {
  const TempDir dir;
  ZarrSample sample{.shape = {2, 1, 1}, .chunk = {1, 1, 2}};
  sample.labels = {1, 0};
  Json json = sample.v2_metadata();
  json["dtype"] = "|b1";
  json["fill_value"] = false;
  json.erase("dimension_separator");
  write_file(dir.path() / ".zarray", json.dump());
  write_file(dir.path() / "0.0.0", std::string("\1\0", 2));
  write_file(dir.path() / ".zmetadata", "{ not read");
  write_file(dir.path() / ".zattrs", R"({"_FillValue": NaN})");
  EXPECT_EQ(read_all(*open_volume(dir.path())), sample.labels);
  json["dtype"] = ">f4";
  json["fill_value"] = "NaN";
  write_file(dir.path() / ".zarray", json.dump());
  write_file(dir.path() / "0.0.0", std::string("\x40\x40\0\0\xc0\0\0\0", 8));
  EXPECT_EQ(read_all(*open_volume(dir.path())),
            (std::vector<RawLabel>{3, static_cast<RawLabel>(-2)}));
  write_file(dir.path() / "0.0.0", std::string("\x40\x40\0\0\x3f\0\0\0", 8));
  expect_not_read(dir.path(), {"voxel (1, 0, 0)", "0.5"});
}

}  // namespace
}  // namespace mw::io
