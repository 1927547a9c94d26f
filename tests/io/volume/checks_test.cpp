// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where volumes lie: affines of files against voxel centres worked out by hand.
#include "io/volume/checks.h"

#include "io/volume/open_volume.h"
#include "tests/io/volume/sample_files.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

constexpr const char* kFile = "some.file";

double uniform(std::mt19937& random) {
  return static_cast<double>(random()) / 4294967296.0;
}

/// Steps along turned axes: rows of a random rotation, some mirrored, times a spacing.
std::array<Vector3, 3> random_steps(std::mt19937& random, const Vector3& spacing) {
  const double a = uniform(random) * 6.28, b = uniform(random) * 6.28, c = uniform(random) * 6.28;
  const std::array<Vector3, 3> turned{
      {{std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), -std::sin(b)},
       {std::cos(a) * std::sin(b) * std::sin(c) - std::sin(a) * std::cos(c),
        std::sin(a) * std::sin(b) * std::sin(c) + std::cos(a) * std::cos(c),
        std::cos(b) * std::sin(c)},
       {std::cos(a) * std::sin(b) * std::cos(c) + std::sin(a) * std::sin(c),
        std::sin(a) * std::sin(b) * std::cos(c) - std::cos(a) * std::sin(c),
        std::cos(b) * std::cos(c)}}};
  std::array<Vector3, 3> steps = turned;
  const double flip = random() % 2 == 0 ? 1 : -1;
  for (std::size_t i = 0; i < 3; ++i) {
    for (double& x : steps[i]) x *= spacing[i] * flip;
  }
  return steps;
}

TEST(FileSpace, CentresOfVoxelsLieWhereTheStepsLead) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    FileSpace file;
    const Vector3 spacing{0.25 + uniform(random), 0.25 + uniform(random), 5 * uniform(random)};
    file.steps = random_steps(random, spacing);
    file.first = Vector3{100 * uniform(random), -50 * uniform(random), uniform(random)};
    file.first_is_centre = round % 2 == 0;
    const VolumeSpace space = placed(kFile, file, {});
    const double half = file.first_is_centre ? 0.5 : 0;
    const std::array<double, 3> v{std::floor(9 * uniform(random)), std::floor(9 * uniform(random)),
                                  std::floor(9 * uniform(random))};
    const Vector3 at = to_world(space, {v[0] + half, v[1] + half, v[2] + half});
    for (std::size_t k = 0; k < 3; ++k) {
      double expected = (*file.first)[k];
      for (std::size_t i = 0; i < 3; ++i) expected += v[i] * file.steps[i][k];
      EXPECT_NEAR(at[k], expected, 1e-10);
      EXPECT_NEAR(space.spacing[k], spacing[k], 1e-12);
    }
    const Vector3 back = to_corner(space, at);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(back[i], v[i] + half, 1e-9);
    const auto& s = file.steps;
    const double determinant = s[0][0] * (s[1][1] * s[2][2] - s[1][2] * s[2][1]) -
                               s[0][1] * (s[1][0] * s[2][2] - s[1][2] * s[2][0]) +
                               s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0]);
    EXPECT_EQ(is_mirrored(space), determinant < 0);
  }
}

TEST(FileSpace, FlipsAndPermutationsAreExact) {
  FileSpace file{.steps = {{{0, 0, -0.3}, {0.7, 0, 0}, {0, -1.1, 0}}}, .first = Vector3{1, 2, 3}};
  const VolumeSpace space = placed(kFile, file, {});
  EXPECT_EQ(space.spacing, (Vector3{0.3, 0.7, 1.1}));
  EXPECT_EQ(space.axes, (std::array<Vector3, 3>{{{0, 0, -1}, {1, 0, 0}, {0, -1, 0}}}));
  EXPECT_EQ(space.origin, (Vector3{1 - 0.7 * 0.5, 2 + 1.1 * 0.5, 3 + 0.3 * 0.5}));
  EXPECT_FALSE(is_upright(space));
}

