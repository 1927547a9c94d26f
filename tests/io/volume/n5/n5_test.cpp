// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// N5 arrays give back every region and lie where their attributes say; broken ones are refused.
#include "tests/io/volume/n5/n5_sample.h"

namespace mw::io {
namespace {

std::string from_hex(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

N5Sample random_sample(Random& random) {
  N5Sample out;
  out.shape = pick_shape(random, 25);
  out.block = pick_shape(random, 10) + Index3{2, 2, 2};
  out.type = kAllTypes[random() % 8];
  out.packing = kN5Packings[random() % kN5Packings.size()];
  out.whole_blocks = random() % 2 == 0;
  out.counted = random() % 4 == 0;
  if (out.shape.x > 1 && out.shape.y > 1 && out.shape.z > 1 && random() % 3 == 0) {
    out.others.assign(static_cast<std::size_t>(pick(random, 1, 2)), pick(random, 1, 3));
    out.before = random() % 4;
  }
  return out;
}

TEST(N5, RandomStoresGiveBackEveryRegion) {
  Random random(31);
  for (int round = 0; round < 120; ++round) {
    SCOPED_TRACE(round);
    const TempDir dir;
    const N5Sample sample = random_sample(random);
    auto labels = random_labels(random, sample.shape, sample.type);
    const std::int64_t empty = pick(random, 0, sample.shape.z);
    std::fill_n(labels.begin(), empty * sample.shape.x * sample.shape.y, 0U);
    sample.write(random, dir.path(), labels);
    OpenOptions options;
    options.cache_bytes = round % 3 == 0 ? 0 : 1 << 14;
    const auto volume = open_volume(dir.path(), options);
    EXPECT_EQ(volume->info().type, sample.type);
    EXPECT_EQ(volume->info().format, "n5");
    expect_regions(random, *volume, sample.shape, labels);
    if (HasFatalFailure()) return;
  }
}

/// The block of 1 x 2 x 3 values 1 to 6 in the description of N5, in four packings.
TEST(N5, BlocksOfTheDescription) {
  const std::string head = "00000003000000010000000200000003";
  const std::vector<std::pair<std::string, std::string>> blocks{
      {"raw", "000100020003000400050006"},
      {"bzip2",
       "425a683931415926535"
       "9023e0dd200000040007f00200031"
       "0c010d31a87394337c5dc914e1424008f83748"},
      {"gzip", "1f8b08000000000000006360646062606660616065600300aaea6dbf0c000000"},
      {"xz",
       "fd377a585a000004e6d6b4460200210116000000742fe5a301000b000100020003000400050006000d0309ca"
       "34ec15a70001240ca618d8d81fb6f37d010000000004595a"}};
  for (const auto& [type, hex] : blocks) {
    const TempDir dir;
    write_file(dir.path() / "attributes.json",
               R"({"dimensions": [1, 2, 3], "blockSize": [1, 2, 3], "dataType": "uint16",)"
               R"("compression": {"type": ")" +
                   type + R"("}})");
    write_file(dir.path() / "0" / "0" / "0", from_hex(head + hex));
    EXPECT_EQ(read_all(*open_volume(dir.path())), (std::vector<RawLabel>{1, 2, 3, 4, 5, 6}))
        << type;
  }
}

TEST(N5, SlicesAndOldAttributes) {
  const TempDir dir;
  write_file(dir.path() / "attributes.json",
             R"({"dimensions": [3, 2], "blockSize": [2, 2], "dataType": "uint8",)"
             R"("compressionType": "raw"})");
  write_file(dir.path() / "0" / "0", from_hex("000000020000000200000002") + "abde");
  write_file(dir.path() / "1" / "0", from_hex("000000020000000100000002") + "cf");
  const auto volume = open_volume(dir.path());
  EXPECT_EQ(volume->info().shape, (Index3{3, 2, 1}));
  EXPECT_EQ(read_all(*volume), (std::vector<RawLabel>{'a', 'b', 'c', 'd', 'e', 'f'}));
}

VolumeInfo info_with(const std::string& extra, const OpenOptions& options = {}) {
  const TempDir dir;
  const N5Sample sample{.extra = extra};
  write_file(dir.path() / "attributes.json", sample.attributes());
  return open_volume(dir.path(), options)->info();
}

