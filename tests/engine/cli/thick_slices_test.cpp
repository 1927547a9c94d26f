// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Thick slices as a user meets them: good meshes by default, refusals before any work.
#include <nlohmann/json.hpp>

#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using nlohmann::json;

class ThickSlicesTest : public ProgramTest {
 protected:
  /// s.npy: grains.
  void make_slices(const std::string& shape = "24,24,8") const {
    expect_done("synth voronoi --shape " + shape + " --labels 10 --seed 4 -o s.npy");
  }
  [[nodiscard]] json report(const std::string& name) const { return json::parse(read(name)); }
};

TEST_F(ThickSlicesTest, MeshAndVerifyAtTheDefaults) {
  make_slices("32,32,16");
  for (const std::string spacing : {"1,1,10", "1,1,5", "3,1,1", "0.94,0.94,1.5"}) {
    SCOPED_TRACE(spacing);
    const std::string frame = " --spacing " + spacing + " --origin -3,0.1,7";
    expect_done("mesh s.npy -o s.vtu --window 16 --report r.json --threads 1" + frame);
    expect_done("mesh s.npy -o two.vtu --window 16 --threads 2" + frame);
    EXPECT_EQ(read("two.vtu"), read("s.vtu"));
    expect_done("verify s.npy s.vtu --topology labels --quality-floor 0.2 --max-distance 1.5" +
                frame);
    const json quality = report("r.json")["quality"];
    EXPECT_GE(quality["radius_ratio_min"], 0.2);
    EXPECT_GE(quality["radius_ratio_mean"], 0.65);
    EXPECT_EQ(quality["sliver_fraction"], 0.0);
  }
}

TEST_F(ThickSlicesTest, ReportTellsTheLatticeAndTheInput) {
  make_slices();
  const ProgramRun done = run("mesh s.npy -o s.vtu --report r.json --spacing 4,4,40");
  EXPECT_NE(done.out.find("24 x 24 x 80, voxels cut into 1 x 1 x 10 layers"), std::string::npos);
  const json r = report("r.json");
  EXPECT_EQ(r["lattice"], json::parse(R"({"shape_xyz": [24, 24, 80], "spacing_xyz": [4.0, 4.0, 4.0],
                            "layers_xyz": [1, 1, 10]})"));
  EXPECT_EQ(r["input"]["shape_xyz"], json::parse("[24, 24, 8]"));
  EXPECT_EQ(r["input"]["spacing_xyz"], json::parse("[4.0, 4.0, 40.0]"));
  EXPECT_EQ(r["input"]["voxels"], 24 * 24 * 8);
  const double vertices = r["output"]["vertices"];
  EXPECT_DOUBLE_EQ(r["output"]["vertex_fraction"], vertices / (25 * 25 * 9));
  expect_done(
      "mesh s.npy -o s.vtu --report r.json --surface voxel --quality-floor 0 --spacing 4,4,40");
  EXPECT_EQ(report("r.json")["lattice"]["layers_xyz"], json::parse("[1, 1, 1]"));
}

TEST_F(ThickSlicesTest, BoxIsThatOfTheInput) {
  make_slices();
  for (const std::string frame :
       {" --spacing 0.1,0.7,2.3", " --spacing 0.1,0.7,2.3 --origin 0.3,-1e3,12.7"}) {
    expect_done("mesh s.npy -o smooth.vtu" + frame);
    expect_done("mesh s.npy -o voxel.vtu --surface voxel --quality-floor 0" + frame);
    const json smooth = json::parse(run("info smooth.vtu --json").out);
    EXPECT_EQ(smooth["box"], json::parse(run("info voxel.vtu --json").out)["box"]);
  }
}

TEST_F(ThickSlicesTest, FloorThatCannotBePromisedIsRefusedBeforeTheWork) {
  make_slices();
  const std::string mesh = "mesh s.npy -o s.vtu --surface voxel --spacing 4,4,40 ";
  expect_failure(2, mesh, "--quality-floor 0.012 can be, or set --surface smooth");
  expect_failure(2, mesh + "--quality-floor 0.013", "--quality-floor 0.012 can be");
  expect_done(mesh + "--quality-floor 0.012");
  expect_done(
      "verify s.npy s.vtu --surface voxel --spacing 4,4,40 --quality-floor 0.012 "
      "--max-distance 1.5");
  expect_done(mesh + "--quality-floor 0");
  expect_failure(2, "mesh s.npy -o s.vtu --spacing 1,1.49,1.51 --quality-floor 0.5",
                 "--quality-floor 0.315 can be, or set --start dense");
  expect_done("mesh s.npy -o s.vtu --spacing 1,1.49,1.51 --quality-floor 0.5 --start dense");
  expect_done("mesh s.npy -o s.vtu --quality-floor 0.5");
  expect_done("verify s.npy s.vtu --quality-floor 0.5");
}

TEST_F(ThickSlicesTest, LatticeThatIsTooLongIsRefused) {
  make_slices();
  expect_failure(3, "mesh s.npy -o s.vtu --spacing 1e-3,1e-3,1e3", "--surface voxel");
}

/// A bound holds in the voxels that the mesh was made in.
TEST_F(ThickSlicesTest, VerifyCountsInTheLatticeOfTheSurface) {
  make_slices();
  const std::string frame = " --spacing 1,1,6";
  const std::string bound = " --max-distance 1.5" + frame;
  expect_done("mesh s.npy -o s.vtu" + frame);
  expect_done("mesh s.npy -o v.vtu --surface voxel --quality-floor 0" + frame);
  const ProgramRun smooth = run("verify s.npy s.vtu --report q.json" + bound);
  EXPECT_EQ(smooth.code, 0) << smooth.out;
  EXPECT_NE(smooth.out.find("voxels cut into 1 x 1 x 6 layers"), std::string::npos) << smooth.out;
  EXPECT_EQ(report("q.json")["lattice"]["layers_xyz"], json::parse("[1, 1, 6]"));
  EXPECT_EQ(run("verify s.npy v.vtu --surface smooth" + bound).code, 5);
  // The mesh tells how it was made.
  expect_done("verify s.npy v.vtu" + frame);
  expect_done("verify s.npy v.vtu --quality-floor 0 --surface voxel" + bound);
}

TEST_F(ThickSlicesTest, ResumeGoesOnAndRefusesAnotherLattice) {
  expect_done("synth noise --shape 30,30,12 --labels 3 --seed 1 -o n.npy");
  const std::string mesh = "mesh n.npy -o n.vtu --window 8 --spacing ";
  expect_done("mesh n.npy -o whole.vtu --window 8 --spacing 1,1,3");
  const ProgramRun stopped =
      run(mesh + "1,1,3", "timeout --foreground --preserve-status -s TERM 0.6");
  EXPECT_EQ(stopped.code, 75) << stopped.err;
  expect_failure(2, mesh + "1,1,4 --resume", "spacing was 1,1,3 and is 1,1,4");
  expect_failure(2, mesh + "1,1,3 --resume --surface voxel --quality-floor 0", "and is");
  expect_done(mesh + "1,1,3 --resume --report r.json");
  EXPECT_GT(report("r.json")["engine"]["windows_resumed"], 0);
  EXPECT_EQ(read("n.vtu"), read("whole.vtu"));
}

}  // namespace
}  // namespace mw::cli
