// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 8 as a user sees it: volumes and shape in the run's report, in verify and in info.
#include <nlohmann/json.hpp>

#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using nlohmann::json;

class VolumesTest : public ProgramTest {
 protected:
  void SetUp() override {
    expect_done("synth voronoi --shape 36,32,40 --labels 9 --seed 2 -o v.npy");
  }
  [[nodiscard]] json report(const std::string& name) const { return json::parse(read(name)); }

  /// The line of verify's output about volumes; empty: there is none.
  [[nodiscard]] std::string verdict(const std::string& arguments) const {
    const std::string out = run("verify " + arguments).out;
    const std::size_t name = out.find("P8 volumes");
    if (name == out.npos) return "";
    const std::size_t begin = out.rfind('\n', name) + 1;
    return out.substr(begin, out.find('\n', begin) - begin);
  }

  static void expect_near(const json& actual, const json& expected) {
    for (const char* key : {"area", "bend_max_deg", "sharp_share"}) {
      EXPECT_NEAR(actual[key], expected[key], 1e-9 * (1 + expected[key].get<double>())) << key;
    }
    // Either side of the bound of two bins.
    for (const char* key : {"bend_p50_deg", "bend_p95_deg", "bend_p99_deg"}) {
      EXPECT_NEAR(actual[key], expected[key], 0.11) << key;
    }
  }
};

/// The run measures block by block, verify tile by tile, info with sorted files.
TEST_F(VolumesTest, Promise8RunVerifyAndInfoAgree) {
  for (const std::string mesh : {"v.vtkhdf", "v.vtu", "v.mesh"}) {
    SCOPED_TRACE(mesh);
    expect_done("mesh v.npy -o " + mesh + " --window 16 --report r.json");
    expect_done("verify v.npy " + mesh + " --max-volume-error none --report q.json");
    json run_shape = report("r.json")["shape"];
    for (json& row : run_shape["per_label"]) row.erase("tets");  // verify does not count these
    const json volume = report("q.json")["volume"];
    EXPECT_EQ(volume["exact"], true);
    for (const char* key : {"volume_error_mean_abs", "volume_error_max_abs",
                            "volume_error_worst_label", "labels_measured", "per_label"}) {
      EXPECT_EQ(run_shape[key], volume[key]) << key;
    }
    expect_near(run_shape, report("q.json")["shape"]);
    const json info = json::parse(run("info " + mesh + " --volume v.npy --json").out);
    expect_near(info["shape"], run_shape);
    EXPECT_NEAR(info["volume"]["total"], 36 * 32 * 40, 1e-6);
    EXPECT_EQ(info["volume"]["volume_error_worst_label"], volume["volume_error_worst_label"]);
    const std::size_t labels = volume["per_label"].size();
    ASSERT_EQ(info["volume"]["per_label"].size(), labels);
    for (std::size_t i = 0; i < labels; ++i) {
      const json& row = info["volume"]["per_label"][i];
      EXPECT_EQ(row["label"], volume["per_label"][i]["label"]);
      EXPECT_EQ(row["voxels"], volume["per_label"][i]["voxels"]);
      EXPECT_NEAR(row["volume_error"], volume["per_label"][i]["volume_error"], 1e-12);
      EXPECT_NEAR(row["share"], row["volume"].get<double>() / (36 * 32 * 40), 1e-12);
    }
  }
}

TEST_F(VolumesTest, Promise8ErrorsAreThoseOfTheListedVolumes) {
  expect_done("mesh v.npy -o v.vtu --report r.json");
  const json shape = report("r.json")["shape"];
  std::uint64_t voxels = 0;
  double volume = 0, largest = 0, sum = 0;
  int measured = 0;
  for (const json& row : shape["per_label"]) {
    voxels += row["voxels"].get<std::uint64_t>();
    volume += row["volume_voxels"].get<double>();
    const double error = row["volume_error"];
    EXPECT_NEAR(error, row["volume_voxels"].get<double>() / row["voxels"].get<double>() - 1, 1e-12);
    if (row["voxels"] < 1000) continue;
    ++measured;
    sum += std::abs(error);
    largest = std::max(largest, std::abs(error));
    if (row["label"] == shape["volume_error_worst_label"]) {
      EXPECT_EQ(std::abs(error), shape["volume_error_max_abs"]);
    }
  }
  EXPECT_EQ(voxels, 36U * 32 * 40);
  EXPECT_NEAR(volume, 36 * 32 * 40, 1e-6);
  EXPECT_GT(measured, 0);
  EXPECT_EQ(shape["labels_measured"], measured);
  EXPECT_EQ(shape["volume_error_max_abs"], largest);
  EXPECT_NEAR(shape["volume_error_mean_abs"], sum / measured, 1e-15);
}

TEST_F(VolumesTest, VerifyFailsAboveTheBound) {
  expect_done("mesh v.npy -o v.vtu --surface voxel --report r.json");
  const json shape = report("r.json")["shape"];
  const double largest = shape["volume_error_max_abs"];
  const std::string worst = shape["volume_error_worst_label"].dump();
  ASSERT_GT(largest, 1e-4);
  const std::string bound = "v.npy v.vtu --max-volume-error ";
  EXPECT_TRUE(verdict(bound + std::to_string(largest + 1e-5)).starts_with("ok    "));
  EXPECT_TRUE(verdict(bound + std::to_string(largest - 1e-5)).starts_with("FAIL  "));
  EXPECT_EQ(run("verify " + bound + std::to_string(largest - 1e-5)).code, 5);
  EXPECT_EQ(run("verify " + bound + "none").code, 0);
  EXPECT_EQ(verdict(bound + "none"), "");
  EXPECT_EQ(verdict(bound + "0.05").starts_with("ok    "), largest <= 0.05);
  EXPECT_EQ(verdict("v.npy v.vtu"), "") << "its run did not promise volumes";
  EXPECT_NE(run("verify " + bound + "none").out.find("(label " + worst + ")"), std::string::npos);
  expect_failure(2, "verify " + bound + "-0.1", "--max-volume-error -0.1");
}

