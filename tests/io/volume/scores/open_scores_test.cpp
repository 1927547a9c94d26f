// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels of probabilities and distances in every container, against the highest of all values.
#include "io/volume/scores/open_scores.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/io/volume/sample_files.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

/// Values by component, then x fastest.
struct Fields {
  Index3 shape;
  std::vector<std::vector<float>> values;

  [[nodiscard]] std::size_t voxels() const { return static_cast<std::size_t>(shape.product()); }
  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(values.size()); }
};

/// Eighths from -1, or for probabilities 0, to 1, so that many are equal.
Fields random_fields(Random& random, std::size_t components, VoxelValues values) {
  const int least = values == VoxelValues::kDistances ? -8 : 0;
  Fields out{.shape = pick_shape(random, 7), .values = {}};
  for (std::size_t c = 0; c < components; ++c) {
    std::vector<float>& one = out.values.emplace_back();
    for (std::size_t v = 0; v < out.voxels(); ++v) {
      one.push_back(static_cast<float>(pick(random, least, 8)) / 8.0F);
    }
  }
  return out;
}

std::vector<RawLabel> expected_labels(const Fields& fields, VoxelValues values) {
  std::vector<RawLabel> out;
  for (std::size_t v = 0; v < fields.voxels(); ++v) {
    std::vector<double> scores;
    if (values == VoxelValues::kDistances) scores.push_back(0.0);
    if (values == VoxelValues::kProbabilities && fields.count() == 1) scores.push_back(0.5);
    for (const auto& field : fields.values) {
      scores.push_back(values == VoxelValues::kDistances ? -field[v] : field[v]);
    }
    const auto best = std::max_element(scores.begin(), scores.end());
    out.push_back(static_cast<RawLabel>(best - scores.begin()));
  }
  return out;
}

std::string bytes_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return number_bytes(bits, 4, false);
}

std::string one_behind_the_other(const Fields& fields) {
  std::string out;
  for (const auto& field : fields.values) {
    for (const float value : field) out += bytes_of(value);
  }
  return out;
}

std::string voxel_by_voxel(const Fields& fields) {
  std::string out;
  for (std::size_t v = 0; v < fields.voxels(); ++v) {
    for (const auto& field : fields.values) out += bytes_of(field[v]);
  }
  return out;
}

/// Fortran order: components fastest, then z, y and x.
std::string z_fastest(const Fields& fields) {
  const Box3 all{{0, 0, 0}, fields.shape};
  std::string out;
  for (std::int64_t x = 0; x < fields.shape.x; ++x) {
    for (std::int64_t y = 0; y < fields.shape.y; ++y) {
      for (std::int64_t z = 0; z < fields.shape.z; ++z) {
        for (const auto& field : fields.values) {
          out += bytes_of(field[static_cast<std::size_t>(all.offset({x, y, z}))]);
        }
      }
    }
  }
  return out;
}

std::string npy(const Fields& fields, bool fortran) {
  const auto& n = fields.shape;
  const std::string space = text(n.z, ", ", n.y, ", ", n.x);
  const std::string shape =
      fields.count() > 1 ? text("(", fields.count(), ", ", space, ")") : text("(", space, ")");
  return npy_file("<f4", fortran, shape,
                  fortran ? z_fastest(fields) : one_behind_the_other(fields));
}

std::string nifti(const Fields& fields) {
  NiftiSample sample;
  const auto& n = fields.shape;
  sample.dim = {fields.count() > 1 ? 4 : 3, n.x, n.y, n.z, fields.count(), 1, 1, 1};
  sample.datatype = 16;
  return sample.header() + one_behind_the_other(fields);
}

std::string nrrd(const Fields& fields, bool list_first) {
  const auto& n = fields.shape;
  const std::string space = text(n.x, " ", n.y, " ", n.z), vectors = "(1,0,0) (0,1,0) (0,0,1)";
  const std::string count = std::to_string(fields.count());
  std::string out = "NRRD0004\ntype: float\nendian: little\nencoding: raw\ndimension: 4\n";
  out += "sizes: " + (list_first ? count + " " + space : space + " " + count) + "\n";
  out += "space directions: " + (list_first ? "none " + vectors : vectors + " none") + "\n\n";
  return out + (list_first ? voxel_by_voxel(fields) : one_behind_the_other(fields));
}

