// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What verify asks when nothing is said: what the run promised; and that it fails wrong meshes.
#include <nlohmann/json.hpp>

#include "io/mesh/open_mesh.h"
#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using nlohmann::json;

class VerifyDefaultsTest : public ProgramTest {
 protected:
  void SetUp() override {
    // Two balls, of different sizes, away from the middle.
    expect_done("synth spheres --shape 24,24,24 --labels 3 --seed 4 -o v.npy");
  }

  [[nodiscard]] json asked(const std::string& mesh, const std::string& more = {}) const {
    const ProgramRun result = run("verify v.npy " + mesh + more + " --report q.json");
    EXPECT_TRUE(result.code == 0 || result.code == 5) << result.err;
    return json::parse(read("q.json"))["asked"];
  }

  /// Reads the mesh, changes it and writes it to b.vtu, which verify must fail for that reason.
  template <class Change>
  void expect_failed(const std::string& check, Change change) const {
    io::MeshData mesh = io::read_mesh(folder() / "v.vtu");
    change(mesh);
    io::write_mesh(mesh, *io::open_mesh_sink(folder() / "b.vtu"));
    const ProgramRun result = run("verify v.npy b.vtu");
    EXPECT_EQ(result.code, 5) << check;
    EXPECT_NE(result.out.find("FAIL  " + check), std::string::npos) << result.out;
  }
};

TEST_F(VerifyDefaultsTest, AsksWhatTheRunPromised) {
  expect_done("mesh v.npy -o a.vtu --max-distance 2.5 --quality-floor 0.15 --surface voxel");
  expect_done("mesh v.npy -o b.mesh --max-distance none --topology interfaces");
  expect_done("convert a.vtu a.vtkhdf");
  const json a{{"max_distance", 2.5},
               {"quality_floor", 0.15},
               {"topology", "labels"},
               {"surface", "voxel"},
               {"max_volume_error", nullptr},
               {"of_run", true},
               {"less_than_default",
                "distance 2.5, radius ratio 0.15, "
                "no volumes"}};
  EXPECT_EQ(asked("a.vtu"), a);
  EXPECT_EQ(asked("a.vtkhdf"), a);
  const json b{{"max_distance", nullptr},
               {"quality_floor", 0.2},
               {"topology", "interfaces"},
               {"surface", "smooth"},
               {"max_volume_error", nullptr},
               {"of_run", true},
               {"less_than_default", "no distance bound, no volumes"}};
  EXPECT_EQ(asked("b.mesh"), b);
  EXPECT_EQ(asked("b.mesh", " --max-distance 1 --topology labels")["max_distance"], 1.0);
  EXPECT_EQ(asked("b.mesh", " --topology labels")["topology"], "labels");
}

TEST_F(VerifyDefaultsTest, AsksForABoundWhereTheFileTellsOfNoRun) {
  expect_done("mesh v.npy -o v.vtu");
  io::MeshData mesh = io::read_mesh(folder() / "v.vtu");
  mesh.record = {};
  io::write_mesh(mesh, *io::open_mesh_sink(folder() / "b.vtu"));
  const json found = asked("b.vtu");
  EXPECT_EQ(found["max_distance"], 1.5);
  EXPECT_EQ(found["of_run"], false);
}

/// Nobody has to say again which labels were left out.
TEST_F(VerifyDefaultsTest, KnowsWhichLabelsTheFileHolds) {
  for (const std::string chosen :
       {"--background 1", "--labels 2", "--labels 2,3", "--labels 1,3"}) {
    for (const std::string mesh : {"m.vtu", "m.vtkhdf", "m.mesh", "m.msh"}) {
      SCOPED_TRACE(chosen + " " + mesh);
      expect_done("mesh v.npy -o " + mesh + " " + chosen);
      const ProgramRun result = run("verify v.npy " + mesh);
      EXPECT_EQ(result.code, 0) << result.out << result.err;
      const bool is_recorded = mesh == "m.vtu" || mesh == "m.vtkhdf" || mesh == "m.mesh";
      EXPECT_EQ(result.out.starts_with("recorded promise: "), is_recorded) << result.out;
      EXPECT_EQ(result.out.starts_with("no recorded promise: without label"), !is_recorded);
      expect_done("verify v.npy " + mesh + " " + chosen);
      EXPECT_EQ(run("verify v.npy " + mesh + " --labels 1,2,3").code, 5);
    }
  }
}

TEST_F(VerifyDefaultsTest, SaysFirstAndLastWhatIsPromisedLessThanByDefault) {
  expect_done("mesh v.npy -o v.vtu");
  const std::string usual = run("verify v.npy v.vtu").out;
  EXPECT_TRUE(usual.starts_with("asked ")) << usual;
  EXPECT_TRUE(usual.ends_with("all checks hold\n")) << usual;
  const ProgramRun made = run("mesh v.npy -o v.vtu --max-distance none --quality-floor 0");
  EXPECT_NE(made.err.find("--max-distance none: the volumes of labels are not promised (P8)"),
            std::string::npos)
      << made.err;
  const ProgramRun draft = run("mesh v.npy -o d.vtu --preset draft");
  EXPECT_NE(draft.err.find("--preset draft: the volumes of labels are not promised (P8)"),
            std::string::npos)
      << draft.err;
  const ProgramRun result = run("verify v.npy v.vtu");
  const std::string told = "recorded promise: no distance bound, no floor, no volumes\n";
  EXPECT_EQ(result.code, 0) << result.out;
  EXPECT_TRUE(result.out.starts_with(told)) << result.out;
  EXPECT_TRUE(result.out.ends_with("all checks hold; " + told)) << result.out;
  const std::string asked = run("verify v.npy v.vtu --max-distance 99 --quality-floor 1e-9").out;
  EXPECT_TRUE(asked.starts_with("recorded promise: no volumes\n")) << asked;
}

TEST_F(VerifyDefaultsTest, FailsWhatIsWrong) {
  expect_done("mesh v.npy -o v.vtu");
  expect_done("verify v.npy v.vtu");
  expect_failed("P4 distance", [](io::MeshData& mesh) {
    for (io::Position& p : mesh.vertices) p[0] = 24 - p[0];
    for (io::TetRows& tet : mesh.tets) std::swap(tet[0], tet[1]);
  });
  expect_failed("P4 distance", [](io::MeshData& mesh) {
    for (RawLabel& label : mesh.labels) label = label == 1 ? 2 : label == 2 ? 1 : label;
  });
  expect_failed("P2 orientation", [](io::MeshData& mesh) {
    for (io::TetRows& tet : mesh.tets) std::swap(tet[0], tet[1]);
  });
  expect_failed("P2 vertices", [](io::MeshData& mesh) {
    mesh.vertices.push_back({3.25, 4.5, 5.125});
  });
}

}  // namespace
}  // namespace mw::cli