/// A plane of voxels that touch by edges alone loses much of its volume; the summary says so.
TEST_F(VolumesTest, TheSummaryNamesLargeLabelsThatAreOff) {
  constexpr int kEdge = 48;
  std::string voxels;
  for (int i = 0; i < kEdge * kEdge * kEdge; ++i) {
    const int x = i % kEdge, y = i / kEdge % kEdge, z = i / kEdge / kEdge;
    voxels += static_cast<char>(x + y + z == 66 ? 3 : x < 6 && y < 6 && z < 6 ? 1 : 0);
  }
  write("sheet.raw", voxels);
  write("names.csv", "3,Membrane\n");
  const std::string raw = "mesh sheet.raw --shape 48,48,48 --dtype u8 --names names.csv -o m.vtu ";
  const std::string near = ": --max-distance 1 keeps thin labels better\n";
  for (const std::string options : {"--report r.json --force", "--preset draft --force"}) {
    const std::string out = run(raw + options).out;
    const std::string begin =
        "\nnote        1 label of 1,000 voxels and more is off by more than 5 % in volume: 3 "
        "\"Membrane\" -";
    EXPECT_NE(out.find(begin), out.npos) << out;
    EXPECT_EQ(out.find(near) != out.npos, options.find("draft") == options.npos) << out;
    EXPECT_EQ(out.find("is why\n") != out.npos, options.find("draft") != options.npos) << out;
  }
  const json facts = report("r.json");
  for (const json& row : facts["shape"]["per_label"]) {
    const bool is_off = row["voxels"] >= 1000 && std::abs(row["volume_error"].get<double>()) > 0.05;
    EXPECT_EQ(is_off, row["label"] == 3) << row;
  }
  EXPECT_EQ(run("mesh v.npy -o v.vtu").out.find("off by more"), std::string::npos);
}

TEST_F(VolumesTest, VerifyFailsForSwappedLabels) {
  expect_done("mesh v.npy -o v.vtu");
  std::string bytes = read("v.npy");
  for (std::size_t i = bytes.size() - 36 * 32 * 40; i < bytes.size(); ++i) {
    if (bytes[i] == 1 || bytes[i] == 2) bytes[i] = static_cast<char>(3 - bytes[i]);
  }
  write("swapped.npy", bytes);
  EXPECT_TRUE(verdict("swapped.npy v.vtu").starts_with("FAIL  ")) << verdict("swapped.npy v.vtu");
}

TEST_F(VolumesTest, OnlyWhatIsWrittenIsReported) {
  expect_done("mesh v.npy -o some.vtu --labels 1,2,3 --report r.json --window 16");
  const json shape = report("r.json")["shape"];
  ASSERT_EQ(shape["per_label"].size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(shape["per_label"][i]["label"], i + 1);
  const json info = json::parse(run("info some.vtu --volume v.npy --json").out);
  expect_near(info["shape"], shape);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(info["volume"]["per_label"][i]["volume_error"],
                shape["per_label"][i]["volume_error"], 1e-12);
  }
}

TEST_F(VolumesTest, AreasAndVolumesAreInPhysicalUnits) {
  expect_done("mesh v.npy -o one.mesh --report r.json");
  expect_done("mesh v.npy -o two.mesh --spacing 2,2,2 --origin 5,6,7 --report s.json");
  const json one = report("r.json")["shape"], two = report("s.json")["shape"];
  EXPECT_NEAR(two["area"].get<double>(), 4 * one["area"].get<double>(), 1e-6);
  EXPECT_EQ(two["per_label"], one["per_label"]);
  const json info = json::parse(run("info two.mesh --volume v.npy --spacing 2,2,2 --json").out);
  EXPECT_NEAR(info["volume"]["total"], 8 * 36 * 32 * 40, 1e-5);
  EXPECT_NEAR(info["volume"]["volume_error_max_abs"], one["volume_error_max_abs"], 1e-12);
}

TEST_F(VolumesTest, WarningsLeaveTheOutputAlone) {
  for (const std::string seed : {"1", "2"}) {
    expect_done("synth spheres --shape 20,20,20 --labels 1 --seed " + seed + " -o m" + seed +
                ".npy");
  }
  const auto told = run("info m1.npy,m2.npy --overlap first --json");
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_EQ(json::parse(told.out)["kind"], "volume");
  EXPECT_EQ(told.err.rfind("mwmesh: warning: m1.npy,m2.npy: ", 0), 0U) << told.err;
}

/// A terminal would obey what a file has in the place of a word.
TEST_F(VolumesTest, MessagesHaveNoControlCharacters) {
  write("v.nrrd", "NRRD0004\ntype: \x1b[31mred\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n\n1");
  expect_failure(3, "info v.nrrd", "\\x1b[31mred");
}

TEST_F(VolumesTest, InfoHoldsOnlyMeshesAgainstVolumes) {
  expect_failure(2, "info v.npy --volume v.npy", "v.npy: is no mesh");
  expect_done("mesh v.npy -o v.vtu");
  expect_failure(3, "info v.vtu --volume missing.npy", "missing.npy");
  const std::string text = run("info v.vtu").out;
  EXPECT_NE(text.find("\nshape.area "), std::string::npos) << text;
  EXPECT_NE(text.find("\nlabel "), std::string::npos) << text;
  EXPECT_EQ(text.find("volume_error"), std::string::npos) << text;
}

}  // namespace
}  // namespace mw::cli
