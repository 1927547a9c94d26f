// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which data set of an HDF5 file is read, its axes, and where it lies.
#include "io/volume/hdf5/description.h"
#include "io/volume/open_volume.h"
#include "tests/io/volume/hdf5/hdf5_files.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

using Vector = std::array<double, 3>;

const Hdf5Sample kFloats{.type = VoxelType::kF32};
const Hdf5Sample kOther{.shape = {6, 7, 8}, .type = VoxelType::kU8};

OpenOptions named(const std::string& path) {
  OpenOptions options;
  options.dataset = path;
  return options;
}

class Hdf5Conventions : public ::testing::Test {
 protected:
  /// A new file.
  [[nodiscard]] Hdf5Handle create() const { return create_hdf5(path_); }
  static void add(const Hdf5Handle& file, const std::string& path, const Hdf5Sample& sample) {
    write_data_set(file, path, sample, labels_of(sample));
  }
  void expect_refused(const std::vector<std::string>& pieces, const OpenOptions& options = {}) {
    expect_not_opened(path_, pieces, options);
  }

  TempDir dir_;
  std::filesystem::path path_ = dir_.path() / "a.h5";
};

TEST_F(Hdf5Conventions, Cremi) {
  {
    const Hdf5Handle file = create();
    add(file, "/volumes/raw", kOther);
    add(file, "/volumes/labels/clefts", kOther);
    add(file, "/volumes/labels/neuron_ids", {});
    write_attribute(file, "/volumes/labels/neuron_ids", "resolution", {40, 4, 8});
    write_attribute(file, "/volumes/labels/neuron_ids", "offset", {400, 16, -32});
  }
  const auto volume = open_volume(path_);
  EXPECT_EQ(volume->info().shape, (Index3{5, 4, 3}));
  EXPECT_EQ(volume->info().space.spacing, (Vector{8, 4, 40}));
  EXPECT_EQ(volume->info().space.origin, (Vector{-32, 16, 400}));
  EXPECT_EQ(volume->info().space.unit, "nm");
  EXPECT_EQ(open_volume(path_, named("volumes/labels/clefts"))->info().shape, (Index3{8, 7, 6}));
  EXPECT_EQ(open_volume(path_, named("/volumes/labels/"))->info().shape, (Index3{5, 4, 3}));
}

TEST_F(Hdf5Conventions, TheOnlyLabelsOfCremi) {
  {
    const Hdf5Handle file = create();
    add(file, "/volumes/raw", kOther);
    add(file, "/volumes/labels/ids", {});
    add(file, "/volumes/labels/probabilities", kFloats);
  }
  EXPECT_EQ(open_volume(path_)->info().shape, (Index3{5, 4, 3}));
}

TEST_F(Hdf5Conventions, IlastikAxes) {
  const auto tags = [](const std::string& keys) {
    std::string json = R"({"axes": [)";
    for (const char key : keys) {
      json += std::string(json.back() == '[' ? "" : ", ") + R"({"key": ")" + key +
              R"(", "typeFlags": 2, "resolution": 0, "description": ""})";
    }
    return json + "]}";
  };
  const std::vector<std::pair<std::string, std::vector<hsize_t>>> arrays{
      {"tzyxc", {1, 3, 4, 5, 1}}, {"zyxc", {3, 4, 5, 1}}, {"xyz", {5, 4, 3}},
      {"cxyzt", {1, 5, 4, 3, 1}}, {"zcyx", {3, 1, 4, 5}}, {"yxz", {4, 5, 3}}};
  for (const auto& [keys, shape] : arrays) {
    for (const bool chunked : {false, true}) {
      SCOPED_TRACE(keys);
      Hdf5Sample sample{.shape = shape, .layout = chunked ? H5D_CHUNKED : H5D_CONTIGUOUS};
      if (chunked) sample.chunk.assign(shape.size(), 2);
      for (std::size_t d = 0; chunked && d < shape.size(); ++d) {
        sample.chunk[d] = std::min<hsize_t>(2, shape[d]);
      }
      const auto stored = labels_of(sample);
      {
        const Hdf5Handle file = create();
        add(file, "/exported_data", sample);
        add(file, "/other", kOther);
        write_text_attribute(file, "/exported_data", "axistags", tags(keys), chunked);
        write_attribute(file, "/exported_data", "element_size_um", {0.5, 0.25, 0.125});
      }
      if (keys == "yxz" && !chunked) {
        expect_refused({"/exported_data", "order z, y, x"});
        continue;
      }
      const auto volume = open_volume(path_);
      EXPECT_EQ(volume->info().shape, (Index3{5, 4, 3}));
      EXPECT_EQ(volume->info().space.spacing, (Vector{0.125, 0.25, 0.5}));
      EXPECT_EQ(volume->info().space.unit, "um");
      const auto labels = read_all(*volume);
      std::map<char, std::size_t> at;
      for (std::size_t i = 0; i < stored.size(); ++i) {
        std::size_t rest = i;
        for (std::size_t d = shape.size(); d-- > 0; rest /= shape[d]) at[keys[d]] = rest % shape[d];
        ASSERT_EQ(labels[(at['z'] * 4 + at['y']) * 5 + at['x']], stored[i]) << i;
      }
    }
  }
}

