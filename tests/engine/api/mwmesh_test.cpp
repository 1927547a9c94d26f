// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The C++ library as its users call it.
#include <gmock/gmock.h>

#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/engine/api/library.h"
#include "tests/engine/cli/run_program.h"

namespace mwmesh {
namespace {

using namespace test;
using nlohmann::json;
using testing::HasSubstr;

using LibraryTest = mw::cli::ProgramTest;

TEST_F(LibraryTest, MakesTheMeshOfTheProgram) {
  expect_done("synth voronoi --shape 22,18,20 --labels 6 --seed 3 -o v.npy");
  expect_done(
      "mesh v.npy -o v.vtu --spacing 1,2,1.5 --origin 5,6,7 --max-distance 1.2 "
      "--report r.json --threads 1");
  const auto labels = grains();
  ArrayVolume array{.data = labels.data(), .type = VoxelType::kU64, .shape = kShape};
  array.space = {.spacing = {1, 2, 1.5}, .origin = {5, 6, 7}};
  const Options options{{"max_distance", "1.2"}, {"threads", "2"}};
  const Mesh made = mesh(Volume::of(array), options);
  const json told = json::parse(read("r.json"));
  const auto digest = told["digest"].get<std::string>();
  EXPECT_EQ(made.digest(), digest);
  const json report = json::parse(made.report());
  for (const char* same : {"digest", "quality", "shape", "lattice", "topology", "distance"}) {
    EXPECT_EQ(report[same], told[same]) << same;
  }
  EXPECT_EQ(report["settings"]["max_distance"], 1.2);
  EXPECT_NE(made.summary().find("\nchecks      P1 topology, P2 fit"), std::string::npos);
  // And back: what the library writes, the program reads.
  made.save(folder() / "w.mesh");
  made.save(folder() / "w.vtkhdf");
  expect_done("verify v.npy --spacing 1,2,1.5 --origin 5,6,7 w.vtkhdf");
  EXPECT_EQ(read_mesh(folder() / "w.mesh").digest(), digest);
  EXPECT_EQ(read_mesh(folder() / "v.vtu").digest(), digest);
  const std::string file_report = mesh_to_file(folder() / "f.msh", Volume::of(array), options);
  EXPECT_EQ(json::parse(file_report)["digest"], told["digest"]);
  EXPECT_EQ(read_mesh(folder() / "f.msh").digest(), digest);
}

/// Labels in an array of another type, order of axes and direction, with gaps.
struct Layout {
  std::vector<std::byte> bytes;
  ArrayVolume array;
};

template <class T>
Layout laid_out(const std::vector<std::uint64_t>& labels, VoxelType type, std::mt19937& random) {
  Layout out;
  std::array<int, 3> order{0, 1, 2};
  std::shuffle(order.begin(), order.end(), random);
  Index strides{};
  std::int64_t size = sizeof(T);
  // Gaps also put voxels where no number of their type may be.
  for (const int axis : order) {
    const auto k = static_cast<std::size_t>(axis);
    strides[k] = size;
    size = size * kShape[k] + static_cast<std::int64_t>(random() % 3);
  }
  std::int64_t first = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (random() % 2 == 0) continue;
    first += strides[k] * (kShape[k] - 1);
    strides[k] = -strides[k];
  }
  out.bytes.resize(static_cast<std::size_t>(size));
  std::size_t next = 0;
  for (std::int64_t z = 0; z < kShape[2]; ++z) {
    for (std::int64_t y = 0; y < kShape[1]; ++y) {
      for (std::int64_t x = 0; x < kShape[0]; ++x) {
        const T value = static_cast<T>(labels[next++]);
        std::memcpy(out.bytes.data() + first + x * strides[0] + y * strides[1] + z * strides[2],
                    &value, sizeof(T));
      }
    }
  }
  out.array = {.data = out.bytes.data() + first, .type = type, .shape = kShape, .strides = strides};
  return out;
}

TEST(Library, ReadsArraysOfAnyTypeAndStrides) {
  const auto labels = grains();
  std::mt19937 random(7);
  for (int trial = 0; trial < 30; ++trial) {
    const Layout layouts[] = {laid_out<std::uint8_t>(labels, VoxelType::kU8, random),
                              laid_out<std::int16_t>(labels, VoxelType::kI16, random),
                              laid_out<std::uint32_t>(labels, VoxelType::kU32, random),
                              laid_out<std::int64_t>(labels, VoxelType::kI64, random),
                              laid_out<float>(labels, VoxelType::kF32, random),
                              laid_out<double>(labels, VoxelType::kF64, random)};
    for (const Layout& layout : layouts) {
      const Volume volume = Volume::of(layout.array);
      std::vector<std::uint64_t> read(labels.size());
      volume.read({{0, 0, 0}, kShape}, read);
      EXPECT_EQ(read, labels);
    }
  }
}

TEST(Library, TellsWhatIsKnownOfAVolume) {
  const std::vector<std::int16_t> voxels(4 * 3 * 2, -1);
  ArrayVolume array{.data = voxels.data(), .type = VoxelType::kI16, .shape = {4, 3, 2}};
  array.space = {.spacing = {1, 2, 1.5}, .origin = {5, 6, 7}, .unit = "um", .frame = "lps"};
  const Volume three = Volume::of(array).with_names({{3, "three"}});
  const Volume volume = three.with_names({{1, "one"}, {3, "third"}});
  EXPECT_EQ(volume.shape(), (Index{4, 3, 2}));
  EXPECT_EQ(volume.type(), VoxelType::kI16);
  EXPECT_TRUE(volume.labels_are_signed());
  const Space space = volume.space();
  EXPECT_EQ(space.spacing, array.space.spacing);
  EXPECT_EQ(space.origin, array.space.origin);
  EXPECT_EQ(space.axes, array.space.axes);
  EXPECT_EQ(space.unit, "um");
  EXPECT_EQ(space.frame, "lps");
  std::map<std::uint64_t, std::string> names;
  for (const LabelName& n : volume.names()) names[n.label] = n.name;
  EXPECT_EQ(names, (std::map<std::uint64_t, std::string>{{1, "one"}, {3, "third"}}));
  EXPECT_FALSE(volume_of(grains()).labels_are_signed());
}

TEST_F(LibraryTest, OpensAPartOfAFile) {
  expect_done("synth voronoi --shape 22,18,20 --labels 6 --seed 3 -o v.npy");
  const Box part{{2, 3, 4}, {12, 9, 11}};
  const Volume volume =
      Volume::open(folder() / "v.npy", {{"spacing", "1,2,1.5"}, {"crop", "2,3,4,12,9,11"}});
  EXPECT_EQ(volume.shape(), (Index{10, 6, 7}));
  EXPECT_EQ(volume.space().origin, (Vector{2, 6, 6}));
  std::vector<std::uint64_t> expected(10 * 6 * 7), read(expected.size());
  volume_of(grains()).read(part, expected);
  volume.read({{0, 0, 0}, {10, 6, 7}}, read);
  EXPECT_EQ(read, expected);
}

TEST(Library, NamesTheVoxelThatIsNoLabel) {
  std::vector<float> voxels(4 * 3 * 2, 1.0F);
  voxels[4 * 3 + 4 + 2] = 1.5F;
  const Volume volume =
      Volume::of(ArrayVolume{.data = voxels.data(), .type = VoxelType::kF32, .shape = {4, 3, 2}});
  const std::string message = failure(ErrorKind::kInput, [&] { (void)mesh(volume); });
  EXPECT_THAT(message, HasSubstr("(2, 1, 1)"));
  EXPECT_THAT(message, HasSubstr("1.5"));
}

TEST(Library, FetchesRegions) {
  const auto labels = grains();
  const Volume whole = volume_of(labels);
  std::atomic<std::uint64_t> largest = 0;
  RegionVolume region{.type = VoxelType::kU8, .shape = kShape, .chunk = {8, 8, 8}};
  region.read = [&](const Box& box, std::span<std::uint64_t> out) {
    whole.read(box, out);
    largest = std::max<std::uint64_t>(largest, out.size());
  };
  const std::string expected = mesh(whole).digest();
  EXPECT_EQ(mesh(Volume::of(region)).digest(), expected);
  EXPECT_GT(largest, 0U);
  region.chunk.fill(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(mesh(Volume::of(region)).digest(), expected);
}

TEST(Library, HoldsRegionsToTheirType) {
  const auto volume_of_label = [](VoxelType type, std::uint64_t label) {
    RegionVolume region{.type = type, .shape = {6, 5, 4}};
    region.read = [label](const Box& box, std::span<std::uint64_t> out) {
      std::fill(out.begin(), out.end(), 1);
      if (box.lo == Index{} && !out.empty()) out.front() = label;
    };
    return Volume::of(region);
  };
  const auto minus = [](std::int64_t n) { return static_cast<std::uint64_t>(-n); };
  const std::pair<VoxelType, std::uint64_t> bad[] = {{VoxelType::kU8, 256},
                                                     {VoxelType::kU8, minus(1)},
                                                     {VoxelType::kI8, 128},
                                                     {VoxelType::kI8, minus(129)},
                                                     {VoxelType::kU32, std::uint64_t{1} << 32U}};
  for (const auto& [type, label] : bad) {
    EXPECT_THAT(failure(ErrorKind::kInput, [&] { (void)mesh(volume_of_label(type, label)); }),
                HasSubstr("voxel (0, 0, 0) came back with a label"));
  }
  const std::pair<VoxelType, std::uint64_t> good[] = {{VoxelType::kU8, 255},
                                                      {VoxelType::kI8, 127},
                                                      {VoxelType::kI8, minus(128)},
                                                      {VoxelType::kU64, minus(1)},
                                                      {VoxelType::kI64, minus(1)}};
  for (const auto& [type, label] : good) {
    EXPECT_GT(mesh(volume_of_label(type, label)).tets().size(), 0U);
  }
}

/// What a callback throws comes out as it is, of whichever thread, and leaves nothing behind.
TEST(Library, LetsWhatCallbacksThrowPass) {
  const auto labels = grains();
  RegionVolume region{.type = VoxelType::kU8, .shape = kShape};
  std::atomic<bool> fails = true;
  region.read = [&](const Box& box, std::span<std::uint64_t> out) {
    if (fails) throw std::out_of_range("mine");
    volume_of(labels).read(box, out);
  };
  const Volume volume = Volume::of(region).with_names({{1, "one"}});
  std::vector<std::uint64_t> voxel(1);
  EXPECT_THROW((void)mesh(volume), std::out_of_range);
  EXPECT_THROW(volume.read({{0, 0, 0}, {1, 1, 1}}, voxel), std::out_of_range);
  fails = false;
  const Mesh made = mesh(volume);
  EXPECT_THROW((void)verify(made, volume, {}, {.cancel = []() -> bool { throw 7; }}), int);
  EXPECT_THROW((void)mesh(volume, {}, {.progress = [](const Progress&) { throw 7; }}), int);
  const Hooks own{.cancel = []() -> bool { throw Error(ErrorKind::kInput, "mine"); }};
  EXPECT_EQ(failure(ErrorKind::kInput, [&] { (void)mesh(volume, {}, own); }), "mine");
  ArrayVolume thick{.data = labels.data(), .type = VoxelType::kU64, .shape = kShape};
  thick.space.spacing = {1, 1, 25};
  const Hooks warned{.warn = [](const std::string& line) { throw line; }};
  EXPECT_THROW((void)mesh(Volume::of(thick), {}, warned), std::string);
}

TEST(Library, MeshesInSeveralThreadsAtOnce) {
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  const std::string expected = mesh(volume, {{"threads", "1"}}).digest();
  std::vector<std::string> made(4);
  std::vector<std::thread> threads;
  for (std::string& out : made) {
    threads.emplace_back([&] { out = mesh(volume, {{"threads", "2"}}).digest(); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(made, testing::Each(expected));
}

TEST(Library, TellsProgressAndCanBeCancelled) {
  const mw::test::TempFolder folder;
  const auto labels = synth("voronoi", {40, 40, 40}, 9, 1);
  const Volume volume = volume_of(labels, {40, 40, 40});
  Options options{{"window", "16"}};
  std::uint64_t seen = 0;
  const Hooks watch{.progress = [&](const Progress& at) {
    EXPECT_GE(at.done, seen);
    EXPECT_LE(at.done, at.total);
    seen = at.done;
  }};
  const std::string expected = mesh(volume, options, watch).digest();
  ASSERT_GT(seen, 20U);
  const std::uint64_t half = seen / 2;
  std::atomic<bool> enough = false;
  const Hooks stop{.progress = [&](const Progress& at) { enough = at.done >= half; },
                   .cancel = [&] { return enough.load(); }};
  const std::string work = folder.path() / "work";
  options.set("workdir", work);
  EXPECT_THAT(failure(ErrorKind::kCancelled, [&] { (void)mesh(volume, options, stop); }),
              HasSubstr("; the work so far is in " + work + ", add resume to go on"));
  ASSERT_TRUE(std::filesystem::exists(work));
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)mesh(volume, options); }),
              HasSubstr("add resume to go on"));
  options.set("resume", "true").set("max_distance", "1");
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)mesh(volume, options); }),
              HasSubstr("another run: max_distance was 1.5 and is 1"));
  const Mesh resumed = mesh(volume, options.set("max_distance", "1.5"));
  EXPECT_EQ(resumed.digest(), expected);
  EXPECT_GT(json::parse(resumed.report())["engine"]["windows_resumed"], 0);
  EXPECT_FALSE(std::filesystem::exists(work));
}