std::vector<std::filesystem::path> all_containers(const TempDir& dir, const Fields& fields) {
  std::string list;
  for (std::size_t c = 0; c < fields.values.size(); ++c) {
    const Fields one{fields.shape, {fields.values[c]}};
    const auto path = dir.file(text("class", c, ".nii"), nifti(one));
    list += (list.empty() ? "" : ",") + path.string();
  }
  return {list,
          dir.file("c.npy", npy(fields, false)),
          dir.file("f.npy", npy(fields, true)),
          dir.file("a.nii", nifti(fields)),
          dir.file("first.nrrd", nrrd(fields, true)),
          dir.file("last.nrrd", nrrd(fields, false))};
}

TEST(ScoredLabels, AreThoseOfTheHighestScoreInEveryContainer) {
  Random random(91);
  for (int trial = 0; trial < 40; ++trial) {
    for (const VoxelValues values : {VoxelValues::kProbabilities, VoxelValues::kDistances}) {
      const Fields fields =
          random_fields(random, static_cast<std::size_t>(pick(random, 1, 5)), values);
      const TempDir dir;
      for (const auto& path : all_containers(dir, fields)) {
        const auto volume = open_volume(path, {.values = values});
        expect_regions(random, *volume, fields.shape, expected_labels(fields, values));
      }
    }
  }
}

TEST(ScoredLabels, HaveTheScoresThatTheyComeFrom) {
  Random random(92);
  const Fields fields = random_fields(random, 3, VoxelValues::kProbabilities);
  const TempDir dir;
  const auto path = dir.file("a.npy", npy(fields, false));
  const Box3 all{{0, 0, 0}, fields.shape};
  std::vector<double> scores(fields.voxels());
  for (const bool are_distances : {false, true}) {
    const auto volume = open_volume(
        path, {.values = are_distances ? VoxelValues::kDistances : VoxelValues::kProbabilities});
    ASSERT_EQ(volume->scores()->labels(), are_distances ? 4U : 3U);
    for (RawLabel label = 0; label < volume->scores()->labels(); ++label) {
      volume->scores()->read_scores(label, all, scores);
      for (std::size_t v = 0; v < scores.size(); ++v) {
        const double wanted = !are_distances ? fields.values[label][v]
                              : label == 0   ? 0.0
                                             : -fields.values[label - 1][v];
        ASSERT_EQ(scores[v], wanted);
      }
    }
  }
}

TEST(ScoredLabels, AreCroppedWithTheirScores) {
  Fields fields{.shape = {4, 3, 2}, .values = std::vector<std::vector<float>>(2)};
  for (int v = 0; v < 24; ++v) {
    fields.values[0].push_back(static_cast<float>(v) / 32);
    fields.values[1].push_back(static_cast<float>(23 - v) / 32);
  }
  const TempDir dir;
  const Box3 crop{{1, 1, 0}, {4, 3, 2}};
  const auto volume = open_volume(dir.file("a.npy", npy(fields, false)),
                                  {.values = VoxelValues::kProbabilities, .crop = crop});
  EXPECT_EQ(read_all(*volume),
            part_of(expected_labels(fields, VoxelValues::kProbabilities), fields.shape, crop));
  ASSERT_EQ(volume->scores()->shape(), crop.shape());
  std::vector<double> score(1);
  volume->scores()->read_scores(0, {{0, 1, 1}, {1, 2, 2}}, score);
  EXPECT_EQ(score[0], 21.0 / 32);
}

TEST(ScoredLabels, AreCalledLikeTheirFiles) {
  Random random(93);
  const Fields two = random_fields(random, 2, VoxelValues::kProbabilities);
  const TempDir dir;
  const std::string list = all_containers(dir, two).front().string();
  const auto probabilities = open_volume(list, {.values = VoxelValues::kProbabilities});
  EXPECT_EQ(probabilities->info().names.name(0), "class0");
  EXPECT_EQ(probabilities->info().names.name(1), "class1");
  const auto distances = open_volume(list, {.values = VoxelValues::kDistances});
  EXPECT_EQ(distances->info().names.name(1), "class0");
  EXPECT_EQ(distances->info().names.name(2), "class1");
}

