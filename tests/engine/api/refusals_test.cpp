// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options, numbers, places and paths: what the library takes, and how it words what it refuses.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/engine/api/library.h"
#include "tests/engine/cli/run_program.h"

namespace mwmesh {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::StartsWith;

using LibraryPathsTest = mw::cli::ProgramTest;

TEST(LibraryOptions, AreThoseOfTheProgram) {
  Options options;
  std::set<std::string> names;
  for (const auto& row : nlohmann::json::parse(Options::table())) {
    const std::string name = row["name"], help = row["help"];
    names.insert(name);
    EXPECT_EQ(options.get(name), row["default"].is_null() ? "" : std::string(row["default"]))
        << name;
    EXPECT_EQ(name.find('-'), std::string::npos);
    EXPECT_EQ(help.find("--"), std::string::npos) << help;
  }
  for (const char* name : {"max_distance", "crop", "merge", "threads", "sample", "write_values"}) {
    EXPECT_EQ(names.count(name), 1U) << name;
  }
  for (const char* name : {"output", "report", "config"}) EXPECT_EQ(names.count(name), 0U) << name;
  EXPECT_EQ(options.set("max-distance", "none").get("max_distance"), "none");
  EXPECT_EQ(mw_options_set(options.handle(), "max_distance", nullptr, nullptr), MW_OK);
  EXPECT_EQ(options.get("max_distance"), "1.5");
  const auto refusal = [&](const char* name, const char* text) {
    return failure(ErrorKind::kUsage, [&] { options.set(name, text); });
  };
  EXPECT_THAT(refusal("max_distanse", "1"), HasSubstr("did you mean max_distance?"));
  EXPECT_THAT(refusal("prest", "fine"), HasSubstr("did you mean preset?"));
  EXPECT_THAT(refusal("zzzz", "1"), HasSubstr("there are "));
  EXPECT_EQ(refusal("window", "5"), "window: must be an even number from 4 to 256");
  EXPECT_EQ(refusal("quality_floor", "1"), "quality_floor: must be from 0 to 0.5");
  EXPECT_EQ(refusal("surface", "smoth"), "surface: expected one of smooth, voxel");
  EXPECT_THAT(refusal("preset", "quick"), HasSubstr("preset: "));
  const Options moved = std::move(options);
  EXPECT_EQ(refusal("window", "6"), "this object was moved from");
}

TEST(LibraryNumbers, AreRefusedAsByTheProgram) {
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  for (const char* threads : {"-1", "1025", "30000", "1000000000", "two"}) {
    EXPECT_THAT(failure(ErrorKind::kUsage,
                        [&] {
                          (void)Options({{"threads", threads}});
                        }),
                StartsWith("threads"));
  }
  ArrayVolume array{.data = labels.data(), .type = VoxelType::kU64, .shape = kShape};
  for (const double bad : {-1.0, 0.0, std::nan(""), HUGE_VAL}) {
    array.space = {.spacing = {1, bad, 1}};
    EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)Volume::of(array); }), HasSubstr("spacing"));
  }
  array.space = {.origin = {0, 0, std::nan("")}};
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)Volume::of(array); }), HasSubstr("origin"));
  array.space = {.axes = {{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)Volume::of(array); }), HasSubstr("axes"));
  for (const char* option : {"scale=-1", "spacing=1,-1,1", "spacing=1,0,1", "spacing=1,nan,1"}) {
    const std::string name(option, std::strchr(option, '='));
    EXPECT_THAT(failure(ErrorKind::kUsage,
                        [&] {
                          (void)Options({{name, option + name.size() + 1}});
                        }),
                StartsWith(name));
  }
  RegionVolume region{.shape = kShape, .chunk = {8, -8, 8}};
  region.read = [](const Box&, std::span<std::uint64_t>) {};
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)Volume::of(region); }), HasSubstr("chunk"));
  std::vector<std::uint64_t> out(8);
  failure(ErrorKind::kUsage, [&] { volume.read({{21, 0, 0}, {23, 2, 2}}, out); });
  failure(ErrorKind::kUsage, [&] { volume.read({{0, 0, 0}, {3, 2, 2}}, out); });
  failure(ErrorKind::kUsage, [] { (void)Mesh({}, {}, {}).picture(15, 900); });
}

#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wmissing-field-initializers"

TEST(Library, MembersThatAreNotNamedDoNotWarn) {
  EXPECT_FALSE(Hooks{.cancel = [] { return false; }}.progress);
  EXPECT_FALSE(Hooks{.progress = [](const Progress&) {}}.cancel);
  EXPECT_EQ(Progress{.done = 1}.seconds_left, std::nullopt);
  EXPECT_EQ(LabelName{.label = 1}.name, "");
  EXPECT_EQ((Box{.lo = {1, 1, 1}}.hi), Index{});
  EXPECT_EQ((Space{.spacing = {1, 1, 2}}.frame), "own");
  EXPECT_EQ((ArrayVolume{.shape = {1, 1, 1}}.data), nullptr);
  EXPECT_FALSE((RegionVolume{.shape = {1, 1, 1}}.read));
  EXPECT_FALSE(Verdict{.report = "a"}.passed);
}