VolumeSpace space_with(const std::string& extra, const OpenOptions& options = {}) {
  return info_with(extra, options).space;
}

TEST(N5Space, ByAttributes) {
  const VolumeSpace none = space_with("");
  EXPECT_EQ(none.spacing, (Vector3{1, 1, 1}));
  EXPECT_EQ(none.origin, (Vector3{0, 0, 0}));
  EXPECT_EQ(none.unit, "");
  const VolumeSpace viewer =
      space_with(R"(, "pixelResolution": {"dimensions": [0.5, 0.25, 2], "unit": "micron"})");
  EXPECT_EQ(viewer.spacing, (Vector3{0.5, 0.25, 2}));
  EXPECT_EQ(viewer.unit, "um");
  const VolumeSpace list = space_with(
      R"(, "resolution": [4, 5, 40], "units": ["nm", "nm", "nm"], "offset": [8, 0, -3])");
  EXPECT_EQ(list.spacing, (Vector3{4, 5, 40}));
  EXPECT_EQ(list.origin, (Vector3{8, 0, -3}));
  EXPECT_EQ(list.unit, "nm");
  EXPECT_EQ(space_with(R"(, "resolution": [4, 5, 40], "unit": "pixel")").unit, "");
}

TEST(N5Space, CosemPutsTheCentreOfTheFirstVoxel) {
  const VolumeSpace space =
      space_with(R"(, "transform": {"axes": ["z", "y", "x"], "units": ["nm", "nm", "nm"],)"
                 R"("scale": [40, 5, 4], "translate": [20, 102.5, 2]})");
  EXPECT_EQ(space.spacing, (Vector3{4, 5, 40}));
  EXPECT_EQ(space.origin, (Vector3{0, 100, 0}));
  EXPECT_EQ(space.unit, "nm");
}

TEST(N5Space, OptionsReplaceWhatIsNotLookedAt) {
  OpenOptions options;
  options.spacing = Vector3{1, 2, 3};
  options.origin = Vector3{7, 8, 9};
  for (const char* broken : {R"(, "resolution": "?", "offset": [])",
                             R"(, "transform": {"axes": [], "scale": 3, "translate": {}})"}) {
    const VolumeSpace space = space_with(broken, options);
    EXPECT_EQ(space.spacing, *options.spacing);
    EXPECT_EQ(space.origin, *options.origin);
  }
}

/// An offset of whole voxels is a number of the first voxel, whatever the options replace.
TEST(N5Space, OffsetsOfWholeVoxelsCount) {
  const OpenOptions given{.spacing = Vector3{1, 2, 3}, .origin = Vector3{7, 8, 9}};
  const auto offset_with = [&](const std::string& extra) { return info_with(extra, given).offset; };
  EXPECT_EQ(offset_with(""), (Index3{0, 0, 0}));
  EXPECT_EQ(offset_with(R"(, "resolution": [4, 5, 40], "offset": [8, 0, -120])"),
            (Index3{2, 0, -3}));
  EXPECT_EQ(offset_with(R"(, "resolution": [4, 5, 40], "offset": [8, 0, -100])"),
            (Index3{0, 0, 0}));
  const std::string cosem = R"(, "transform": {"axes": ["z", "y", "x"], "scale": [40, 5, 4], )";
  EXPECT_EQ(offset_with(cosem + R"("translate": [80, 100, -4]})"), (Index3{-1, 20, 2}));
  EXPECT_EQ(offset_with(cosem + R"("translate": [80, 102.5, -4]})"), (Index3{0, 0, 0}));
  EXPECT_EQ(offset_with(R"(, "resolution": "?", "offset": [])"), (Index3{0, 0, 0}));
  EXPECT_EQ(info_with(R"(, "offset": [8, 0, -3])").offset, (Index3{8, 0, -3}));
}