TEST_F(Hdf5Conventions, IlastikResolution) {
  const auto space_of = [&](double z, double y, double x, bool has_size) {
    {
      const Hdf5Handle file = create();
      add(file, "/exported_data", {.shape = {3, 4, 5, 1}});
      const auto axis = [](char key, double resolution) {
        return std::string(R"({"key": ")") + key + R"(", "resolution": )" +
               std::to_string(resolution) + "}";
      };
      write_text_attribute(file, "/exported_data", "axistags",
                           R"({"axes": [)" + axis('z', z) + ", " + axis('y', y) + ", " +
                               axis('x', x) + R"(, {"key": "c"}]})",
                           false);
      if (has_size) write_attribute(file, "/exported_data", "element_size_um", {4, 2, 1});
    }
    return open_volume(path_)->info().space;
  };
  EXPECT_EQ(space_of(0.5, 0.25, 0.125, false).spacing, (Vector{0.125, 0.25, 0.5}));
  EXPECT_TRUE(space_of(0.5, 0.25, 0.125, false).is_sized);
  EXPECT_EQ(space_of(0.5, 0.25, 0.125, true).spacing, (Vector{1, 2, 4}));  // which has a unit
  EXPECT_EQ(space_of(0, 0.25, 0.125, false).spacing, (Vector{1, 1, 1}));
  EXPECT_FALSE(space_of(0, 0.25, 0.125, false).is_sized);
}

TEST_F(Hdf5Conventions, SpacingThatIsTheSameInEveryOrder) {
  const auto spacing_of = [&](const std::vector<double>& told) {
    {
      const Hdf5Handle file = create();
      add(file, "/labels", {});
      write_attribute(file, "/labels", "spacing", told);
    }
    return open_volume(path_)->info().space.spacing;
  };
  EXPECT_EQ(spacing_of({0.5, 0.5, 0.5}), (Vector{0.5, 0.5, 0.5}));
  EXPECT_EQ(spacing_of({2, 1, 1}), (Vector{1, 1, 1}));
}

TEST_F(Hdf5Conventions, Dream3dUpToVersion7) {
  Hdf5Sample ids{.shape = {1, 4, 5, 1}, .type = VoxelType::kI32};
  Hdf5Sample dimensions{.shape = {3}, .type = VoxelType::kI64};
  const Hdf5Sample numbers{.shape = {3}, .type = VoxelType::kF32};
  {
    const Hdf5Handle file = create();
    add(file, "/DataContainers/Image/CellData/FeatureIds", ids);
    add(file, "/DataContainers/Image/CellData/Phases", ids);
    const std::string geometry = "/DataContainers/Image/_SIMPL_GEOMETRY/";
    write_data_set(file, geometry + "DIMENSIONS", dimensions, {5, 4, 1});
    write_data_set(file, geometry + "SPACING", numbers, {2, 3, 4});
    write_data_set(file, geometry + "ORIGIN", numbers, {10, 20, 30});
  }
  for (const char* name : {"", "DataContainers/Image/CellData/Phases"}) {
    const auto volume = open_volume(path_, named(name));
    EXPECT_EQ(volume->info().shape, (Index3{5, 4, 1}));
    EXPECT_EQ(volume->info().space.spacing, (Vector{2, 3, 4}));
    EXPECT_EQ(volume->info().space.origin, (Vector{10, 20, 30}));
    EXPECT_EQ(read_all(*volume), labels_of(ids));
  }
  {
    const Hdf5Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), &H5Fclose);
    H5Ldelete(file.get(), "/DataContainers/Image/_SIMPL_GEOMETRY/DIMENSIONS", H5P_DEFAULT);
    write_data_set(file, "/DataContainers/Image/_SIMPL_GEOMETRY/DIMENSIONS", dimensions, {5, 1, 4});
  }
  expect_refused({"FeatureIds", "DIMENSIONS", "5 x 1 x 4"});
}