/// Runs into a folder, and cancels half-way.
void keep_half(const Volume& volume, const Options& options) {
  std::atomic<bool> enough = false;
  const Hooks stop{.progress = [&](const Progress& at) { enough = 2 * at.done > at.total; },
                   .cancel = [&] { return enough.load(); }};
  failure(ErrorKind::kCancelled, [&] { (void)mesh(volume, options, stop); });
}

TEST(Library, GoesOnWithAKeptFolderOfARunThatWasCancelled) {
  const mw::test::TempFolder folder;
  const auto labels = synth("voronoi", {40, 40, 40}, 9, 1);
  const Volume volume = volume_of(labels, {40, 40, 40});
  const std::string kept = folder.path() / "kept", second = folder.path() / "second";
  const std::string expected = mesh(volume, {{"window", "16"}, {"order", "colour"}}).digest();
  const Options fresh{{"window", "16"}, {"keep", kept}};
  keep_half(volume, fresh);
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)mesh(volume, fresh); }), HasSubstr("from"));
  const Options again{{"window", "16"}, {"from", kept}};
  const Mesh made = mesh(volume, again);
  EXPECT_EQ(made.digest(), expected);
  EXPECT_FALSE(json::parse(made.report()).contains("delta"));
  const auto edited = synth("voronoi", {40, 40, 40}, 8, 1);
  EXPECT_TRUE(json::parse(mesh(volume_of(edited, {40, 40, 40}), again).report()).contains("delta"));
  EXPECT_THAT(failure(ErrorKind::kUsage,
                      [&] {
                        (void)mesh(volume_of(edited, {20, 40, 40}), again);
                      }),
              HasSubstr("another shape"));
  // Or in the way of the program's --resume.
  const Options resume{{"window", "16"}, {"keep", second}, {"resume", "true"}};
  keep_half(volume, resume);
  const Mesh resumed = mesh(volume, resume);
  EXPECT_EQ(resumed.digest(), expected);
  EXPECT_GT(json::parse(resumed.report())["engine"]["remesh"]["marches"][0]["skipped"], 0);
}

