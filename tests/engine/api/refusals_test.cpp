// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Settings, numbers, places and paths: what the library takes, and how it words what it refuses.
#include <gmock/gmock.h>

#include "engine/api/guarded.h"
#include "tests/engine/api/library.h"
#include "tests/engine/cli/run_program.h"

namespace mwmesh {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::StartsWith;

using LibraryPathsTest = mw::cli::ProgramTest;

TEST(LibrarySettings, AreThoseOfTheProgram) {
  Settings settings;
  for (const SettingInfo& info : Settings::all()) {
    EXPECT_EQ(settings.get(info.name), info.fallback) << info.name;
    EXPECT_EQ(info.name.find('-'), std::string::npos);
    EXPECT_EQ(info.help.find("--"), std::string::npos) << info.help;
  }
  EXPECT_EQ(settings.set("max_distance", "none").get("max_distance"), "none");
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { settings.set("max_distanse", "1"); }),
              HasSubstr("did you mean max_distance?"));
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { settings.set("prest", "fine"); }),
              HasSubstr("did you mean preset?"));
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { settings.set("zzzz", "1"); }),
              HasSubstr("there are preset, window"));
  const auto refusal = [&](const char* name, const char* text) {
    return failure(ErrorKind::kUsage, [&] { settings.set(name, text); });
  };
  EXPECT_EQ(refusal("window", "5"), "window: must be an even number from 4 to 256");
  EXPECT_EQ(refusal("quality_floor", "1"), "quality_floor: must be from 0 to 0.5");
  EXPECT_EQ(refusal("surface", "smoth"), "surface: expected one of smooth, voxel, got 'smoth'");
  EXPECT_THAT(refusal("preset", "quick"), HasSubstr("preset: "));
  EXPECT_EQ(settings.changed().size(), 1U);
}

TEST(LibraryNumbers, AreRefusedAsByTheProgram) {
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  for (const int threads : {-1, 1025, 30'000, 1'000'000'000}) {
    for (const bool verified : {false, true}) {
      const std::string message = failure(ErrorKind::kUsage, [&] {
        if (verified) (void)verify({}, volume, {.threads = threads});
        (void)mesh(volume, {}, {.threads = threads});
      });
      EXPECT_EQ(message, "threads must be from 1 to 1024, or 0 for all cores");
    }
  }
  ArrayVolume array{.data = labels.data(), .type = VoxelType::kU64, .shape = kShape};
  for (const double bad : {-1.0, 0.0, std::nan(""), HUGE_VAL}) {
    array.space = {.spacing = {1, bad, 1}};
    EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)Volume::of(array); }), HasSubstr("spacing"));
    EXPECT_THAT(failure(ErrorKind::kUsage,
                        [&] { (void)Volume::open({.path = "v", .spacing = array.space.spacing}); }),
                HasSubstr("spacing"));
  }
  array.space = {.origin = {0, 0, std::nan("")}};
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)Volume::of(array); }), HasSubstr("origin"));
  array.space = {.axes = {{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)Volume::of(array); }), HasSubstr("axes"));
  EXPECT_THAT(failure(ErrorKind::kUsage, [] { (void)Volume::open({.path = "v", .scale = -1}); }),
              HasSubstr("scale"));
  RegionVolume region{.shape = kShape, .chunk = {8, -8, 8}};
  region.read = [](const Box&, std::span<std::uint64_t>) {};
  EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)Volume::of(region); }), HasSubstr("chunk"));
  std::vector<std::uint64_t> out(8);
  failure(ErrorKind::kUsage, [&] { volume.read({{21, 0, 0}, {23, 2, 2}}, out); });
  failure(ErrorKind::kUsage, [&] { volume.read({{0, 0, 0}, {3, 2, 2}}, out); });
  failure(ErrorKind::kUsage, [] { (void)picture({}, 15, 900); });
}

#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wmissing-field-initializers"

TEST(Library, MembersThatAreNotNamedDoNotWarn) {
  EXPECT_EQ(Options{.threads = 2}.merge.size(), 0U);
  EXPECT_FALSE(Hooks{.cancel = [] { return false; }}.progress);
  EXPECT_FALSE(Hooks{.progress = [](const Progress&) {}}.cancel);
  EXPECT_EQ(Progress{.done = 1}.seconds_left, std::nullopt);
  EXPECT_EQ(LabelName{.label = 1}.name, "");
  EXPECT_EQ((Box{.lo = {1, 1, 1}}.hi), Index{});
  EXPECT_EQ((Space{.spacing = {1, 1, 2}}.frame), "own");
  EXPECT_EQ(VolumeFile{.dataset = "a"}.path, "");
  EXPECT_EQ((ArrayVolume{.shape = {1, 1, 1}}.data), nullptr);
  EXPECT_FALSE((RegionVolume{.shape = {1, 1, 1}}.read));
  EXPECT_EQ(FileOptions{.deck = true}.element, "tet4");
  EXPECT_TRUE(Mesh{.points = {}}.tets.empty());
  EXPECT_TRUE(Wedges{.rows = {}}.labels.empty());
  EXPECT_FALSE(Check{.name = "a"}.passed);
  EXPECT_FALSE(Verdict{.report = "a"}.passed);
  EXPECT_EQ(SettingInfo{.name = "a"}.help, "");
}

#pragma GCC diagnostic pop

