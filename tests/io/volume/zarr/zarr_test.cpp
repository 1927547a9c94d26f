// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a reader of Zarr holds, and numbers that are no labels; zarr_test.py has all else.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/volume/number_volume.h"
#include "tests/io/codec/packers.h"
#include "tests/io/volume/volume_checks.h"
#include "tests/peak_growth.h"
#include "tests/sanitizers.h"

namespace mw::io {
namespace {

using Json = nlohmann::json;

/// Opens an array of version 3 whose metadata are a cube's of one chunk with these changes.
std::unique_ptr<LabelVolume> array_with(const TempDir& dir, const std::string& changes) {
  Json json = Json::parse(R"({"zarr_format": 3, "node_type": "array", "shape": [4, 4, 4],
    "data_type": "uint8", "fill_value": 0, "codecs": ["bytes"],
    "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": [4, 4, 4]}},
    "chunk_key_encoding": {"name": "v2"}})");
  json.merge_patch(Json::parse(changes));
  write_file(dir.path() / "zarr.json", json.dump());
  return open_volume(dir.path());
}

std::string chunks_of(const char* shape) {
  return text(R"("chunk_grid": {"configuration": {"chunk_shape": )", shape, "}}");
}

std::string shards_of(const char* chunk) {
  return text(R"("codecs": [{"name": "sharding_indexed", "configuration": {"chunk_shape": )", chunk,
              R"(, "codecs": ["bytes"], "index_codecs": [{"name": "bytes", "configuration": )",
              R"({"endian": "little"}}]}}])");
}

TEST(Zarr, ChunksOfTheVolumeAreWhatIsReadAtOnce) {
  const TempDir dir;
  const std::string chunks = "{" + chunks_of("[6, 4, 2]");
  EXPECT_EQ(array_with(dir, chunks + "}")->info().chunk, (Index3{2, 4, 6}));
  EXPECT_EQ(array_with(dir, chunks + "," + shards_of("[3, 2, 1]") + "}")->info().chunk,
            (Index3{1, 2, 3}));
}

/// The program refuses such a number itself.
TEST(Zarr, NoLevelHasANegativeNumber) {
  const TempDir dir;
  write_file(dir.path() / ".zattrs", R"({"multiscales": [{"version": "0.4", "datasets": [
    {"path": "0", "coordinateTransformations": [{"type": "scale", "scale": [1, 1, 1]}]}],
    "axes": ["z", "y", "x"]}]})");
  write_file(dir.path() / "0" / ".zarray", R"({"zarr_format": 2, "shape": [4, 4, 4],
    "chunks": [4, 4, 4], "dtype": "|u1", "fill_value": 0, "order": "C", "filters": null,
    "compressor": null})");
  EXPECT_EQ(open_volume(dir.path(), {.scale = 0})->info().shape, (Index3{4, 4, 4}));
  expect_misused(dir.path(), {.scale = -1}, {"--scale", "1 scales", "0 (the finest) to 0"});
}

TEST(Zarr, FillValuesAreNumbersWhereThoseAreRead) {
  const TempDir dir;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto read = [&](const char* type, const char* fill) {
    const auto volume = array_with(
        dir, text(R"({"data_type": ")", type, R"(", "fill_value": )", fill,
                  R"(, "codecs": [{"name": "bytes", "configuration": {"endian": "big"}}]})"));
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

// Chunks of several entries along an axis that has one.
TEST(Zarr, MemoryCountsWholeChunks) {
  const TempDir dir;
  const auto bytes_of = [&](const char* chunk) {
    return array_with(dir, R"({"shape": [1, 4, 4, 4], )" + chunks_of(chunk) + "}")->buffer_bytes(1);
  };
  EXPECT_GE(bytes_of("[5, 2, 2, 2]"), bytes_of("[1, 2, 2, 2]") + 4 * 8);
}

// 1 GiB of chunk, or an index of 32 MiB, that nothing is behind.
TEST(Zarr, ClaimsTakeNoMemory) {
  if (!test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  const TempDir dir;
  const auto refuse = [&](const std::filesystem::path& folder, const std::string& piece) {
    const long growth = test::growth_of([&] {
      const auto volume = open_volume(folder);
      std::vector<RawLabel> out(1);
      expect_error(ErrorKind::kInput, {piece}, [&] { volume->read({{0, 0, 0}, {1, 1, 1}}, out); });
    });
    EXPECT_GE(growth, 0) << folder;
    EXPECT_LE(growth, 24 * 1024) << folder;
  };
  const std::string few = "few voxels";
  const std::map<std::string, std::string> packed{{"", few},
                                                  {"zlib", zlib_packed(few)},
                                                  {"gzip", gzip(few)},
                                                  {"lz4", lz4_packed(few)},
                                                  {"bz2", bzip2_packed(few)},
                                                  {"lzma", xz_packed(few, 1)},
                                                  {"zstd", zstd_packed(few)}};
  for (const auto& [codec, bytes] : packed) {
    const auto folder = dir.path() / ("v2" + codec);
    const std::string compressor = codec.empty() ? "null" : R"({"id": ")" + codec + R"("})";
    write_file(folder / "0.0.0", bytes);
    write_file(folder / ".zarray", R"({"zarr_format": 2, "shape": [4, 4, 4], "dtype": "|u1",
      "chunks": [1024, 1024, 1024], "fill_value": 0, "order": "C", "filters": null,
      "compressor": )" + compressor + "}");
    refuse(folder, "0.0.0");
  }
  write_file(dir.path() / "0.0.0", few);
  static_cast<void>(
      array_with(dir, "{" + chunks_of("[128, 128, 128]") + "," + shards_of("[1, 1, 1]") + "}"));
  refuse(dir.path(), "shard index");
}

}  // namespace
}  // namespace mw::io