TEST(Library, SaysWhatIsCompleteWhenItIsCancelledLate) {
  const mw::test::TempFolder folder;
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  const std::string kept = folder.path() / "kept";
  (void)mesh(volume, {{"keep", kept}});
  const std::filesystem::path file = folder.path() / "m.vtu";
  const Hooks stop{.cancel = [&] { return std::filesystem::exists(file); }};
  EXPECT_THAT(failure(ErrorKind::kCancelled,
                      [&] {
                        mesh_to_file(file, volume, {{"from", kept}}, stop);
                      }),
              HasSubstr("m.vtu is complete"));
  EXPECT_FALSE(read_mesh(file).tets().empty());
}

TEST(Library, MergesLargeLabelsWithoutSign) {
  auto labels = grains();
  const std::uint64_t large = ~std::uint64_t{0};
  std::replace(labels.begin(), labels.end(), std::uint64_t{2}, large);
  const Options options{{"merge", "1=" + std::to_string(large)}};
  const Mesh made = mesh(volume_of(labels), options);
  EXPECT_THAT(made.labels(), testing::Contains(large));
  EXPECT_THAT(made.labels(), testing::Not(testing::Contains(1U)));
  EXPECT_TRUE(verify(made, volume_of(labels), options).passed);
}

/// A mesh with two columns of values that are all alike.
Mesh mesh_with_values(const std::vector<std::string>& names) {
  const auto labels = grains();
  Mesh made = mesh(volume_of(labels));
  for (std::size_t i = 0; i < names.size(); ++i) {
    made.set_values(names[i], std::vector(made.tets().size(), static_cast<double>(i)));
  }
  return made;
}