TEST(FileSpace, StatedLengthsAreTakenWhereTheyAgree) {
  FileSpace file{.steps = {{{0.6000001, 0.8, 0}, {-1.6, 1.2, 0}, {0, 0, 3}}},
                 .lengths = Vector3{1, 2.1, 3}};
  EXPECT_EQ(placed(kFile, file, {}).spacing, (Vector3{1, 2, 3}));
}

TEST(FileSpace, AFileThatPlacesNothingBeginsAtZero) {
  const VolumeSpace space = placed(kFile, {.steps = steps_of({2, 3, 4})}, {});
  EXPECT_EQ(space.origin, (Vector3{0, 0, 0}));
  EXPECT_TRUE(is_upright(space));
  EXPECT_EQ(to_world(space, {1, 1, 1}), (Vector3{2, 3, 4}));
}

TEST(FileSpace, TheOptionsReplaceWhatTheFileSays) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  FileSpace file{.steps = steps_of({nan, 0, 3}), .first = Vector3{nan, 0, 0}, .unit = "mm"};
  OpenOptions options;
  options.spacing = {1, 2, 3};
  options.origin = {7, 8, 9};
  const VolumeSpace space = placed(kFile, file, options);
  EXPECT_EQ(space.spacing, *options.spacing);
  EXPECT_EQ(space.origin, *options.origin);
  EXPECT_EQ(space.unit, "");  // the caller's numbers need not be in the file's
  options.origin.reset();
  expect_error(ErrorKind::kInput, {kFile, "origin", "--origin"},
               [&] { static_cast<void>(placed(kFile, file, options)); });
  // The centre of the first voxel stays where the file has it.
  file.first = Vector3{10, 10, 10};
  EXPECT_EQ(placed(kFile, file, options).origin, (Vector3{9.5, 9, 8.5}));
}

TEST(FileSpace, OneImageInTwoFramesIsInOnePlace) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    FileSpace ras{.steps = random_steps(random, {1, 2, 3}), .first = Vector3{4, 5, 6}};
    FileSpace lps = ras;
    ras.frame = WorldFrame::kRas;
    lps.frame = WorldFrame::kLps;
    for (const std::size_t k : {0U, 1U}) {
      for (Vector3& step : lps.steps) step[k] = -step[k];
      (*lps.first)[k] = -(*lps.first)[k];
    }
    OpenOptions in_ras, in_lps;
    in_ras.frame = FrameChoice::kRas;
    in_lps.frame = FrameChoice::kLps;
    for (const OpenOptions& options : {in_ras, in_lps}) {
      const VolumeSpace a = placed(kFile, ras, options), b = placed(kFile, lps, options);
      EXPECT_EQ(a.frame, b.frame);
      const Vector3 p = to_world(a, {1, 2, 3}), q = to_world(b, {1, 2, 3});
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(p[k], q[k], 1e-12);
    }
    EXPECT_EQ(placed(kFile, lps, {}).frame, WorldFrame::kLps);
  }
}

TEST(FileSpace, VoxelFrameKeepsNothingButTheSpacing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  OpenOptions options;
  options.frame = FrameChoice::kVoxel;
  const FileSpace sheared{.steps = {{{1, 0, 0}, {3, 4, 0}, {0, 0, 2}}},
                          .first = Vector3{nan, 1, 1},
                          .frame = WorldFrame::kRas};
  const VolumeSpace space = placed(kFile, sheared, options);
  EXPECT_EQ(space.spacing, (Vector3{1, 5, 2}));
  EXPECT_EQ(space.origin, (Vector3{0, 0, 0}));
  EXPECT_TRUE(is_upright(space));
  EXPECT_EQ(space.frame, WorldFrame::kOwn);
}

