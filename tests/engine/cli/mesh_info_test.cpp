// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh info of a mesh against sums over the mesh and the voxels that are made here.
#include <nlohmann/json.hpp>

#include "io/mesh/open_mesh.h"
#include "io/volume/open_volume.h"
#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using io::Position;
using nlohmann::json;
using Triangle = std::array<std::uint64_t, 3>;

class MeshInfoTest : public ProgramTest {
 protected:
  [[nodiscard]] json stats(const std::string& arguments) const {
    const ProgramRun result = run("info " + arguments + " --betti --contacts --json");
    EXPECT_EQ(result.code, 0) << result.err;
    return json::parse(result.out);
  }
};

/// Half of the length of the cross product, by coordinates.
double area_of(const Position& a, const Position& b, const Position& c) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double part = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    square += part * part;
  }
  return std::sqrt(square) / 2;
}

/// Areas by pair of labels; one alone: on the box.
std::map<std::pair<RawLabel, RawLabel>, double> areas_of(const io::MeshData& mesh) {
  std::map<Triangle, std::vector<RawLabel>> faces;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::vector<std::uint64_t> rows;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i != left_out) rows.push_back(mesh.tets[t][i]);
      }
      std::sort(rows.begin(), rows.end());
      faces[{rows[0], rows[1], rows[2]}].push_back(mesh.labels[t]);
    }
  }
  std::map<std::pair<RawLabel, RawLabel>, double> areas;
  for (const auto& [rows, labels] : faces) {
    if (labels.size() == 2 && labels[0] == labels[1]) continue;
    areas[std::minmax(labels.front(), labels.back())] +=
        area_of(mesh.vertices[rows[0]], mesh.vertices[rows[1]], mesh.vertices[rows[2]]);
  }
  return areas;
}

TEST_F(MeshInfoTest, AgreeWithBruteForce) {
  expect_done("synth voronoi --shape 30,26,22 --labels 9 --seed 5 -o v.npy");
  expect_done("mesh v.npy --spacing 2,1,1.5 --origin=-7,3,1e3 --topology interfaces -o m.vtu");
  const io::MeshData mesh = io::read_mesh(folder() / "m.vtu");
  const auto areas = areas_of(mesh);
  const json found = stats("m.vtu v.npy --spacing 2,1,1.5 --origin=-7,3,1e3");
  double total = 0;
  std::map<RawLabel, double> surface;
  for (const auto& [pair, area] : areas) {
    surface[pair.first] += area;
    if (pair.second != pair.first) surface[pair.second] += area;
  }
  for (const json& row : found["volume"]["per_label"]) {
    const RawLabel label = row["label"];
    EXPECT_EQ(row["tets"], std::count(mesh.labels.begin(), mesh.labels.end(), label));
    EXPECT_NEAR(row["area"], surface.at(label), 1e-9 * surface.at(label));
    const auto box = areas.find({label, label});
    EXPECT_NEAR(row["area_on_box"], box == areas.end() ? 0 : box->second, 1e-9);
    EXPECT_NEAR(row["volume"].get<double>() / 3 - row["voxels"].get<double>(),
                row["volume_error"].get<double>() * row["voxels"].get<double>(), 1e-6);
    EXPECT_GE(row["radius_ratio_min"], 0.2 - 1e-9);
    EXPECT_GT(row["radius_ratio_mean"], row["radius_ratio_min"]);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT(row["lo"][k], row["centroid"][k]);
      EXPECT_LT(row["centroid"][k], row["hi"][k]);
    }
    total += row["volume"].get<double>();
  }
  EXPECT_NEAR(total, 30 * 26 * 22 * 3.0, 1e-6);
  std::size_t contacts = 0;
  for (const auto& [pair, area] : areas) contacts += pair.first != pair.second ? 1U : 0U;
  EXPECT_EQ(found["contacts"].size(), contacts);
  for (const json& row : found["contacts"]) {
    const double area = areas.at({row["labels"][0], row["labels"][1]});
    EXPECT_NEAR(row["area"], area, 1e-9 * area);
    EXPECT_GT(row["voxel_area"], 0) << "not in the voxels";
  }
}

/// With --topology labels a contact may go; then info still names it.
TEST_F(MeshInfoTest, NoContactOfTheVoxelsIsMissing) {
  expect_done("synth noise --shape 9,8,7 --labels 4 --seed 3 -o v.npy");
  expect_done("mesh v.npy -o m.vtkhdf");
  const auto volume = io::open_volume(folder() / "v.npy");
  const Index3 shape = volume->info().shape;
  std::vector<RawLabel> labels(static_cast<std::size_t>(shape.product()));
  volume->read({{0, 0, 0}, shape}, labels);
  std::map<std::pair<RawLabel, RawLabel>, double> faces;
  const std::array<std::int64_t, 3> steps{1, shape.x, shape.x * shape.y};
  const std::array<std::int64_t, 3> lengths{shape.x, shape.y, shape.z};
  for (std::int64_t v = 0; v < shape.product(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (v / steps[k] % lengths[k] == lengths[k] - 1) continue;
      const auto pair = std::minmax(labels[static_cast<std::size_t>(v)],
                                    labels[static_cast<std::size_t>(v + steps[k])]);
      if (pair.first != pair.second) faces[pair] += 1;
    }
  }
  std::map<std::pair<RawLabel, RawLabel>, double> found;
  const json contacts = stats("m.vtkhdf v.npy")["contacts"];
  for (const json& row : contacts) {
    found[{row["labels"][0], row["labels"][1]}] = row["voxel_area"];
  }
  EXPECT_EQ(found, faces);
}