TEST(Library, NamesOfValuesAreMadeFitForFiles) {
  const mw::test::TempFolder folder;
  const Mesh made = mesh_with_values({"", "a b", "a/b", "label", "x\ny"});
  for (const char* name : {"m.vtkhdf", "m.msh", "m.vtu"}) {
    made.save(folder.path() / name);
    const Mesh back = read_mesh(folder.path() / name);
    std::vector<std::string> names;
    for (const auto& column : back.values()) names.push_back(column.first);
    EXPECT_EQ(names, (std::vector<std::string>{"a_b", "a_b_2", "label_2", "value_", "x_y"}));
    EXPECT_EQ(back.tets().size(), made.tets().size()) << name;
    EXPECT_TRUE(std::ranges::equal(back.values().at("label_2"), made.values().at("label"))) << name;
  }
}

TEST(Library, MaterialsNeedValuesThatAreNotWritten) {
  const mw::test::TempFolder folder;
  const Mesh made = mesh_with_values({"hu", "other"});
  const Options alone{{"write_values", "false"}, {"materials", "hu=3"}};
  made.save(folder.path() / "m.inp", alone);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "m.inp.materials.csv"));
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { made.save(folder.path() / "m.msh", alone); }),
              HasSubstr("values: "));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "m.msh"));
}