TEST(ScoredLabels, NameTheVoxelThatIsNoNumber) {
  Fields fields{.shape = {3, 2, 2}, .values = {2, std::vector<float>(12, 0.25F)}};
  fields.values[1][7] = std::numeric_limits<float>::quiet_NaN();
  const TempDir dir;
  const auto path = dir.file("a.npy", npy(fields, false));
  const auto volume = open_volume(path, {.values = VoxelValues::kProbabilities});
  expect_error(ErrorKind::kInput, {path.string(), "component 1", "voxel (1, 0, 1)", "NaN"},
               [&] { static_cast<void>(read_all(*volume)); });
}

TEST(ScoredLabels, NameTheVoxelThatIsNoProbability) {
  for (const std::size_t components : {1U, 2U}) {
    for (const float wrong : {-0.002F, 1.002F, 100.0F, 255.0F, -3.5F}) {
      Fields fields{.shape = {3, 2, 2},
                    .values = {components, std::vector<float>{0, 1, -0.0005F, 1.0005F, 0.5F, 0.2F,
                                                              0, 0, 0, 0, 0, 0}}};
      const TempDir dir;
      const OpenOptions options{.values = VoxelValues::kProbabilities};
      const auto sound = open_volume(dir.file("a.npy", npy(fields, false)), options);
      EXPECT_EQ(read_all(*sound), expected_labels(fields, options.values));
      fields.values.back()[7] = wrong;
      const auto path = dir.file("b.npy", npy(fields, false));
      const auto volume = open_volume(path, options);
      expect_error(
          ErrorKind::kInput,
          {path.string(), "voxel (1, 0, 1)", "is no probability", "by 255", "--values distances"},
          [&] { static_cast<void>(read_all(*volume)); });
      EXPECT_EQ(read_all(*open_volume(path, {.values = VoxelValues::kDistances})),
                expected_labels(fields, VoxelValues::kDistances));
    }
  }
}

TEST(ScoredLabels, AreReadInPartsWhereBoxesAreLarge) {
  constexpr Index3 kShape{64, 64, 40};
  Fields fields{.shape = kShape, .values = std::vector<std::vector<float>>(1)};
  for_each_index({{0, 0, 0}, kShape}, [&](Index3 v) {
    fields.values[0].push_back(static_cast<float>(v.x * 7 + v.y * 5 + v.z * 3 - 400));
  });
  const TempDir dir;
  const auto volume =
      open_volume(dir.file("a.npy", npy(fields, false)), {.values = VoxelValues::kDistances});
  EXPECT_EQ(read_all(*volume), expected_labels(fields, VoxelValues::kDistances));
}

TEST(ScoredLabels, AreRefusedWithAWayOut) {
  Random random(94);
  const Fields two = random_fields(random, 2, VoxelValues::kProbabilities);
  const TempDir dir;
  expect_not_opened(dir.file("a.npy", npy(two, false)), {"4 axes", "pick one channel"});
  expect_not_opened(dir.file("a.nrrd", nrrd(two, true)), {"2 elements", "pick one channel"});
  expect_not_opened(dir.file("b.npy", npy(two, false)), {},
                    {.overlap = Overlap::kFirst, .values = VoxelValues::kProbabilities},
                    ErrorKind::kUsage);
}

TEST(ScoredLabels, AreOfOneGrid) {
  const Fields one{.shape = {3, 2, 2}, .values = {std::vector<float>(12)}};
  const Fields other{.shape = {3, 2, 1}, .values = {std::vector<float>(6)}};
  const TempDir dir;
  const auto a = dir.file("a.nii", nifti(one)), b = dir.file("b.nii", nifti(other));
  const std::string list = a.string() + "," + b.string();
  expect_error(ErrorKind::kInput, {b.string(), "3 x 2 x 1", "3 x 2 x 2"},
               [&] { static_cast<void>(open_volume(list, {.values = VoxelValues::kDistances})); });
}

}  // namespace
}  // namespace mw::io