TEST(FileSpace, RefusesWhatCannotBePromised) {
  const auto refuse = [](const FileSpace& file, std::vector<std::string> pieces) {
    pieces.emplace_back(kFile);
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(placed(kFile, file, {})); });
  };
  refuse({.steps = {{{1, 0, 0}, {0.001, 1, 0}, {0, 0, 1}}}}, {"right angles", "--frame voxel"});
  refuse({.steps = {{{1, 0, 0}, {0, 1, 0}, {0, 0.1, 1}}}}, {"y and z", "right angles"});
  refuse({.steps = steps_of({1, 0, 1})}, {"spacing (y)", "--spacing"});
  const double infinite = std::numeric_limits<double>::infinity();
  refuse({.steps = steps_of({1, 1, infinite})}, {"spacing (z)"});
  OpenOptions options;
  options.frame = FrameChoice::kLps;
  expect_error(ErrorKind::kUsage, {"--frame lps", kFile, "--frame file"},
               [&] { static_cast<void>(placed(kFile, {}, options)); });
}

TEST(FileSpace, AxesOffByRoundingAreStraightened) {
  FileSpace file{.steps = {{{1, 2e-6, 0}, {0, 1, 3e-6}, {-1e-6, 0, 1}}}};
  const VolumeSpace space = placed(kFile, file, {});
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double dot = 0;
      for (std::size_t k = 0; k < 3; ++k) dot += space.axes[i][k] * space.axes[j][k];
      EXPECT_NEAR(dot, i == j ? 1 : 0, 1e-15);
    }
    EXPECT_NEAR(space.axes[i][i], 1, 1e-10);
  }
}

/// The centre of voxel (1, 2, 2) of a NIfTI sample.
Vector3 centre_of(const TempDir& dir, const NiftiSample& sample) {
  const auto path = dir.file("a.nii", sample.header() + std::string(60, 'a'));
  return to_world(open_volume(path)->info().space, {1.5, 2.5, 2.5});
}

TEST(NiftiSpace, SformThenQformThenPixdim) {
  const TempDir dir;
  for (const int version : {1, 2}) {
    NiftiSample sample{.version = version, .magic = {}};
    const auto expect_centre = [&](const Vector3& expected) {
      const Vector3 centre = centre_of(dir, sample);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(centre[k], expected[k], 1e-5) << version;
    };
    // Neither: the centre of the first voxel is at 0.
    expect_centre({0.5, 4, 6});
    const auto space = [&] { return open_volume(dir.path() / "a.nii")->info().space; };
    EXPECT_EQ(space().frame, WorldFrame::kOwn);
    // A quarter turn about z: x goes along y, y against x; then the third axis turned round.
    sample.qform_code = 1;
    sample.quaternion = {0, 0, std::sqrt(0.5)};
    sample.pixdim[0] = 1;
    expect_centre({-1 - 4, -2 + 0.5, -3 + 6});
    sample.pixdim[0] = -1;
    expect_centre({-1 - 4, -2 + 0.5, -3 - 6});
    EXPECT_EQ(space().frame, WorldFrame::kRas);
    // Half a turn about x, where a is 0: y and z point the other way.
    sample.quaternion = {1, 0, 0};
    sample.pixdim[0] = 0;
    expect_centre({-1 + 0.5, -2 - 4, -3 - 6});
    sample.sform_code = 2;
    sample.matrix = {{{0, 0, -3}, {0.5, 0, 0}, {0, 2, 0}}};
    expect_centre({10 - 6, 20 + 0.5, 30 + 4});
    if (version == 1) {
      sample.matrix = {{{0, 0, -3}, {0.3, 0, 0}, {0, 2, 0}}};
      static_cast<void>(centre_of(dir, sample));
      EXPECT_EQ(space().spacing[0], 0.3) << "not the float nearest to it";
    }
    sample.xyzt_units = 2 + 8;
    static_cast<void>(centre_of(dir, sample));
    EXPECT_EQ(space().unit, "mm");
  }
}