TEST(N5Space, DamageIsNamed) {
  const auto expect = [](const std::string& extra, std::vector<std::string> pieces) {
    pieces.push_back("attributes.json");
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(space_with(extra)); });
  };
  expect(R"(, "resolution": [4, 5])", {"resolution", "2 numbers"});
  expect(R"(, "resolution": [4, 0, 5])", {"resolution", "spacing 0"});
  expect(R"(, "resolution": [4, -1, 5])", {"resolution", "spacing -1"});
  expect(R"(, "resolution": [4, 1e999, 5])", {"JSON"});
  expect(R"(, "resolution": [4, NaN, 5])", {"JSON"});
  expect(R"(, "resolution": [4, 4, 5], "units": ["nm", "um", "nm"])", {"units", "different"});
  expect(R"(, "offset": [1, 2, "3"])", {"offset", "\"3\""});
  expect(R"(, "pixelResolution": {"unit": "nm"})", {"pixelResolution.dimensions", "missing"});
  expect(R"(, "transform": {"axes": ["a", "b", "c"], "scale": [1, 1, 1]})", {"transform.axes"});
  expect(R"(, "transform": {"axes": ["z", "y", "x"], "scale": [1, 1]})", {"transform.scale"});
  expect(R"(, "transform": {"axes": ["z", "y", "x"]})", {"transform.scale", "missing"});
}

/// A group with two levels; `group`, `fine` and `coarse` are attributes with a comma in front.
struct Pyramid {
  TempDir dir;
  N5Sample sample{.shape = {4, 4, 4}};

  Pyramid(const std::string& group, const std::string& fine, const std::string& coarse) {
    write_file(dir.path() / "attributes.json", R"({"n5": "2.0.0")" + group + "}");
    sample.extra = fine;
    write_file(dir.path() / "s0" / "attributes.json", sample.attributes());
    sample.extra = coarse;
    write_file(dir.path() / "s1" / "attributes.json", sample.attributes());
  }
  [[nodiscard]] Vector3 spacing(int level) const {
    OpenOptions options;
    options.scale = level;
    const auto by_number = open_volume(dir.path(), options)->info().space;
    const auto by_folder =
        open_volume(dir.path() / ("s" + std::to_string(level)) / "")->info().space;
    EXPECT_EQ(by_number.spacing, by_folder.spacing);
    EXPECT_EQ(by_number.origin, by_folder.origin);
    return by_number.spacing;
  }
};

TEST(N5Space, LevelsOfPyramids) {
  const Vector3 fine{4, 4, 40}, coarse{8, 8, 40};
  const std::string resolution = R"(, "resolution": [4, 4, 40])";
  const std::string own = R"(, "resolution": [8, 8, 40])";
  const std::string factors = R"(, "downsamplingFactors": [2, 2, 1])";
  const std::string table = R"(, "downsamplingFactors": [[1, 1, 1], [2, 2, 1]])";
  const std::string viewer = R"(, "scales": [[1, 1, 1], [2, 2, 1]])";
  const std::vector<std::array<std::string, 3>> ways{
      {resolution, "", factors},               // BigDataViewer
      {resolution + table, "", ""},            // Neuroglancer
      {resolution + viewer, "", ""},           // n5-viewer
      {"", resolution, factors},               // of the finest level
      {"", resolution, resolution + factors},  // the same for all: that of the finest
      {resolution, "", own + factors},         // of its own
      {"", resolution, own},
  };
  for (const auto& [group, first, second] : ways) {
    const Pyramid pyramid(group, first, second);
    EXPECT_EQ(pyramid.spacing(0), fine) << group << first << second;
    EXPECT_EQ(pyramid.spacing(1), coarse) << group << first << second;
  }
  EXPECT_EQ(Pyramid(table, "", "").spacing(1), (Vector3{2, 2, 1}));
  const Pyramid corner(resolution + R"(, "offset": [1, 2, 3])", "", factors);
  EXPECT_EQ(open_volume(corner.dir.path() / "s1")->info().space.origin, (Vector3{1, 2, 3}));
  const Pyramid silent(resolution, "", "");
  expect_error(ErrorKind::kInput, {"s1/attributes.json", "downsamplingFactors", "--spacing"},
               [&] { static_cast<void>(silent.spacing(1)); });
}