TEST_F(MeshInfoTest, VolumesHaveTheVolumeOfEachLabel) {
  expect_done("synth noise --shape 9,8,7 --labels 4 --seed 3 -o v.npy");
  const ProgramRun result = run("info v.npy --spacing 0.5,2,3 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json info = json::parse(result.out);
  double sum = 0;
  for (const json& row : info["labels"]["per_label"]) {
    EXPECT_EQ(row["volume"], 3 * row["voxels"].get<double>());
    sum += row["volume"].get<double>();
  }
  EXPECT_EQ(sum, 3.0 * 9 * 8 * 7);
}

/// A shell, a ring, and what is in and around them.
TEST_F(MeshInfoTest, CountsComponentsTunnelsAndCavities) {
  std::string voxels;
  const auto label_at = [](int x, int y, int z) {
    const bool shell = std::max({std::abs(x - 6), std::abs(y - 6), std::abs(z - 6)}) == 3;
    const bool ring = z == 15 && std::max(std::abs(x - 6), std::abs(y - 6)) == 4;
    return shell ? 1 : ring ? 2 : 0;
  };
  for (int z = 0; z < 19; ++z) {
    for (int y = 0; y < 13; ++y) {
      for (int x = 0; x < 13; ++x) voxels.push_back(static_cast<char>(label_at(x, y, z)));
    }
  }
  write("v.raw", voxels);
  expect_done("mesh v.raw --shape 13,13,19 --dtype u8 -o m.mesh");
  const json rows = stats("m.mesh")["volume"]["per_label"];
  EXPECT_EQ(rows[0]["components"], 2);
  // What hangs in it, shell and ring, are two cavities; the ring is a tunnel, too.
  EXPECT_EQ(rows[0]["betti_closed"], json({2, 1, 2}));
  EXPECT_EQ(rows[1]["betti_closed"], json({1, 0, 1}));
  EXPECT_EQ(rows[2]["betti_closed"], json({1, 1, 0}));
  const json plain = json::parse(run("info m.mesh --json").out);
  EXPECT_FALSE(plain["volume"]["per_label"][0].contains("components"));
  EXPECT_FALSE(plain.contains("contacts"));
  // The same of each label alone.
  expect_done("mesh v.raw --shape 13,13,19 --dtype u8 --labels 2,1 -o some.mesh");
  const json some = stats("some.mesh")["volume"]["per_label"];
  ASSERT_EQ(some.size(), 2U);
  EXPECT_EQ(some[0]["betti_closed"], rows[1]["betti_closed"]);
  EXPECT_EQ(some[1]["betti_closed"], rows[2]["betti_closed"]);
  EXPECT_EQ(some[0]["area_on_box"], 0);
}

TEST_F(MeshInfoTest, TablesSayTheSame) {
  make_volume();
  expect_done("mesh v.npy -o m.vtu");
  write("n.csv", "id,name\n1,\"left, \"\"upper\"\" half\"\n");
  const json rows = stats("m.vtu v.npy --names n.csv")["volume"]["per_label"];
  std::istringstream csv(run("info m.vtu v.npy --betti --csv --names n.csv").out);
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line,
            "label,name,volume,voxels,volume_error,area,area_on_box,tets,components,b0,b1,b2,"
            "rr_min,rr_mean,lo_x,lo_y,lo_z,hi_x,hi_y,hi_z,centroid_x,centroid_y,centroid_z");
  for (const json& row : rows) {
    ASSERT_TRUE(std::getline(csv, line));
    const std::string name = row.value("name", "").empty() ? "" : "\"left, \"\"upper\"\" half\"";
    const std::string begin = row["label"].dump() + "," + name + "," + row["volume"].dump();
    EXPECT_EQ(line.substr(0, begin.size()), begin);
  }
  EXPECT_FALSE(std::getline(csv, line));
  const std::string text = run("info m.vtu").out;
  const std::string more = run("info m.vtu --contacts").out;
  EXPECT_EQ(std::count(more.begin(), more.end(), '\n') - std::count(text.begin(), text.end(), '\n'),
            static_cast<std::ptrdiff_t>(2 + stats("m.vtu")["contacts"].size()));
  EXPECT_EQ(run("info m.vtu --contacts --csv").out.substr(0, 28), "first,second,triangles,area\n");
}

TEST_F(MeshInfoTest, WrongUse) {
  make_volume();
  expect_done("mesh v.npy -o m.vtu");
  expect_failure(2, "info m.vtu --json --csv", "only one");
  expect_failure(2, "info", "FILE");
  expect_failure(3, "info gone.vtu", "gone.vtu");
  expect_failure(2, "info v.npy --csv", "FILE must be a mesh");
  expect_failure(2, "info v.npy v.npy", "v.npy: is no mesh, and FILE must be");
  for (const std::string words :
       {"--crop 0,0,0,5,5,5", "--spacing 2", "--merge 1=2", "--merge One=2", "--drop-specks 3",
        "--object 1", "--dtype u8", "--values distances", "--cache c"}) {
    expect_failure(2, "info m.vtu " + words, words.substr(0, words.find(' ')));
  }
  expect_failure(2, "info m.vtu --crop 0,0,0,5,5,5", "--crop: says something of a volume");
  expect_done("info m.vtu", "MW_SPACING=2");
  expect_done("info m.vtu v.npy --spacing 2");
}

}  // namespace
}  // namespace mw::cli