/// A file that another program has saved again states lengths as sums of floats, or none.
TEST(NiftiSpace, LengthsOfATurnedSformDoNotDependOnWhatIsStated) {
  const TempDir dir;
  std::mt19937 random(3520);
  for (int i = 0; i < 50; ++i) {
    const auto digits = [&] { return 0.1 + static_cast<double>(random() % 900000) / 1e6; };
    const Vector3 spacing = i == 0 ? Vector3{1.2, 1.2, 3} : Vector3{digits(), digits(), digits()};
    NiftiSample sample{.sform_code = 1, .magic = {}};
    const std::array<Vector3, 3> steps = random_steps(random, spacing);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) sample.matrix[k][axis] = steps[axis][k];
    }
    for (const double stated : {1.0, 1 - 1e-7, 1 + 1.5e-7, 0.0}) {
      for (std::size_t axis = 0; axis < 3; ++axis) sample.pixdim[axis + 1] = spacing[axis] * stated;
      const auto path = dir.file("a.nii", sample.header() + std::string(60, 'a'));
      const Vector3 read = open_volume(path)->info().space.spacing;
      for (std::size_t k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(read[k], spacing[k]) << stated;
    }
  }
}

TEST(NiftiSpace, AnSformWithoutVolumeGivesWayToTheQform) {
  const TempDir dir;
  NiftiSample sample{.qform_code = 1, .sform_code = 1, .magic = {}};
  sample.pixdim = {1, 0.5, 2, 3};
  sample.quaternion = {0, 0, std::sqrt(0.5)};
  const std::array<std::array<double, 3>, 3> nothing{};
  const std::vector<std::array<std::array<double, 3>, 3>> singular{
      nothing, {{{0.5, 0, 0}, {0, 2, 0}, {0, 0, 0}}}, {{{1, 1, 0}, {1, 1, 0}, {0, 0, 3}}}};
  for (const auto& matrix : singular) {
    sample.matrix = matrix;
    const auto path = dir.file("a.nii", sample.header() + std::string(60, 'a'));
    for (const OpenOptions& options :
         {OpenOptions{}, OpenOptions{.spacing = std::array{0.5, 2.0, 3.0}}}) {
      const auto volume = open_volume(path, options);
      const VolumeSpace& space = volume->info().space;
      EXPECT_EQ(space.frame, WorldFrame::kRas);
      EXPECT_NEAR(space.axes[0][1], 1, 1e-6);
      EXPECT_NEAR(to_world(space, {0.5, 0.5, 0.5})[2], -3, 1e-6);
      EXPECT_NE(volume->info().note.find("qform"), std::string::npos);
    }
  }
  sample.qform_code = 0;
  sample.matrix = nothing;
  const auto path = dir.file("a.nii", sample.header() + std::string(60, 'a'));
  expect_not_opened(path, {"sform", "--spacing"});
  const auto volume = open_volume(path, {.spacing = std::array{0.5, 2.0, 3.0}});
  EXPECT_EQ(volume->info().space.frame, WorldFrame::kOwn) << "nothing says where right is";
}

TEST(NiftiSpace, FormsThatDifferAreTold) {
  const TempDir dir;
  for (const int version : {1, 2}) {
    NiftiSample sample{.version = version, .qform_code = 1, .sform_code = 2, .magic = {}};
    sample.pixdim = {1, 0.5, 2, 3};
    sample.qoffset = sample.translation;
    const auto open = [&](const OpenOptions& options = {}) {
      return open_volume(dir.file("a.nii", sample.header() + std::string(60, 'a')), options);
    };
    const auto first_x = [&](const OpenOptions& options) {
      return to_world(open(options)->info().space, {0.5, 0.5, 0.5})[0];
    };
    EXPECT_EQ(open()->info().note, "");
    sample.qoffset[0] += 0.02;  // below a tenth of a voxel
    EXPECT_EQ(open()->info().note, "");
    sample.qoffset[0] = -2;
    const std::string note = open()->info().note;
    EXPECT_NE(note.find("10,20,30 by the sform"), std::string::npos) << note;
    EXPECT_NE(note.find("-2,20,30 by the qform"), std::string::npos) << note;
    EXPECT_NE(note.find("24 voxels"), std::string::npos) << note;
    for (const OpenOptions& options :
         {OpenOptions{.frame = FrameChoice::kVoxel}, OpenOptions{.form = FormChoice::kSform},
          OpenOptions{.form = FormChoice::kQform}}) {
      EXPECT_EQ(open(options)->info().note, "");
    }
    EXPECT_NEAR(first_x({}), 10, 1e-5);
    EXPECT_NEAR(first_x({.form = FormChoice::kSform}), 10, 1e-5);
    EXPECT_NEAR(first_x({.form = FormChoice::kQform}), -2, 1e-5);
    // A turn about the first voxel moves the last ones alone.
    sample.qoffset = sample.translation;
    sample.quaternion = {0, 0, 0.05};
    EXPECT_NE(open()->info().note.find("differ"), std::string::npos);
    sample.quaternion = {2, 0, 0};  // no rotation
    EXPECT_EQ(open()->info().note, "");
  }
}