TEST(N5Space, CosemPutsTransformsIntoTheGroup) {
  const std::string group =
      R"(, "axes": ["z", "y", "x"], "multiscales": [{"name": "a", "datasets": [)"
      R"({"path": "s0", "transform": {"axes": ["z", "y", "x"], "units": ["nm", "nm", "nm"],)"
      R"("scale": [40, 5, 4], "translate": [20, 102.5, 2]}},)"
      R"({"path": "s1", "transform": {"axes": ["z", "y", "x"], "units": ["nm", "nm", "nm"],)"
      R"("scale": [80, 10, 8], "translate": [40, 105, 4]}}]}])";
  const Pyramid pyramid(group, "", R"(, "resolution": [1, 1, 1])");
  EXPECT_EQ(pyramid.spacing(0), (Vector3{4, 5, 40}));
  EXPECT_EQ(pyramid.spacing(1), (Vector3{8, 10, 80}));
  for (const char* level : {"s0", "s1"}) {
    const auto volume = open_volume(pyramid.dir.path() / level);
    EXPECT_EQ(volume->info().space.origin, (Vector3{0, 100, 0}));
    EXPECT_EQ(volume->info().space.unit, "nm");
  }
  const std::string own = R"(, "transform": {"axes": ["x", "y", "z"], "scale": [1, 2, 3]})";
  EXPECT_EQ(Pyramid(group, own, "").spacing(0), (Vector3{1, 2, 3}));
  const std::string broken = R"(, "multiscales": [{"datasets": [{"path": "s0", "transform": 3}]}])";
  expect_error(ErrorKind::kInput, {"multiscales[0].datasets[0].transform"},
               [&] { static_cast<void>(Pyramid(broken, "", "").spacing(0)); });
}

TEST(N5Container, TheOnlyArrayIsFound) {
  Random random(32);
  const TempDir dir;
  const N5Sample sample;
  const auto labels = random_labels(random, sample.shape, sample.type);
  write_file(dir.path() / "attributes.json", R"({"n5": "2.5.1"})");
  expect_not_opened(dir.path(), {"no array"});
  sample.write(random, dir.path() / "volumes" / "labels" / "s0", labels);
  EXPECT_EQ(read_all(*open_volume(dir.path())), labels);
  N5Sample other{.shape = {2, 2, 2}};
  const auto raw = random_labels(random, other.shape, other.type);
  other.write(random, dir.path() / "volumes" / "raw", raw);
  expect_not_opened(dir.path(), {"several arrays: volumes/labels, volumes/raw", "--dataset"});
  OpenOptions options;
  for (const char* name : {"volumes/raw", "/volumes/raw", "volumes/raw/"}) {
    options.dataset = name;
    EXPECT_EQ(read_all(*open_volume(dir.path(), options)), raw);
  }
  for (const char* name : {"volumes/nothing", "volumes/../volumes/raw", "../x"}) {
    options.dataset = name;
    expect_misused(dir.path(), options, {name, "volumes/labels, volumes/raw"});
  }
  options.dataset = "volumes/labels";
  options.scale = 3;
  expect_misused(dir.path(), options, {"--scale 3", "1 levels"});
  options.dataset = "volumes/raw";
  expect_misused(dir.path(), options, {"--scale 3", "one resolution"});
}

TEST(N5Container, LinksThatGoRoundEnd) {
  const TempDir dir;
  for (const char* name : {"a", "b", "c"}) {
    std::filesystem::create_directory_symlink(dir.path(), dir.path() / name);
  }
  write_file(dir.path() / "attributes.json", "{}");
  EXPECT_TRUE(is_refused(dir.path()));
}

/// Replaces a piece of good attributes and expects them to be refused.
void expect_attributes_refused(const std::string& from, const std::string& to,
                               std::vector<std::string> pieces) {
  const TempDir dir;
  std::string attributes = N5Sample{}.attributes();
  const std::size_t at = attributes.find(from);
  ASSERT_NE(at, attributes.npos) << from;
  const auto path = dir.path() / "attributes.json";
  write_file(path, attributes.replace(at, from.size(), to));
  pieces.push_back(path.string());
  expect_not_opened(dir.path(), pieces);
}