TEST(Library, WritesRunsWithoutValues) {
  const mw::test::TempFolder folder;
  const auto labels = grains();
  std::string head = "{'descr': '|u1', 'fortran_order': False, 'shape': (20, 18, 22), }";
  head.resize(117, ' ');
  std::ofstream(folder.path() / "image.npy", std::ios::binary)
      << std::string("\x93NUMPY\x01\x00\x76\x00", 10) << head << "\n"
      << std::string(20 * 18 * 22, '\7');
  const auto write = [&](const char* name, const char* values, const char* materials = nullptr) {
    Options options{{"sample", "hu=" + (folder.path() / "image.npy").string()},
                    {"write_values", values}};
    if (materials != nullptr) options.set("materials", materials);
    return mesh_to_file(folder.path() / name, volume_of(labels), options);
  };
  const std::string report = write("m.vtu", "false");
  EXPECT_TRUE(read_mesh(folder.path() / "m.vtu").values().empty());
  EXPECT_EQ(json::parse(report)["samples"].size(), 1U);
  write("n.vtu", "true");
  EXPECT_EQ(read_mesh(folder.path() / "n.vtu").values().count("hu"), 1U);
  write("m.mesh", "false");  // which has no place for values
  write("m.inp", "false", "hu=2");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "m.inp.materials.csv"));
}