TEST(NiftiSpace, TheFormMayBeChosen) {
  const TempDir dir;
  NiftiSample sample{.qform_code = 1, .sform_code = 4, .magic = {}};
  sample.pixdim = {1, 0.5, 2, 3};
  sample.matrix = {{{0.5, 0.2, 0}, {0, 2, 0}, {0, 0, 3}}};  // sheared
  const auto write = [&] { return dir.file("a.nii", sample.header() + std::string(60, 'a')); };
  expect_not_opened(write(), {"sform", "right angles", "qform", "--use-form qform"});
  EXPECT_EQ(open_volume(write(), {.form = FormChoice::kQform})->info().space.frame,
            WorldFrame::kRas);
  sample.qform_code = 0;
  expect_not_opened(write(), {"sform", "right angles", "resample"});
  expect_misused(write(), {.form = FormChoice::kQform}, {"--use-form qform", "no qform"});
  sample.qform_code = 1, sample.sform_code = 0;
  expect_misused(write(), {.form = FormChoice::kSform}, {"--use-form sform", "no sform"});
  expect_misused(dir.file("a.mha", "ObjectType = Image\n"), {.form = FormChoice::kSform},
                 {"--use-form", "MetaImage", "NIfTI"});
}

TEST(NiftiSpace, AQuaternionLongerThanOneIsNoRotation) {
  const TempDir dir;
  NiftiSample sample{.qform_code = 1, .magic = {}};
  const auto open = [&](std::array<double, 3> quaternion, const OpenOptions& options = {}) {
    sample.quaternion = quaternion;
    return open_volume(dir.file("a.nii", sample.header() + std::string(60, 'a')), options);
  };
  for (const double rounded : {0.70711, 0.7071068}) {
    EXPECT_EQ(open({0, rounded, rounded})->info().space.frame, WorldFrame::kRas);
  }
  for (const double part : {0.6, 0.8, 1.2}) {
    const std::array longer{part, part, part};
    expect_error(ErrorKind::kInput, {"a.nii", "quatern_b", "at most 1", "--frame voxel"},
                 [&] { static_cast<void>(open(longer)); });
    EXPECT_NO_THROW(static_cast<void>(open(longer, {.frame = FrameChoice::kVoxel})));
  }
}

TEST(NrrdSpace, FramesAndUnits) {
  const TempDir dir;
  const auto space_of = [&](const std::string& fields) {
    const auto path = dir.file("a.nrrd",
                               "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n"
                               "space directions: (0,2,0) (1,0,0) (0,0,-1)\n"
                               "space origin: (10,20,30)\n" +
                                   fields + "\nAB");
    return open_volume(path)->info().space;
  };
  const VolumeSpace lps =
      space_of("space: left-posterior-superior\nspace units: \"mm\" \"mm\" \"mm\"\n");
  EXPECT_EQ(lps.frame, WorldFrame::kLps);
  EXPECT_EQ(lps.unit, "mm");
  EXPECT_EQ(to_world(lps, {1.5, 0.5, 0.5}), (Vector3{10, 22, 30}));
  const VolumeSpace ras = space_of("space: RAS\n");
  EXPECT_EQ(ras.frame, WorldFrame::kRas);
  EXPECT_EQ(ras.unit, "");
  const VolumeSpace las = space_of("space: left-anterior-superior\n");
  EXPECT_EQ(las.frame, WorldFrame::kRas);
  EXPECT_EQ(to_world(las, {0.5, 0.5, 0.5}), (Vector3{-10, 20, 30}));
  EXPECT_EQ(space_of("").frame, WorldFrame::kOwn);
}