TEST_F(Hdf5Conventions, GeometryInAnotherFileIsNotRead) {
  const std::string secret = dir_.file("secret", std::string(12, 'x')).string();
  const hsize_t numbers = 3;
  const Hdf5Handle space(H5Screate_simple(1, &numbers, nullptr), &H5Sclose);
  for (const bool is_virtual : {false, true}) {
    {
      const Hdf5Handle file = create();
      add(file, "/DataContainers/Image/CellData/FeatureIds",
          {.shape = {3, 4, 5, 1}, .type = VoxelType::kI32});
      const Hdf5Handle geometry(H5Gcreate2(file.get(), "/DataContainers/Image/_SIMPL_GEOMETRY",
                                           H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                &H5Gclose);
      const Hdf5Handle storage(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
      if (is_virtual) {
        H5Pset_virtual(storage.get(), space.get(), secret.c_str(), "/a", space.get());
      } else {
        H5Pset_external(storage.get(), secret.c_str(), 0, 12);
      }
      const Hdf5Handle set(H5Dcreate2(geometry.get(), "SPACING", H5T_IEEE_F32LE, space.get(),
                                      H5P_DEFAULT, storage.get(), H5P_DEFAULT),
                           &H5Dclose);
      EXPECT_TRUE(set.valid());
    }
    expect_refused({path_.string(), "SPACING", "other files", is_virtual ? "virtual" : "external"});
  }
}

/// How far a virtual data set reaches now is asked of no other file.
TEST_F(Hdf5Conventions, ShapesThatAreListedComeFromTheFileItself) {
  write_data_set(create_hdf5(dir_.path() / "b.h5"), "/b", {.shape = {9, 4, 5}},
                 labels_of({.shape = {9, 4, 5}}));
  {
    const Hdf5Handle file = create();
    const std::array<hsize_t, 3> now{2, 4, 5}, most{H5S_UNLIMITED, 4, 5}, start{0, 0, 0},
        one{1, 1, 1};
    const Hdf5Handle space(H5Screate_simple(3, now.data(), most.data()), &H5Sclose);
    H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, one.data(),
                        most.data());
    const Hdf5Handle storage(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
    const std::string other = (dir_.path() / "b.h5").string();
    EXPECT_GE(H5Pset_virtual(storage.get(), space.get(), other.c_str(), "/b", space.get()), 0);
    const Hdf5Handle set(H5Dcreate2(file.get(), "/a", H5T_STD_I32LE, space.get(), H5P_DEFAULT,
                                    storage.get(), H5P_DEFAULT),
                         &H5Dclose);
    EXPECT_TRUE(set.valid());
  }
  expect_refused({"there are: /a 2 x 4 x 5 i32"}, named("/none"));
  expect_refused({"other files", "virtual"});
}

TEST_F(Hdf5Conventions, Dream3dFromVersion8On) {
  const Hdf5Sample ids{.shape = {3, 4, 5, 1}, .type = VoxelType::kI32};
  {
    const Hdf5Handle file = create();
    add(file, "/DataStructure/Image/Cell Data/FeatureIds", ids);
    add(file, "/DataStructure/Image/Cell Data/Phases", ids);
    write_attribute(file, "/DataStructure/Image", "_DIMENSIONS", {5, 4, 3});
    write_attribute(file, "/DataStructure/Image", "_SPACING", {2, 3, 4});
    write_attribute(file, "/DataStructure/Image", "_ORIGIN", {10, 20, 30});
  }
  const auto volume = open_volume(path_);
  EXPECT_EQ(volume->info().shape, (Index3{5, 4, 3}));
  EXPECT_EQ(volume->info().space.spacing, (Vector{2, 3, 4}));
  EXPECT_EQ(volume->info().space.origin, (Vector{10, 20, 30}));
  EXPECT_EQ(read_all(*volume), labels_of(ids));
}

TEST_F(Hdf5Conventions, TheOnlyVolumeOfIntegers) {
  {
    const Hdf5Handle file = create();
    add(file, "/a/labels", {});
    add(file, "/a/raw", kFloats);
    add(file, "/list", {.shape = {60}});
    add(file, "/table", {.shape = {60, 2}});
  }
  const auto volume = open_volume(path_);
  EXPECT_EQ(volume->info().shape, (Index3{5, 4, 3}));
  EXPECT_EQ(volume->info().space.spacing, (Vector{1, 1, 1}));
  EXPECT_EQ(open_volume(path_, named("a"))->info().type, VoxelType::kU16);
  EXPECT_EQ(open_volume(path_, named("table"))->info().shape, (Index3{2, 60, 1}));
  EXPECT_EQ(open_volume(path_, named("a/raw"))->info().type, VoxelType::kF32);
  expect_refused({"/list", "shape is 60", "3 axes"}, named("/list"));
  expect_refused({"/b", "missing", "/a/labels 3 x 4 x 5 u16", "--dataset"}, named("/b"));
}

TEST_F(Hdf5Conventions, SeveralVolumesAreListed) {
  {
    const Hdf5Handle file = create();
    add(file, "/a", {});
    add(file, "/b", kOther);
    add(file, "/c", kFloats);
  }
  expect_refused({path_.string(), "several", "/a 3 x 4 x 5 u16", "/b 6 x 7 x 8 u8", "--dataset"});
  EXPECT_EQ(open_volume(path_, named("b"))->info().shape, (Index3{8, 7, 6}));
  {
    const Hdf5Handle file = create();
    add(file, "/c", kFloats);
    const Hdf5Handle group(H5Gcreate2(file.get(), "/g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           &H5Gclose);
  }
  expect_refused({"no", "integers with 3 axes", "/c 3 x 4 x 5 f32", "--dataset"});
  expect_refused({"there is none"}, named("/g"));
}

TEST_F(Hdf5Conventions, MoreThanThreeLongAxes) {
  {
    const Hdf5Handle file = create();
    add(file, "/a", {.shape = {2, 3, 4, 5}});
  }
  expect_refused({"/a", "2 x 3 x 4 x 5", "[z, y, x]"}, named("a"));
}

TEST_F(Hdf5Conventions, OptionsReplaceWhatTheFileSays) {
  {
    const Hdf5Handle file = create();
    add(file, "/a", {});
    write_attribute(file, "/a", "resolution", {std::numeric_limits<double>::quiet_NaN(), -4, 0});
    write_attribute(file, "/a", "offset", {1, 2, std::numeric_limits<double>::infinity()});
  }
  expect_refused({path_.string(), "resolution", "--spacing"});
  OpenOptions options;
  options.spacing = Vector{1, 2, 3};
  expect_refused({path_.string(), "offset", "--origin"}, options);
  options.origin = Vector{7, 8, 9};
  EXPECT_EQ(open_volume(path_, options)->info().space.origin, (Vector{7, 8, 9}));
}

TEST_F(Hdf5Conventions, LinksAreFollowedWithinTheFile) {
  const auto other = dir_.path() / "other.h5";
  {
    const Hdf5Handle target = create_hdf5(other);
    add(target, "/far", {});
    const Hdf5Handle file = create();
    add(file, "/a", {});
    H5Lcreate_soft("/a", file.get(), "/soft", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_hard(file.get(), "/a", file.get(), "/hard", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external(other.c_str(), "/far", file.get(), "/elsewhere", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_EQ(open_volume(path_)->info().shape, (Index3{5, 4, 3}));
  EXPECT_EQ(open_volume(path_, named("soft"))->info().shape, (Index3{5, 4, 3}));
  expect_refused({path_.string(), "/elsewhere"}, named("elsewhere"));
}

TEST(Hdf5Axes, TagsThatDoNotFit) {
  Hdf5Description array{.path = "/a", .shape = {2, 3, 4}};
  const auto refuse = [&](const std::string& tags, const std::vector<std::string>& pieces) {
    array.axistags = tags;
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(find_axes(array, "f.h5")); });
  };
  refuse(R"({"axes": [{"key": "y"}, {"key": "x"}]})", {"f.h5", "/a", "2 axes"});
  refuse(R"({"axes": [{"key": "t"}, {"key": "y"}, {"key": "x"}]})", {"'t'", "2 elements"});
  refuse(R"({"axes": [{"key": "x"}, {"key": "y"}, {"key": "x"}]})", {"'x'", "4 elements"});
  for (const char* nonsense : {"{", "[]", R"({"axes": 3})", R"({"axes": [3]})", "\xff"}) {
    refuse(nonsense, {"f.h5", "/a", "no list of axes"});
  }
}

TEST(Hdf5Axes, AxesOfOneElementAreLeftOut) {
  const auto axes = [](std::vector<std::uint64_t> shape, bool of_dream3d = false) {
    Hdf5Description array{.shape = std::move(shape)};
    if (of_dream3d) array.numbers["SPACING"] = {1, 1, 1};
    return find_axes(array, "f.h5");
  };
  EXPECT_EQ(axes({1, 2, 3, 4}), (Hdf5Axes{3, 2, 1}));
  EXPECT_EQ(axes({2, 3, 4, 1}), (Hdf5Axes{2, 1, 0}));
  EXPECT_EQ(axes({1, 3, 4, 1}), (Hdf5Axes{3, 2, 1}));
  EXPECT_EQ(axes({1, 3, 4, 1}, true), (Hdf5Axes{2, 1, 0}));
  EXPECT_EQ(axes({1, 1, 1}), (Hdf5Axes{2, 1, 0}));
  EXPECT_EQ(axes({5, 6}), (Hdf5Axes{1, 0, std::nullopt}));
}

}  // namespace
}  // namespace mw::io