TEST(Library, RefusesWhatIsNoVolume) {
  const auto labels = grains();
  ArrayVolume array{.data = labels.data(), .type = VoxelType::kU64, .shape = kShape};
  const auto refusal = [&] { return failure(ErrorKind::kUsage, [&] { (void)Volume::of(array); }); };
  for (const std::int64_t bad : {0, -1, (1 << 20) + 1}) {
    array.shape = {22, bad, 20};
    EXPECT_THAT(refusal(), HasSubstr("shape (y)"));
  }
  constexpr std::int64_t kHuge = std::int64_t{1} << 40;  // whose square no number holds
  array.shape = {kHuge, kHuge, 1};
  EXPECT_THAT(refusal(), HasSubstr("shape (x)"));
  array.shape = kShape;
  array.space.axes[0] = {0.6, 0.8, 0};
  EXPECT_THAT(refusal(), HasSubstr("right angles"));
  array.space = {};
  array.type = static_cast<VoxelType>(42);
  EXPECT_THAT(refusal(), HasSubstr("type"));
  Volume volume = volume_of(labels);
  const Volume taken = std::move(volume);
  EXPECT_EQ(taken.shape(), kShape);
  failure(ErrorKind::kUsage, [&] { (void)volume.shape(); });  // NOLINT(bugprone-use-after-move)
  failure(ErrorKind::kUsage, [&] { (void)mesh(volume); });
}

TEST(Library, ReadsBoxesThatAreOnes) {
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  std::vector<std::uint64_t> out(8, 77);
  failure(ErrorKind::kUsage, [&] { volume.read({{4, 4, 0}, {2, 2, 2}}, out); });
  failure(ErrorKind::kUsage, [&] { volume.read({{10, 4, 0}, {4, 4, 4}}, {}); });
  EXPECT_THAT(out, testing::Each(77));
  volume.read({{4, 4, 4}, {4, 4, 4}}, {});
}

TEST(Library, KeepsCurvedTets) {
  const mw::test::TempFolder folder;
  const auto labels = grains();
  const Options curved{{"element", "tet10-curved"}};
  mesh(volume_of(labels)).save(folder.path() / "m.vtu", curved);
  const Mesh parts = read_mesh(folder.path() / "m.vtu");
  ASSERT_TRUE(parts.is_in_parts());
  parts.save(folder.path() / "again.vtu", curved);
  EXPECT_TRUE(std::ranges::equal(read_mesh(folder.path() / "again.vtu").points(), parts.points()));
  parts.save(folder.path() / "n.vtu", {{"element", "tet10"}});
  const Mesh odd(parts.points(), parts.tets().first(9), parts.labels().first(9));
  const std::string record = parts.record();
  EXPECT_THAT(failure(ErrorKind::kUsage,
                      [&] { detail::call(mw_mesh_set_record, odd.handle(), record.c_str(), 1); }),
              HasSubstr("in_parts"));
}

TEST(Library, TellsWedges) {
  const auto labels = grains();
  const Mesh made = mesh(volume_of(labels), {{"cohesive", "*"}});
  const Wedges wedges = made.wedges();
  ASSERT_GT(wedges.rows.size(), 0U);
  ASSERT_EQ(wedges.labels.size(), wedges.rows.size());
  for (std::size_t w = 0; w < wedges.rows.size(); ++w) {
    EXPECT_NE(wedges.labels[w][0], wedges.labels[w][1]);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(made.points()[wedges.rows[w][i]], made.points()[wedges.rows[w][i + 3]]);
    }
  }
}