#pragma GCC diagnostic pop

TEST(LibraryNumbers, PathsHaveNoZeroByte) {
  const std::string path("a\0b", 3);
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  const Mesh none({}, {}, {});
  failure(ErrorKind::kUsage, [&] { (void)Volume::open(path); });
  failure(ErrorKind::kUsage, [&] { (void)read_mesh(path); });
  failure(ErrorKind::kUsage, [&] { none.save(path); });
  failure(ErrorKind::kUsage, [&] { mesh_to_file(path, volume); });
  failure(ErrorKind::kUsage, [&] { (void)Options({{"workdir", path}}); });
}

TEST(LibrarySpace, OfAnAffine) {
  // Axes permuted and flipped, 2 x 3 x 4 a voxel.
  const Space space = space_of_affine({{{0, -3, 0, 10}, {2, 0, 0, 20}, {0, 0, 4, 30}}}, "ras");
  EXPECT_EQ(space.spacing, (Vector{2, 3, 4}));
  EXPECT_EQ(space.axes[0], (Vector{0, 1, 0}));
  EXPECT_EQ(space.axes[1], (Vector{-1, 0, 0}));
  EXPECT_EQ(space.origin, (Vector{11.5, 19, 28}));  // the affine's is the centre of voxel 0
  EXPECT_EQ(space.frame, "ras");
  failure(ErrorKind::kInput, [] {
    (void)space_of_affine({{{1, 0.5, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
  });
  const Space plain = space_of_affine({{{2, 0.6, 0, 5}, {0, 0.8, 0, 6}, {0, 0, 3, 7}}}, "voxel");
  EXPECT_EQ(plain.spacing, (Vector{2, 1, 3}));
  EXPECT_EQ(plain.origin, Vector{});
  for (const double bad : {0.0, std::nan("")}) {
    EXPECT_THAT(failure(ErrorKind::kInput,
                        [&] {
                          (void)space_of_affine({{{1, 0, 0, 0}, {0, bad, 0, 0}, {0, 0, 1, 0}}});
                        }),
                HasSubstr("affine: column 2"));
  }
  const std::array<std::array<double, 4>, 3> turned{
      {{0.6, -0.8, 0, 0}, {0.8, 0.6, 0, 0}, {0, 0, 1, 0}}};
  const Vector stated{1 + 1e-6, 1, 2};
  EXPECT_EQ(space_of_affine(turned, "own", stated).spacing, (Vector{1 + 1e-6, 1, 1}));
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THAT(failure(ErrorKind::kInput,
                        [&] {
                          (void)space_of_affine(turned, "own", Vector{1, bad, 1});
                        }),
                HasSubstr("spacing"));
  }
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)space_of_affine(turned, "x"); }),
              HasSubstr("expected own, ras, lps or voxel"));
}

/// Axes that are straight are not straightened again, or an array would have another mesh than the
/// file that it comes from.
TEST(LibrarySpace, OfAnArrayIsTheOneGiven) {
  const std::uint8_t voxel = 1;
  for (int i = 1; i < 300; ++i) {
    // A turn about z by one angle, then one about x by another.
    const double a = 0.37 * i, b = 1.91 * i;
    const Space space = space_of_affine(
        {{{0.8 * std::cos(a), -0.9 * std::sin(a), 0, 1},
          {0.8 * std::sin(a) * std::cos(b), 0.9 * std::cos(a) * std::cos(b), -1.2 * std::sin(b), 2},
          {0.8 * std::sin(a) * std::sin(b), 0.9 * std::cos(a) * std::sin(b), 1.2 * std::cos(b),
           3}}},
        "ras");
    const Space kept =
        Volume::of(ArrayVolume{.data = &voxel, .shape = {1, 1, 1}, .space = space}).space();
    EXPECT_EQ(kept.axes, space.axes) << i;
    EXPECT_EQ(kept.spacing, space.spacing) << i;
    EXPECT_EQ(kept.origin, space.origin) << i;
  }
}