TEST(LibraryNumbers, PathsHaveNoZeroByte) {
  const std::string path("a\0b", 3);
  const auto labels = grains();
  failure(ErrorKind::kUsage, [&] { (void)Volume::open({.path = path}); });
  failure(ErrorKind::kUsage, [&] { (void)read_names(path); });
  failure(ErrorKind::kUsage, [&] { (void)read_mesh(path); });
  failure(ErrorKind::kUsage, [&] { write_mesh({}, path); });
  failure(ErrorKind::kUsage, [&] { mesh_to_file(path, volume_of(labels)); });
  failure(ErrorKind::kUsage, [&] { (void)mesh(volume_of(labels), {}, {.workdir = path}); });
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
  EXPECT_EQ(mw::api::library_words("--max-distance: must be 0 -- or none (--surface voxel)"),
            "max_distance: must be 0 -- or none (surface voxel)");
  EXPECT_EQ(mw::api::library_words("a--b --"), "a--b --");
  EXPECT_EQ(failure(ErrorKind::kInput, [] { (void)read_mesh("/nowhere/m.vtu"); }).find("mwmesh:"),
            std::string::npos);
  failure(ErrorKind::kUsage, [] { (void)Volume::of(ArrayVolume{.shape = {2, 2, 2}}); });
  failure(ErrorKind::kUsage, [] { (void)synth("cubes", {2, 2, 2}, 2, 1); });
  failure(ErrorKind::kResource, [] { (void)synth("noise", {1 << 20, 1 << 20, 1 << 20}, 2, 1); });
  EXPECT_EQ(mw::api::library_words("go on by --from, or (--from)"),
            "go on by from_kept, or (from_kept)");
  for (const char* command : {"with gdcmconv --raw", "'mwmesh convert --pieces N'",
                              "raw files with --shape and --dtype", "text (--ascii)"}) {
    EXPECT_EQ(mw::api::library_words(command), command);
  }
  const auto labels = grains();
  EXPECT_THAT(
      failure(ErrorKind::kUsage, [&] { (void)mesh(volume_of(labels), {}, {.keep_bytes = 9}); }),
      HasSubstr("keep_bytes: is the size of a folder"));
  EXPECT_THAT(
      failure(ErrorKind::kUsage, [&] { (void)mesh(volume_of(labels), {}, {.from_kept = true}); }),
      HasSubstr("from_kept: needs the folder"));
}

TEST(LibraryErrors, AdviseWhatCanBeDoneToAnArray) {
  const auto labels = grains();
  const Settings periodic = Settings().set("periodic", "z");
  EXPECT_THAT(failure(ErrorKind::kUsage,
                      [&] {
                        (void)mesh(volume_of(labels, {22, 18, 19}), periodic);
                      }),
              HasSubstr("crop it, slice an array"));
  ArrayVolume thin{.data = labels.data(), .type = VoxelType::kU64, .shape = kShape};
  thin.space = {.spacing = {1e-3, 1e-3, 1e3}};
  EXPECT_THAT(failure(ErrorKind::kInput, [&] { (void)mesh(Volume::of(thin)); }),
              HasSubstr("with crop, or slices of an array"));
}

TEST(LibraryErrors, NameTheOption) {
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  const std::pair<const char*, Options> runs[] = {
      {"certify: is none", {.certify = static_cast<Certify>(9)}},
      {"parts: expected", {.parts = "0"}},
      {"split: expected", {.split = "1|x"}},
      {"cohesive: expected", {.cohesive = "1"}},
      {"sample: expected", {.sample = "a"}},
      {"object: the volume has no", {.object = {99}}}};
  for (const auto& [start, options] : runs) {
    EXPECT_THAT(failure(ErrorKind::kUsage, [&] { (void)mesh(volume, {}, options); }),
                StartsWith(start));
  }
  for (const char* materials : {"hu=0", "hu=", "hu=5:1:0"}) {
    EXPECT_THAT(
        failure(ErrorKind::kUsage, [&] { write_mesh({}, "m.inp", {.materials = materials}); }),
        StartsWith("materials: "));
  }
  EXPECT_THAT(
      failure(ErrorKind::kUsage, [] { (void)Volume::open({.path = "v", .cache = "/dir,x"}); }),
      StartsWith("cache: expected a size"));
}

TEST_F(LibraryPathsTest, FailsAsAnErrorWherePathsCannotBeLookedAt) {
  const std::string loop = folder() / "loop";
  std::filesystem::create_symlink(loop, loop);
  const auto labels = grains();
  const Volume volume = volume_of(labels);
  const Settings colour = Settings().set("order", "colour");
  for (const std::string& path : {(folder() / (std::string(300, 'a') + ".npy")).string(), loop}) {
    const auto expect_named = [&](ErrorKind kind, const std::function<void()>& work) {
      EXPECT_THAT(failure(kind, work), HasSubstr(path));
    };
    expect_named(ErrorKind::kInput, [&] { (void)Volume::open({.path = path}); });
    expect_named(ErrorKind::kInput, [&] { (void)mesh(volume, {}, {.sample = "a=" + path}); });
    expect_named(ErrorKind::kUsage, [&] { (void)mesh(volume, colour, {.keep = path}); });
    expect_named(ErrorKind::kUsage,
                 [&] { (void)mesh(volume, colour, {.keep = path, .from_kept = true}); });
    expect_failure(3, "info '" + path + "'", path);
    try {
      (void)mesh(volume, {}, {.workdir = path});
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
  EXPECT_THAT(
      failure(ErrorKind::kInput, [&] { (void)mesh(volume_of(labels), {}, {.sample = sample}); }),
      HasSubstr("has 1 x 1 x 1 voxels"));
}

}  // namespace
}  // namespace mwmesh
