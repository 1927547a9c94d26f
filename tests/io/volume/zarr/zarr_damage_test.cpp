// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Damaged and unsupported Zarr stores are refused by name, in bounded memory.
#include "tests/io/volume/zarr/zarr_sample.h"
#include "tests/peak_growth.h"
#include "tests/sanitizers.h"

namespace mw::io {
namespace {

ZarrSample small_sample(std::uint32_t seed) {
  Random random(seed);
  ZarrSample sample{.shape = {6, 5, 4}, .type = VoxelType::kU16, .chunk = {2, 3, 4}};
  sample.labels = random_labels(random, sample.shape, sample.type);
  return sample;
}

using Change = std::function<void(Json&)>;

/// Writes a good array, its metadata changed, and expects an error that names them.
void refuse(const ZarrSample& sample, int version, const Change& change,
            std::vector<std::string> pieces) {
  const TempDir dir;
  version == 2 ? sample.write_v2(dir.path()) : sample.write_v3(dir.path());
  Json json = version == 2 ? sample.v2_metadata() : sample.v3_metadata();
  change(json);
  const auto file = dir.path() / (version == 2 ? ".zarray" : "zarr.json");
  write_file(file, json.dump());
  pieces.push_back(file.string());
  expect_not_opened(dir.path(), pieces);
}

void refuse_v2(const Change& change, const std::vector<std::string>& pieces) {
  refuse(small_sample(1), 2, change, pieces);
}

void refuse_v3(const Change& change, const std::vector<std::string>& pieces) {
  ZarrSample sample = small_sample(1);
  sample.inner = {1, 3, 2};
  refuse(sample, 3, change, pieces);
}

/// The key of the place is given another value, both as JSON.
Change set(const char* place, const char* value) {
  return [place, value](Json& json) { json[Json::json_pointer(place)] = Json::parse(value); };
}

TEST(ZarrErrors, MetadataOfVersion2) {
  refuse_v2([](Json& j) { j["zarr_format"] = 1; }, {"zarr_format"});
  refuse_v2([](Json& j) { j.erase("shape"); }, {"shape", "missing"});
  refuse_v2([](Json& j) { j["shape"] = {4, 5, 0}; }, {"shape (x)", "not positive"});
  refuse_v2([](Json& j) { j["shape"] = {-4, 5, 6}; }, {"shape (z)", "not positive"});
  refuse_v2([](Json& j) { j["shape"] = {4, 5, 1 << 21}; }, {"shape (x)", "1048576"});
  refuse_v2([](Json& j) { j["shape"] = {4, 5}; }, {"chunks", "3 extents", "2 axes"});
  refuse_v2([](Json& j) { j["shape"] = j["chunks"] = {4}; }, {"shape", "1 axes"});
  refuse_v2([](Json& j) { j["shape"] = j["chunks"] = {2, 3, 4, 5}; }, {"2 x 3 x 4 x 5", "4 axes"});
  refuse_v2([](Json& j) { j["shape"] = std::vector<int>(40, 1); }, {"shape", "40 axes"});
  refuse_v2([](Json& j) { j["chunks"] = {2, 0, 4}; }, {"chunks", "not positive"});
  refuse_v2([](Json& j) { j["chunks"] = {2048, 1024, 1024}; }, {"chunks", "2 GiB"});
  refuse_v2([](Json& j) { j["chunks"] = {INT64_MAX, INT64_MAX, INT64_MAX}; }, {"chunks", "2 GiB"});
  refuse_v2([](Json& j) { j["chunks"] = "4"; }, {"chunks", "array"});
  for (const char* type : {"<f2", "<c8", "|V4", "<U2", "|O", "<u3", "|u2", "u2", "", "<M8[ns]"}) {
    refuse_v2([&](Json& j) { j["dtype"] = type; }, {"dtype", type});
  }
  refuse_v2([](Json& j) { j["dtype"] = Json::array({Json::array({"a", "<u2"})}); }, {"dtype"});
  refuse_v2([](Json& j) { j["order"] = "A"; }, {"order", "'A'"});
  refuse_v2([](Json& j) { j["dimension_separator"] = "-"; }, {"dimension_separator"});
  refuse_v2([](Json& j) { j["filters"] = {{{"id", "delta"}}}; }, {"filters[0].id", "delta"});
  refuse_v2([](Json& j) { j["compressor"] = {{"id", "zfpy"}}; }, {"compressor.id", "zfpy"});
  refuse_v2(set("/compressor", R"({"id": "lzma", "format": 3})"), {"compressor.format", "lzma"});
  refuse_v2([](Json& j) { j["compressor"] = "zlib"; }, {"compressor"});
  for (const char* fill : {"-1", "65536", "0.5", "\"x\"", "1e300", "[]", "-9223372036854775808"}) {
    refuse_v2([&](Json& j) { j["fill_value"] = Json::parse(fill); }, {"fill_value", "u16"});
  }
}

Json& sharding_of(Json& json) {
  return json["codecs"][0]["configuration"];
}

TEST(ZarrErrors, MetadataOfVersion3) {
  for (const char* key : {"data_type", "chunk_grid", "chunk_key_encoding", "codecs", "fill_value",
                          "shape", "node_type", "zarr_format"}) {
    refuse_v3([&](Json& j) { j.erase(key); }, {key, "missing"});
  }
  refuse_v3([](Json& j) { j["node_type"] = "heap"; }, {"node_type", "heap"});
  refuse_v3([](Json& j) { j["zarr_format"] = 4; }, {"zarr_format"});
  for (const char* type : {"float16", "complex64", "string", "r16"}) {
    refuse_v3([&](Json& j) { j["data_type"] = type; }, {"data_type", type});
  }
  refuse_v3([](Json& j) { j["data_type"] = {{"name", "numpy.datetime64"}}; }, {"numpy.datetime64"});
  refuse_v3([](Json& j) { j["chunk_grid"]["name"] = "rectilinear"; }, {"rectilinear"});
  const char* const grid = "/chunk_grid/configuration/chunk_shape";
  refuse_v3(set(grid, "[2, 3]"), {"chunk_shape", "2 extents", "3 axes"});
  refuse_v3(set(grid, "[2, 3, -4]"), {"chunk_shape", "not positive"});
  refuse_v3([](Json& j) { j["chunk_key_encoding"]["name"] = "x"; }, {"chunk_key_encoding", "'x'"});
  refuse_v3(set("/chunk_key_encoding/configuration/separator", R"("..")"), {"separator", "'..'"});
  refuse_v3(set("/storage_transformers", R"([{"name": "x"}])"), {"storage_transformers"});
  refuse_v3([](Json& j) { j["crystal"] = {{"name", "x"}}; }, {"crystal", "extension"});
  refuse_v3([](Json& j) { j["dimension_names"] = {"x"}; }, {"dimension_names"});
  refuse_v3([](Json& j) { j["fill_value"] = 70000; }, {"fill_value", "u16"});
}

TEST(ZarrErrors, Codecs) {
  const auto codecs = [](const std::string& list, std::vector<std::string> pieces) {
    refuse_v3([&](Json& j) { j["codecs"] = Json::parse(list); }, std::move(pieces));
  };
  codecs(R"([])", {"codecs", "no codec makes bytes"});
  codecs(R"({})", {"codecs", "array"});
  codecs(R"([7])", {"codecs[0]"});
  codecs(R"(["bytes"])", {"codecs[0].configuration.endian", "missing"});
  codecs(R"([{"name": "bytes", "configuration": {"endian": "middle"}}])", {"endian", "middle"});
  codecs(R"([{"name": "packbits"}])", {"codec packbits", "not known"});
  const std::string bytes = R"({"name": "bytes", "configuration": {"endian": "big"}})";
  codecs("[" + bytes + ", {\"name\": \"numcodecs.zlib\"}]", {"codec numcodecs.zlib"});
  codecs("[" + bytes + "," + bytes + "]", {"codec bytes", "behind"});
  codecs("[\"gzip\"," + bytes + "]", {"codec gzip", "before"});
  for (const char* order : {"[0, 1]", "[0, 1, 1]", "[0, 1, 3]", "[0, 1, -1]", "[0, 1, 2, 2]"}) {
    codecs(std::string(R"([{"name": "transpose", "configuration": {"order": )") + order + "}}," +
               bytes + "]",
           {"codec transpose", "permutation"});
  }
  refuse_v3([](Json& j) { j["codecs"].push_back("gzip"); }, {"codec gzip", "whole shards"});
  refuse_v3([](Json& j) { sharding_of(j)["chunk_shape"] = {1, 2, 2}; }, {"chunk_shape", "divide"});
  refuse_v3([](Json& j) { sharding_of(j)["chunk_shape"] = {1, 3}; }, {"chunk_shape"});
  refuse_v3([](Json& j) { sharding_of(j)["index_location"] = "middle"; }, {"index_location"});
  refuse_v3([](Json& j) { sharding_of(j)["index_codecs"].push_back("gzip"); }, {"index_codecs"});
  refuse_v3(
      [](Json& j) {
        Json& index = sharding_of(j)["index_codecs"];
        index = Json::array(
            {{{"name", "transpose"}, {"configuration", {{"order", {3, 2, 1, 0}}}}}, index[0]});
      },
      {"index_codecs", "other codecs than bytes and crc32c"});
  refuse_v3([](Json& j) { sharding_of(j).erase("index_codecs"); }, {"index_codecs", "missing"});
  refuse_v3([](Json& j) { sharding_of(j).erase("codecs"); }, {"codecs", "missing"});
  refuse_v3([](Json& j) { sharding_of(j)["codecs"] = Json::array({j["codecs"][0]}); },
            {"codec sharding_indexed", "within shards"});
  refuse_v3(
      [](Json& j) {
        j["chunk_grid"]["configuration"]["chunk_shape"] = {1 << 20, 1 << 20, 1 << 20};
        sharding_of(j)["chunk_shape"] = {1, 1, 1};
      },
      {"chunk_shape", "4194304"});
  refuse_v3(
      [](Json& j) {  // without shards, chunks must fit into memory
        j["chunk_grid"]["configuration"]["chunk_shape"] = {1 << 20, 1 << 20, 1 << 20};
        j["codecs"] = sharding_of(j)["codecs"];
      },
      {"chunk_shape", "2 GiB"});
}

// An extension that need not be understood is passed over.
TEST(ZarrV3, ExtensionsThatMayBePassedOver) {
  const TempDir dir;
  const ZarrSample sample = small_sample(2);
  sample.write_v3(dir.path());
  Json json = sample.v3_metadata();
  json["consolidated_metadata"] = {{"must_understand", false}, {"kind", "inline"}};
  json["storage_transformers"] = Json::array();
  json["dimension_names"] = {nullptr, nullptr, nullptr};
  write_file(dir.path() / "zarr.json", json.dump());
  EXPECT_EQ(read_all(*open_volume(dir.path())), sample.labels);
}

TEST(ZarrErrors, DamagedChunksAreNamed) {
  const TempDir dir;
  ZarrSample sample = small_sample(3);
  for (const char* codec : {"", "zlib", "blosc"}) {
    sample.packing =
        codec[0] == '\0' ? std::vector<std::string>{} : std::vector<std::string>{codec};
    sample.write_v2(dir.path());
    const auto file = dir.path() / "1.0.1";
    const std::string whole = content_of(file);
    for (const std::string& bytes : {std::string(), whole.substr(1), whole.substr(0, 10)}) {
      write_file(file, bytes);
      const auto volume = open_volume(dir.path());
      std::vector<RawLabel> out(1);
      volume->read({{0, 0, 0}, {1, 1, 1}}, out);  // the others are sound
      expect_error(ErrorKind::kInput, {file.string(), "whole copy"},
                   [&] { static_cast<void>(read_all(*volume)); });
    }
    write_file(file, std::string(1 << 20, '\0'));
    expect_not_read(dir.path(), {file.string(), "1048576 bytes"});
    std::filesystem::remove(file);
    std::filesystem::create_directory(file);
    expect_not_read(dir.path(), {file.string()});
    std::filesystem::remove(file);
  }
}

TEST(ZarrErrors, ShardIndicesAreChecked) {
  const TempDir dir;
  ZarrSample sample = small_sample(4);
  sample.inner = {1, 3, 2};
  sample.separator = '/';
  sample.index_checksum = false;
  sample.leave_out_fill = false;
  for (const bool at_end : {true, false}) {
    sample.index_at_end = at_end;
    sample.write_v3(dir.path());
    const auto file = dir.path() / "c/1/0/0";
    const std::string whole = content_of(file);
    const std::size_t index = at_end ? whole.size() - 4 * 16 : 0;
    const auto refuse = [&](std::uint64_t offset, std::uint64_t bytes, const std::string& piece) {
      std::string bent = whole;
      bent.replace(index + 16, 16, number_bytes(offset, 8, false) + number_bytes(bytes, 8, false));
      write_file(file, bent);
      expect_not_read(dir.path(), {file.string(), "chunk (1, 0, 0) of the shard", piece});
    };
    refuse(whole.size(), 12, "places it at");
    refuse(0, whole.size() + 1, "places it at");
    refuse(~0ULL, 12, "places it at");
    refuse(~0ULL - 3, 12, "places it at");
    refuse(12, ~0ULL, "places it at");
    refuse(0, 11, "needs 12");
    write_file(file, whole.substr(0, 63));
    expect_not_read(dir.path(), {file.string(), "shard index", "truncated"});
    write_file(file, whole);
  }
}

TEST(ZarrErrors, EveryDamageIsReadOrRefused) {
  ZarrSample sample = small_sample(5);
  {
    const TempDir dir;
    sample.packing = {"blosc"};
    sample.write_v2(dir.path());
    EXPECT_GT(refused_when_damaged(dir.path(), dir.path() / ".zarray", 2), 250);
    EXPECT_GT(refused_when_damaged(dir.path(), dir.path() / "0.0.0", 1), 50);
  }
  {
    const TempDir dir;
    sample.inner = {1, 3, 2};
    sample.packing = {"zstd", "crc32c"};
    sample.write_v3(dir.path());
    EXPECT_GT(refused_when_damaged(dir.path(), dir.path() / "zarr.json", 3), 400);
    const auto shard = dir.path() / "c.0.0.0";
    const auto bytes = static_cast<int>(content_of(shard).size());
    // All is under a checksum: of the index, or of a chunk.
    EXPECT_EQ(refused_when_damaged(dir.path(), shard, 1), 9 * bytes);
  }
}

TEST(ZarrErrors, DamagedAttributesAreReadOrRefused) {
  const TempDir dir;
  small_sample(6).write_v2(dir.path() / "0");
  write_file(dir.path() / ".zattrs", R"({"multiscales": [{"version": "0.4", "axes": [
    {"name": "z", "type": "space", "unit": "meter"}, {"name": "y", "type": "space"},
    {"name": "x", "type": "space"}], "datasets": [{"path": "0", "coordinateTransformations": [
    {"type": "scale", "scale": [1, 2, 3]}, {"type": "translation", "translation": [4, 5, 6]}]}]}]})");
  EXPECT_TRUE(is_refused(dir.path()));  // units differ
  write_file(dir.path() / ".zattrs", R"({"multiscales": [{"version": "0.4", "axes": [
    {"name": "z", "type": "space"}, {"name": "y", "type": "space"},
    {"name": "x", "type": "space"}], "datasets": [{"path": "0", "coordinateTransformations": [
    {"type": "scale", "scale": [1, 2, 3]}, {"type": "translation", "translation": [4, 5, 6]}]}]}]})");
  EXPECT_GT(refused_when_damaged(dir.path(), dir.path() / ".zattrs", 3), 130);
}