TEST(LibraryErrors, AreWordedForCallers) {
  EXPECT_EQ(failure(ErrorKind::kInput, [] { (void)read_mesh("/nowhere/m.vtu"); }).find("mwmesh:"),
            std::string::npos);
  failure(ErrorKind::kUsage, [] { (void)Volume::of(ArrayVolume{.shape = {2, 2, 2}}); });
  failure(ErrorKind::kUsage, [] { (void)synth("cubes", {2, 2, 2}, 2, 1); });
  EXPECT_THROW((void)synth("noise", {1 << 20, 1 << 20, 1 << 20}, 2, 1), std::bad_alloc);
  const auto labels = grains();
  EXPECT_THAT(failure(ErrorKind::kUsage,
                      [&] {
                        (void)mesh(volume_of(labels), {{"keep_bytes", "9"}});
                      }),
              HasSubstr("keep_bytes: is the size of a folder"));
  EXPECT_THAT(failure(ErrorKind::kUsage,
                      [&] {
                        (void)mesh(volume_of(labels), {{"changed", "0,0,0,1,1,1"}});
                      }),
              StartsWith("changed: "));
}

TEST(LibraryErrors, AdviseWhatCanBeDoneToAnArray) {
  const auto labels = grains();
  ArrayVolume thin{.data = labels.data(), .type = VoxelType::kU64, .shape = kShape};
  thin.space = {.spacing = {1e-3, 1e-3, 1e3}};
  EXPECT_THAT(failure(ErrorKind::kInput, [&] { (void)mesh(Volume::of(thin)); }),
              HasSubstr("with crop, or slices of an array"));
}

TEST(LibraryErrors, NameTheOption) {
  const std::pair<const char*, const char*> bad[] = {
      {"certify", "maybe"}, {"parts", "0"},        {"split", "1"},       {"cohesive", "1"},
      {"sample", "a"},      {"materials", "hu=0"}, {"materials", "hu="}, {"materials", "hu=5:1:0"},
      {"cache", "/dir,x"},  {"merge", "1"},        {"deck", "dynamic"},  {"element", "tet5"}};
  for (const auto& [name, text] : bad) {
    try {
      (void)Options({{name, text}});
      ADD_FAILURE() << name << "=" << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
      EXPECT_EQ(error.option(), name);
      EXPECT_THAT(error.what(), StartsWith(name + std::string(":")));
    }
  }
}

/// A path that is called as an option is none, either.
TEST(LibraryErrors, NameNoOptionThatAPathBeginsWith) {
  for (const char* path : {"labels/missing.npy", "crop", "object: a.npy", "sample of names.npy"}) {
    try {
      (void)Volume::open(path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.option(), "") << path;
      EXPECT_THAT(error.what(), StartsWith(path));
    }
  }
}

TEST(LibraryErrors, NameTheOptionOfAJobToo) {
  const auto labels = grains();
  const std::pair<const char*, const char*> bad[] = {
      {"size", "999=3"}, {"keep_bytes", "9"}, {"labels", "99"}};
  for (const auto& [name, text] : bad) {
    try {
      (void)mesh(volume_of(labels), {{name, text}});
      ADD_FAILURE() << name << "=" << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.option(), name) << error.what();
    }
  }
}

TEST_F(LibraryPathsTest, FailsAsAnErrorWherePathsCannotBeLookedAt) {
  const std::string loop = folder() / "loop";
  std::filesystem::create_symlink(loop, loop);
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  for (const std::string& path : {(folder() / (std::string(300, 'a') + ".npy")).string(), loop}) {
    const auto expect_named = [&](ErrorKind kind, const std::function<void()>& work) {
      EXPECT_THAT(failure(kind, work), HasSubstr(path));
    };
    expect_named(ErrorKind::kInput, [&] { (void)Volume::open(path); });
    expect_named(ErrorKind::kInput, [&] { (void)mesh(volume, {{"sample", "a=" + path}}); });
    expect_named(ErrorKind::kUsage, [&] { (void)mesh(volume, {{"keep", path}}); });
    expect_named(ErrorKind::kUsage, [&] { (void)mesh(volume, {{"from", path}}); });
    expect_failure(3, "info '" + path + "'", path);
    try {
      (void)mesh(volume, {{"workdir", path}});
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(path));
    }
  }
}

TEST(LibraryErrors, ImagesWithoutAPlaceHaveTheVoxelsOfTheVolume) {
  const mw::test::TempFolder folder;
  // An array of NumPy of one voxel.
  std::string head = "{'descr': '|u1', 'fortran_order': False, 'shape': (1, 1, 1), }";
  head.resize(117, ' ');
  std::ofstream(folder.path() / "one.npy", std::ios::binary)
      << std::string("\x93NUMPY\x01\x00\x76\x00", 10) << head << "\n\x07";
  const auto labels = grains();
  const std::string sample = "a=" + (folder.path() / "one.npy").string();
  EXPECT_THAT(failure(ErrorKind::kInput,
                      [&] {
                        (void)mesh(volume_of(labels), {{"sample", sample}});
                      }),
              HasSubstr("has 1 x 1 x 1 voxels"));
}

}  // namespace
}  // namespace mwmesh