std::string nrrd_with(const std::string& fields) {
  return "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n" + fields + "\nAB";
}

TEST(NrrdSpace, AxesOfSeveralUnitsAreRefused) {
  const TempDir dir;
  const std::string spacings = "spacings: 1 2 4\n";
  for (const char* field :
       {"space units: \"mm\" \"mm\" \"um\"\n", "units: \"mm\" \"cm\" \"mm\"\n"}) {
    const auto path = dir.file("a.nrrd", nrrd_with(spacings + field));
    expect_not_opened(path, {"a.nrrd", "space units", "different", "--spacing"});
    EXPECT_EQ(open_volume(path, {.spacing = std::array{1.0, 2.0, 3.0}})->info().space.unit, "");
  }
  const auto unknown = dir.file("b.nrrd", nrrd_with(spacings + "units: \"mm\" \"mm\" \"\"\n"));
  EXPECT_EQ(open_volume(unknown)->info().space.unit, "");
}

TEST(NrrdSpace, AxisMinsAndMaxsAreTheEndsOfAxes) {
  const TempDir dir;
  const auto space = [&](const std::string& fields) {
    const auto path = dir.file("a.nrrd",
                               "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 2 5 1\n"
                               "encoding: raw\n" +
                                   fields + "\nABCDEFGHIJ");
    return open_volume(path)->info().space;
  };
  const std::string ends = "axis mins: 10 20 30\naxis maxs: 14 40 33\n";
  const VolumeSpace cells = space(ends);
  EXPECT_EQ(cells.origin, (Vector3{10, 20, 30}));
  EXPECT_EQ(cells.spacing, (Vector3{2, 4, 3}));
  const VolumeSpace nodes = space(ends + "centers: node node cell\n");
  EXPECT_EQ(nodes.spacing, (Vector3{4, 5, 3}));
  EXPECT_EQ(nodes.origin, (Vector3{8, 17.5, 30}));
  EXPECT_EQ(space(ends + "spacings: 1 1 1\n").spacing, (Vector3{1, 1, 1}));
  EXPECT_EQ(space("axis mins: 10 20 30\n").spacing, (Vector3{1, 1, 1}));
}

TEST(NrrdSpace, AxisMinsAreWhereTheVolumeBegins) {
  const TempDir dir;
  const auto origin = [&](const std::string& fields) {
    const auto path = dir.file("a.nrrd", nrrd_with("spacings: 1 2 4\n" + fields));
    return open_volume(path)->info().space.origin;
  };
  const std::string mins = "axis mins: 10 20 30\n";
  EXPECT_EQ(origin(mins), (Vector3{10, 20, 30}));
  EXPECT_EQ(origin(mins + "centers: cell cell cell\n"), (Vector3{10, 20, 30}));
  EXPECT_EQ(origin(mins + "centerings: node node node\n"), (Vector3{9.5, 19, 28}));
  EXPECT_EQ(origin(mins + "centers: cell node ???\n"), (Vector3{10, 19, 30}));
  EXPECT_EQ(origin("axis mins: nan nan nan\n"), origin(""));
  EXPECT_EQ(origin(mins + "space origin: (1,2,3)\n"), (Vector3{0.5, 1, 1}));
  expect_not_opened(dir.file("a.nrrd", nrrd_with("spacings: 1 1 1\naxis mins: 1 nan 1\n")),
                    {"axis mins", "--origin"});
}

}  // namespace
}  // namespace mw::io
