// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Multiscale images of OME-NGFF: levels, places, units, labels, and what a store holds.
#include "tests/io/volume/zarr/zarr_sample.h"

namespace mw::io {
namespace {

/// A volume whose first label tells which array it is.
ZarrSample marked(Index3 shape, RawLabel mark) {
  ZarrSample sample{.shape = shape, .chunk = {shape.z, shape.y, shape.x}};
  sample.labels.assign(static_cast<std::size_t>(shape.product()), mark);
  return sample;
}

RawLabel mark_of(const std::filesystem::path& path, const OpenOptions& options = {}) {
  return read_all(*open_volume(path, options))[0];
}

Json axis(const std::string& name, const std::string& type, const std::string& unit) {
  Json out{{"name", name}, {"type", type}};
  if (!unit.empty()) out["unit"] = unit;
  return out;
}

Json scaled(const std::vector<double>& scale) {
  return {{"type", "scale"}, {"scale", scale}};
}
Json moved(const std::vector<double>& by) {
  return {{"type", "translation"}, {"translation", by}};
}

/// Braces alone would not make an array of one.
template <class... Values>
Json list(const Values&... values) {
  return Json::array({values...});
}

Json level(const std::string& path, const Json& transforms) {
  return {{"path", path}, {"coordinateTransformations", transforms}};
}

const Json kZyx{axis("z", "space", "nanometer"), axis("y", "space", "nanometer"),
                axis("x", "space", "nanometer")};

/// Writes the image's metadata, and an array a level whose label is 10 and its number.
void write_image(const std::filesystem::path& folder, const Json& multiscale, int version) {
  Json image = multiscale;
  if (version == 3) {
    const Json ome{{"version", "0.5"}, {"multiscales", list(image)}};
    write_file(
        folder / "zarr.json",
        Json{{"zarr_format", 3}, {"node_type", "group"}, {"attributes", {{"ome", ome}}}}.dump());
  } else {
    image["version"] = "0.4";
    write_file(folder / ".zgroup", R"({"zarr_format": 2})");
    write_file(folder / ".zattrs", Json{{"multiscales", list(image)}}.dump());
  }
  RawLabel mark = 10;
  for (const Json& one : multiscale["datasets"]) {
    const ZarrSample sample = marked({4, 3, 2}, mark++);
    const auto path = folder / one["path"].get<std::string>();
    version == 3 ? sample.write_v3(path) : sample.write_v2(path);
  }
}

TEST(OmeNgff, LevelsAndTheirScales) {
  const Json image{{"axes", kZyx},
                   {"datasets", list(level("s0", list(scaled({30, 4, 5}))),
                                     level("deep/s1", list(scaled({60, 8, 10}))))}};
  for (const int version : {2, 3}) {
    const TempDir dir;
    write_image(dir.path(), image, version);
    const auto fine = open_volume(dir.path());
    EXPECT_EQ(fine->info().space.spacing, (Vector3{5, 4, 30}));
    EXPECT_EQ(fine->info().space.origin, (Vector3{0, 0, 0}));  // nothing is placed
    EXPECT_EQ(fine->info().space.unit, "nm");
    EXPECT_EQ(read_all(*fine)[0], 10U);
    const auto coarse = open_volume(dir.path(), {.scale = 1});
    EXPECT_EQ(coarse->info().space.spacing, (Vector3{10, 8, 60}));
    EXPECT_EQ(read_all(*coarse)[0], 11U);
    for (const int wrong : {-1, 2}) {
      expect_misused(dir.path(), {.scale = wrong}, {"--scale", "2 scales", "0 (the finest) to 1"});
    }
  }
}

// A pyramid of means: the first voxel of level 1 is the mean of two, so its centre moves by half.
TEST(OmeNgff, TranslationsPlaceCentres) {
  const Json image{{"axes", kZyx},
                   {"datasets",
                    {level("0", list(scaled({2, 4, 6}))),
                     level("1", list(scaled({4, 8, 12}), moved({1, 2, 3})))}},
                   {"coordinateTransformations", list(scaled({1, 1, 10}), moved({100, 200, 300}))}};
  const TempDir dir;
  write_image(dir.path(), image, 2);
  const auto fine = open_volume(dir.path())->info().space;
  EXPECT_EQ(fine.spacing, (Vector3{60, 4, 2}));
  EXPECT_EQ(fine.origin, (Vector3{300 - 30, 200 - 2, 100 - 1}));
  EXPECT_EQ(open_volume(dir.path())->info().offset, (Index3{5, 50, 50}));
  const auto coarse = open_volume(dir.path(), {.scale = 1})->info().space;
  EXPECT_EQ(coarse.spacing, (Vector3{120, 8, 4}));
  EXPECT_EQ(coarse.origin, (Vector3{300 + 30 - 60, 200 + 2 - 4, 100 + 1 - 2}));
  EXPECT_EQ(coarse.origin, fine.origin);
  // This centre is 25.25 voxels from 0, which is no number of a voxel.
  EXPECT_EQ(open_volume(dir.path(), {.scale = 1})->info().offset, (Index3{0, 0, 0}));
  const OpenOptions options{.spacing = Vector3{1, 2, 3}, .origin = Vector3{7, 8, 9}};
  const auto given = open_volume(dir.path(), options)->info().space;
  EXPECT_EQ(given.spacing, (Vector3{1, 2, 3}));
  EXPECT_EQ(given.origin, (Vector3{7, 8, 9}));
  EXPECT_EQ(open_volume(dir.path(), options)->info().offset, (Index3{5, 50, 50}));
}

TEST(OmeNgff, AxesByNameAndByType) {
  const auto space_with = [](const Json& axes, const std::vector<double>& scale) {
    const TempDir dir;
    write_image(dir.path(), {{"axes", axes}, {"datasets", list(level("0", list(scaled(scale))))}},
                2);
    const auto volume = open_volume(dir.path());
    return std::pair(volume->info().space.spacing, volume->info().shape);
  };
  using Answer = std::pair<Vector3, Index3>;
  const Json xyz{axis("x", "space", ""), axis("y", "space", ""), axis("z", "space", "")};
  EXPECT_EQ(space_with(xyz, {1, 2, 3}), Answer({1, 2, 3}, {2, 3, 4}));
  EXPECT_EQ(space_with(kZyx, {1, 2, 3}), Answer({3, 2, 1}, {4, 3, 2}));
  const Json others{axis("depth", "space", ""), axis("h", "space", ""), axis("w", "space", "")};
  EXPECT_EQ(space_with(others, {1, 2, 3}), Answer({3, 2, 1}, {4, 3, 2}));
  EXPECT_EQ(space_with({"z", "y", "x"}, {1, 2, 3}), Answer({3, 2, 1}, {4, 3, 2}));
}

TEST(OmeNgff, FiveAxesTwoAxesAndNoTransformations) {
  const TempDir dir;
  ZarrSample sample = marked({4, 3, 2}, 5);
  sample.leading = 2;
  sample.chunk = {1, 1, 2, 3, 4};
  sample.write_v2(dir.path() / "0");
  write_file(dir.path() / ".zgroup", "{}");
  const Json axes{axis("t", "time", "second"), axis("c", "channel", ""),
                  axis("z", "space", "micrometer"), axis("y", "space", "micrometer"),
                  axis("x", "space", "micrometer")};
  const auto write = [&](const Json& image) {
    write_file(dir.path() / ".zattrs", Json{{"multiscales", list(image)}}.dump());
  };
  write({{"axes", axes}, {"datasets", list(level("0", list(scaled({1, 1, 3, 2, 0.5}))))}});
  const auto volume = open_volume(dir.path());
  EXPECT_EQ(volume->info().shape, (Index3{4, 3, 2}));
  EXPECT_EQ(volume->info().space.spacing, (Vector3{0.5, 2, 3}));
  EXPECT_EQ(volume->info().space.unit, "um");
  write({{"version", "0.2"}, {"datasets", list(Json{{"path", "0"}})}});
  EXPECT_EQ(open_volume(dir.path())->info().space.spacing, (Vector3{1, 1, 1}));

  Json slice = sample.v2_metadata();
  slice["shape"] = {3, 4};
  slice["chunks"] = {3, 4};
  write_file(dir.path() / "0" / ".zarray", slice.dump());
  write({{"axes", {axes[3], axes[4]}}, {"datasets", list(level("0", list(scaled({2, 0.5}))))}});
  EXPECT_EQ(open_volume(dir.path())->info().shape, (Index3{4, 3, 1}));
  EXPECT_EQ(open_volume(dir.path())->info().space.spacing, (Vector3{0.5, 2, 1}));
}

// A level that is opened as an array has its place, too.
TEST(OmeNgff, LevelsOpenedAsArraysKeepTheirPlace) {
  const TempDir dir;
  const Json image{{"axes", kZyx},
                   {"datasets", list(level("0", list(scaled({2, 4, 6}))),
                                     level("1", list(scaled({4, 8, 12}))))}};
  for (const int version : {2, 3}) {
    const auto folder = dir.path() / std::to_string(version);
    write_image(folder, image, version);
    for (const auto& volume : {open_volume(folder / "1"), open_volume(folder / "1" / ""),
                               open_volume(folder, {.dataset = "1"})}) {
      EXPECT_EQ(volume->info().space.spacing, (Vector3{12, 8, 4}));
      EXPECT_EQ(read_all(*volume)[0], 11U);
    }
    expect_misused(folder, {.dataset = "1", .scale = 1}, {"--scale 1", "without levels"});
  }
}

TEST(OmeNgff, LabelsOfAnImage) {
  const Json image{{"axes", kZyx}, {"datasets", list(level("0", list(scaled({1, 1, 1}))))}};
  for (const int version : {2, 3}) {
    const TempDir dir;
    write_image(dir.path(), image, version);
    const auto labels = dir.path() / "labels";
    write_image(labels / "cells", image, version);
    marked({4, 3, 2}, 99).write_v2(labels / "cells" / "0");
    std::filesystem::remove(labels / "cells" / "0" / "zarr.json");
    if (version == 2) {
      write_file(labels / ".zgroup", "{}");
      write_file(labels / ".zattrs", R"({"labels": ["cells"]})");
    } else {
      write_file(labels / "zarr.json", R"({"zarr_format": 3, "node_type": "group",
        "attributes": {"ome": {"version": "0.5", "labels": ["cells"]}}})");
    }
    EXPECT_EQ(mark_of(dir.path()), 10U);
    EXPECT_EQ(mark_of(dir.path(), {.dataset = "labels/cells"}), 99U);
    EXPECT_EQ(mark_of(dir.path(), {.dataset = "/labels//cells/"}), 99U);
    EXPECT_EQ(mark_of(dir.path(), {.dataset = "labels"}), 99U);  // the only one there
    EXPECT_EQ(mark_of(labels / "cells"), 99U);
    expect_misused(dir.path(), {.dataset = "labels/nuclei"},
                   {"--dataset labels/nuclei", "labels/cells"});

    // An image of floats is not what is meant, and its labels are named.
    const auto array = dir.path() / "0" / (version == 2 ? ".zarray" : "zarr.json");
    Json json = Json::parse(content_of(array));
    const std::string whole = json.dump();
    json[version == 2 ? "dtype" : "data_type"] = version == 2 ? "<f4" : "float32";
    write_file(array, json.dump());
    expect_not_opened(dir.path(), {"f32", "--dataset labels/cells"});
    EXPECT_NO_THROW(static_cast<void>(open_volume(dir.path(), {.dataset = "."})));
    // Nor one of several channels.
    json = Json::parse(whole);
    json["shape"] = {2, 2, 3, 4};
    if (version == 2) json["chunks"] = json["shape"];
    if (version == 3) json["chunk_grid"]["configuration"]["chunk_shape"] = json["shape"];
    write_file(array, json.dump());
    Json channels = image;
    channels["axes"].insert(channels["axes"].begin(), axis("c", "channel", ""));
    const auto attributes = dir.path() / (version == 2 ? ".zattrs" : "zarr.json");
    Json group = Json::parse(content_of(attributes));
    (version == 2 ? group : group["attributes"]["ome"])["multiscales"] = list(channels);
    write_file(attributes, group.dump());
    expect_not_opened(dir.path(), {"'c'", "2 entries", "--dataset labels/cells"});
  }
}

TEST(OmeNgff, WrongMetadataAreNamed) {
  const TempDir dir;
  write_image(dir.path(), {{"axes", kZyx}, {"datasets", list(level("0", list(scaled({1, 1, 1}))))}},
              2);
  const auto refuse = [&](const Json& image, std::vector<std::string> pieces) {
    write_file(dir.path() / ".zattrs", Json{{"multiscales", list(image)}}.dump());
    pieces.emplace_back(".zattrs");
    expect_not_opened(dir.path(), pieces);
  };
  const auto with = [](const Json& transforms) {
    return Json{{"axes", kZyx}, {"datasets", list(level("0", transforms))}};
  };
  refuse(with(list(scaled({1, 0, 1}))), {"scale (y)", "spacing 0"});
  refuse(with(list(scaled({1, 1}))), {"coordinateTransformations", "2 numbers"});
  refuse(with(list(scaled({1, 1, 1}), moved({1, 1}))), {"translation", "2 numbers"});
  refuse(with(list(Json{{"type", "affine"}})), {"coordinateTransformations[0].type", "affine"});
  refuse(with(list(Json{{"type", "scale"}, {"path", "s"}})), {"path"});
  refuse(with(list(Json{{"type", "scale"}, {"scale", {1, "a", 1}}})), {"scale", "\"a\""});
  refuse({{"axes", kZyx}, {"datasets", Json::array()}}, {"datasets"});
  refuse({{"axes", kZyx}}, {"datasets", "missing"});
  refuse({{"axes", kZyx}, {"version", "0.6"}, {"datasets", list(level("0", Json::array()))}},
         {"version", "0.6"});
  refuse({{"axes", {kZyx[0], kZyx[1]}}, {"datasets", list(level("0", Json::array()))}},
         {"axes", "2 axes", "3"});
  refuse({{"axes", kZyx}, {"datasets", list(level("1", Json::array()))}},
         {"datasets[0].path", "'1'"});
  refuse({{"axes", kZyx}, {"datasets", list(level("../0", Json::array()))}}, {"datasets[0].path"});
  refuse({{"axes", kZyx}, {"datasets", list(level(".", Json::array()))}}, {"datasets[0].path"});
  Json mixed = kZyx;
  mixed[0]["unit"] = "micrometer";
  refuse({{"axes", mixed}, {"datasets", list(level("0", list(scaled({1, 1, 1}))))}},
         {"units", "'nm'", "'um'", "--spacing"});
  EXPECT_EQ(open_volume(dir.path(), {.spacing = Vector3{1, 2, 3}})->info().space.unit, "");
}

TEST(Zarr, StoresOfSeveralArrays) {
  const TempDir dir;
  write_file(dir.path() / ".zgroup", "{}");
  expect_not_opened(dir.path(), {"no array"});
  write_file(dir.path() / "volumes" / ".zgroup", "{}");
  marked({1, 1, 1}, 1).write_v2(dir.path() / "volumes" / "ids");
  write_file(dir.path() / "chunks" / "0" / "0", "no group");
  EXPECT_EQ(mark_of(dir.path()), 1U);
  marked({1, 1, 1}, 2).write_v3(dir.path() / "more");
  expect_not_opened(dir.path(), {"more, volumes/ids", "--dataset"});
  EXPECT_EQ(mark_of(dir.path(), {.dataset = "volumes/ids"}), 1U);
  EXPECT_EQ(mark_of(dir.path(), {.dataset = "more"}), 2U);
  EXPECT_EQ(mark_of(dir.path(), {.dataset = "volumes"}), 1U);
  const std::string outside = "../" + dir.path().filename().string() + "/more";
  for (const std::string& wrong : {std::string("less"), outside, std::string("more/..")}) {
    expect_misused(dir.path(), {.dataset = wrong}, {"--dataset " + wrong, "more, volumes/ids"});
  }
}

TEST(Zarr, FolderOfThatNameWithoutMetadata) {
  const TempDir dir;
  std::filesystem::create_directories(dir.path() / "a.zarr");
  expect_not_opened(dir.path() / "a.zarr", {"a.zarr", ".zarray"});
}

}  // namespace
}  // namespace mw::io