TEST(N5Errors, Attributes) {
  expect_attributes_refused("[7, 6, 5]", "[7, 6]", {"blockSize", "3 numbers", "2"});
  expect_attributes_refused("[7, 6, 5]", "[7]", {"dimensions", "1 axes"});
  expect_attributes_refused("[7, 6, 5]", "[7, 6, 5, 2]", {"dimensions", "4 axes", "pick one"});
  expect_attributes_refused("[7, 6, 5]", "[7, 0, 5]", {"dimensions (y)", "not positive"});
  expect_attributes_refused("[7, 6, 5]", "[7, 6, 1e9]", {"dimensions (z)", "1000000000"});
  expect_attributes_refused("[7, 6, 5]", "[7, 6, 1e300]", {"dimensions", "whole numbers"});
  expect_attributes_refused("[4, 4, 4]", "[4, -4, 4]", {"blockSize", "-4"});
  expect_attributes_refused("[4, 4, 4]", "[4096, 4096, 4096]", {"blockSize", "2 GiB"});
  expect_attributes_refused("[4, 4, 4]", "[4294967296, 4294967296, 4]", {"blockSize", "2 GiB"});
  expect_attributes_refused("\"blockSize\"", "\"blocks\"", {"blockSize", "missing"});
  expect_attributes_refused("uint32", "uint33", {"dataType", "uint33"});
  expect_attributes_refused("\"raw\"", "\"jpeg\"", {"compression.type", "jpeg"});
  expect_attributes_refused("{\"type\": \"raw\"}", "7", {"compression", "7"});
  expect_attributes_refused("}}", R"(}, "isLabelMultiset": true})", {"isLabelMultiset"});
}

TEST(N5Errors, Blocks) {
  const TempDir dir;
  write_file(dir.path() / "attributes.json", N5Sample{.shape = {2, 1, 1}}.attributes());
  const auto block = dir.path() / "0" / "0" / "0";
  const auto expect = [&](const std::string& hex, std::vector<std::string> pieces) {
    write_file(block, from_hex(hex));
    pieces.push_back(block.string());
    expect_not_read(dir.path(), pieces);
  };
  const std::string size = "000000020000000100000001";
  const std::string voxels = "0000000100000002";
  write_file(block, from_hex("00000003" + size + voxels));
  EXPECT_EQ(read_all(*open_volume(dir.path())), (std::vector<RawLabel>{1, 2}));
  expect("", {"truncated"});
  expect("00000003" + size.substr(0, 22), {"truncated"});
  expect("00020003" + size + voxels, {"block header", "mode 2"});
  expect("00000002" + size + voxels, {"block header", "2 axes"});
  expect("00010003" + size + "00000003" + voxels, {"block header", "3 values for 2"});
  expect("00000003000000010000000100000001" + voxels, {"block header", "extent 1", "along x"});
  expect("00000003000000020000000000000001" + voxels, {"block header", "extent 0"});
  expect("00000003000000020000000500000001" + voxels, {"block header", "extent 5"});
  expect("00000003ffffffffffffffffffffffff" + voxels, {"block header", "extent 4294967295"});
  expect("00000003" + size + voxels.substr(2), {"7 bytes", "are 8"});
  expect("00000003" + size + voxels + "00", {"9 bytes", "are 8"});
}

/// Files with a hole of 64 GiB: a reader that believes their size runs out of memory.
TEST(N5Errors, FilesThatAreFarTooLarge) {
  Random random(35);
  for (const char* file : {"attributes.json", "0/0/0"}) {
    const TempDir dir;
    const N5Sample sample;
    sample.write(random, dir.path(), random_labels(random, sample.shape, sample.type));
    std::filesystem::resize_file(dir.path() / file, std::uint64_t{1} << 36);
    expect_not_read(dir.path(), {file, "68719476736 bytes"});
  }
}

TEST(N5Damage, AttributesAreReadOrRefused) {
  Random random(33);
  const TempDir dir;
  const N5Sample sample{.extra = R"(, "resolution": [1, 2, 3], "units": ["nm", "nm", "nm"])"};
  sample.write(random, dir.path(), random_labels(random, sample.shape, sample.type));
  EXPECT_GT(refused_when_damaged(dir.path(), dir.path() / "attributes.json", 1), 500);
}

TEST(N5Damage, BlocksAreReadOrRefused) {
  Random random(34);
  for (const N5Packing& packing : kN5Packings) {
    SCOPED_TRACE(packing.json);
    const TempDir dir;
    const N5Sample sample{.shape = {4, 3, 2}, .packing = packing};
    sample.write(random, dir.path(), random_labels(random, sample.shape, sample.type));
    EXPECT_GT(refused_when_damaged(dir.path(), dir.path() / "0" / "0" / "0", 1), 80);
  }
}

}  // namespace
}  // namespace mw::io