TEST(Library, AsksOftenWhetherToGoOn) {
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  std::atomic<int> asked = 0;
  const Hooks hooks{.cancel = [&] {
    ++asked;
    return false;
  }};
  // Sizes far below a voxel: most of the time goes into cutting tets.
  const Mesh coarse =
      mesh(volume, {{"certify", "off"}, {"measure", "false"}, {"size", "1.4"}}, hooks);
  const int before = asked.exchange(0);
  const Mesh fine =
      mesh(volume, {{"certify", "off"}, {"measure", "false"}, {"size", "0.7"}}, hooks);
  EXPECT_GT(fine.tets().size(), 4 * coarse.tets().size());
  EXPECT_GT(asked, before + static_cast<int>(fine.tets().size() / 8192));
  asked = 0;
  EXPECT_TRUE(verify(coarse, volume, {}, hooks).passed);
  EXPECT_GT(asked, 8);
  const Hooks stop{.cancel = [&] { return true; }};
  failure(ErrorKind::kCancelled, [&] { (void)verify(coarse, volume, {}, stop); });
}

TEST(Library, VerifiesMeshes) {
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  const Mesh made = mesh(volume);
  const Verdict good = verify(made, volume);
  EXPECT_TRUE(good.passed);
  const json report = json::parse(good.report);
  EXPECT_EQ(report["asked"]["of_run"], true);
  EXPECT_EQ(report["passed"], true);
  for (const json& check : report["checks"]) EXPECT_EQ(check["passed"], true) << check["name"];
  std::vector<Tet> tets(made.tets().begin(), made.tets().end());
  std::swap(tets[5][0], tets[5][1]);
  EXPECT_FALSE(verify(Mesh(made.points(), tets, made.labels()), volume).passed);
  tets[5][2] = made.points().size();
  failure(ErrorKind::kUsage, [&] { (void)Mesh(made.points(), tets, made.labels()); });
  failure(ErrorKind::kUsage, [&] { (void)Mesh(made.points(), tets, {}); });
}

TEST_F(LibraryTest, DrawsThePictureOfTheProgram) {
  const auto labels = synth("spheres", {24, 24, 24}, 3, 1);
  const Mesh made = mesh(volume_of(labels, {24, 24, 24}));
  made.save(folder() / "m.vtu");
  expect_done("picture m.vtu -o m.png --pixels 300x200");
  EXPECT_EQ(made.picture(300, 200), read("m.png"));
  failure(ErrorKind::kInput, [] { (void)Mesh({}, {}, {}).picture(); });
}

TEST(Library, TakesStepsAndChoices) {
  const auto labels = grains();
  const std::array<std::uint8_t, 4> red{255, 0, 0, 255};
  const Volume volume =
      volume_of(labels).with_names({{.label = 2, .name = "liver", .colour = red}});
  const Options options{{"merge", "1,3=liver"}, {"labels", "Liver,4"}};
  const Mesh made = mesh(volume, options);
  EXPECT_EQ(std::set(made.labels().begin(), made.labels().end()), (std::set<std::uint64_t>{2, 4}));
  ASSERT_EQ(made.names().size(), 1U);
  EXPECT_EQ(made.names()[0].name, "liver");
  EXPECT_EQ(made.names()[0].colour, red);
  EXPECT_EQ(volume.find_label("liver"), 2U);
  EXPECT_EQ(made.find_label("liver"), 2U);
  EXPECT_EQ(volume.find_label("77"), 77U);
  failure(ErrorKind::kUsage, [&] { (void)volume.find_label("-1"); });
  failure(ErrorKind::kUsage, [&] { (void)made.find_label("kidney"); });
  EXPECT_TRUE(verify(made, volume, options).passed);
  failure(ErrorKind::kUsage, [&] { (void)mesh(volume, {{"labels", "77"}}); });
  failure(ErrorKind::kUsage, [&] { (void)mesh(volume, {{"labels", "kidney"}}); });
}

}  // namespace
}  // namespace mwmesh