// 2 GiB of chunk, index and shape that nothing is behind.
TEST(ZarrErrors, ClaimsTakeNoMemory) {
  if (!test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  const TempDir dir;
  ZarrSample sample = small_sample(7);
  const auto refuse = [&](const std::filesystem::path& folder, const std::string& piece) {
    const long growth = test::growth_of([&] {
      const auto volume = open_volume(folder);
      std::vector<RawLabel> out(1);
      expect_error(ErrorKind::kInput, {piece}, [&] { volume->read({{0, 0, 0}, {1, 1, 1}}, out); });
    });
    EXPECT_GE(growth, 0) << folder;
    EXPECT_LE(growth, 24 * 1024) << folder;
  };
  for (const char* codec : {"", "zlib", "gzip", "zstd", "lz4", "bz2", "lzma"}) {
    sample.packing =
        codec[0] == '\0' ? std::vector<std::string>{} : std::vector<std::string>{codec};
    const auto folder = dir.path() / (std::string("v2") + codec);
    sample.write_v2(folder);
    Json json = sample.v2_metadata();
    json["chunks"] = {1024, 1024, 1024};
    write_file(folder / ".zarray", json.dump());
    refuse(folder, "0.0.0");
  }
  sample.inner = {1, 1, 1};
  sample.packing.clear();
  sample.write_v3(dir.path() / "v3");
  Json json = sample.v3_metadata();
  json["chunk_grid"]["configuration"]["chunk_shape"] = {128, 128, 128};
  write_file(dir.path() / "v3" / "zarr.json", json.dump());
  refuse(dir.path() / "v3", "shard index");
}

}  // namespace
}  // namespace mw::io
