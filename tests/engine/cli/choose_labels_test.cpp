// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts and labels of a volume as a user chooses them: --crop, --merge, --drop-specks, and verify
// of meshes of some labels.
#include <nlohmann/json.hpp>

#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using nlohmann::json;

class ChooseLabelsTest : public ProgramTest {
 protected:
  [[nodiscard]] json info(const std::string& arguments) const {
    return json::parse(run("info " + arguments + " --json").out);
  }
  [[nodiscard]] std::string digest(const std::string& mesh) const {
    return run("digest " + mesh).out;
  }
};

/// A 6 x 6 x 6 raw volume of u8: `label_at` of each voxel.
template <class LabelAt>
std::string raw_cube(LabelAt label_at) {
  std::string out;
  for (int i = 0; i < 216; ++i) {
    out.push_back(static_cast<char>(label_at(i % 6, i / 6 % 6, i / 36)));
  }
  return out;
}
const std::string kRaw = " --shape 6,6,6 --dtype u8 ";

TEST_F(ChooseLabelsTest, CropsStayWhereTheyWere) {
  make_volume();
  const json facts = info("v.npy --crop 4,0,2,16,20,12 --spacing 2,1,3 ");
  EXPECT_EQ(facts["shape_xyz"], json({12, 20, 10}));
  EXPECT_EQ(facts["origin_xyz"], json({8.0, 0.0, 6.0}));
  expect_done("mesh v.npy -o c.vtkhdf --crop 4,0,2,16,20,12 --window 8 --report r.json");
  EXPECT_EQ(json::parse(read("r.json"))["settings"]["crop"], json({4, 0, 2, 16, 20, 12}));
  expect_done("verify v.npy c.vtkhdf --crop 4,0,2,16,20,12 --max-volume-error none");
  EXPECT_EQ(run("verify v.npy c.vtkhdf").code, 5);
  expect_failure(2, "mesh v.npy -o d.vtu --crop 4,0,2,16,21,12", "20 x 20 x 20");
  expect_failure(2, "mesh v.npy -o d.vtu --crop 4,0,2,16,21", "six integers");
}

TEST_F(ChooseLabelsTest, StepsGoInTheirOrder) {
  // Labels 1 and 2 of three voxels together, a 3 of one voxel, all in zeros.
  write("v.raw", raw_cube([](int x, int y, int z) {
          if (y != 2 || z != 2) return 0;
          return x == 1 || x == 2 ? 1 : x == 3 ? 2 : x == 5 ? 3 : 0;
        }));
  EXPECT_EQ(info("v.raw" + kRaw)["labels"]["count"], 4);
  const json dropped = info("v.raw" + kRaw + "--drop-specks 3");
  EXPECT_EQ(dropped["labels"]["count"], 1);
  EXPECT_EQ(dropped["specks"], (json{{"components", 3}, {"voxels", 4}, {"rounds", 1}}));
  json merged = info("v.raw" + kRaw + "--merge 1,2=9 --drop-specks 3");
  merged["labels"].erase("per_label");
  EXPECT_EQ(merged["labels"], (json{{"count", 2}, {"min", 0}, {"max", 9}}));
  EXPECT_EQ(merged["specks"]["components"], 1);
  EXPECT_EQ(info("v.raw" + kRaw + "--crop 0,0,0,5,6,6 --merge '1=0;2=0'")["labels"]["count"], 1);
  expect_failure(2, "info v.raw" + kRaw + "--merge 1,7=9", "--merge: the volume has no label 7");
  expect_failure(2, "info v.raw" + kRaw + "--merge 1,2", "expected A,B=C");
  expect_failure(2, "info v.raw" + kRaw + "--merge '1=2;1=3'", "label 1 is to be merged twice");
  expect_failure(2, "info v.raw" + kRaw + "--drop-specks 0", "from 1 on");
  expect_failure(2, "info v.raw" + kRaw + "--drop-specks 5/18", "voxels/26");
}

TEST_F(ChooseLabelsTest, SpecksAreDroppedForEveryCommand) {
  make_volume();
  const std::string steps = " --merge 1,2=77 --drop-specks 30/26 ";
  expect_done("mesh v.npy -o m.vtkhdf --window 8 --report r.json" + steps);
  const json report = json::parse(read("r.json"));
  EXPECT_EQ(report["settings"]["drop_specks"], "30/26");
  EXPECT_EQ(report["settings"]["merge"], "1,2=77");
  EXPECT_TRUE(report["specks"]["components"].is_number());
  EXPECT_NE(run("info v.npy" + steps).out.find("specks.components"), std::string::npos);
  expect_done("verify v.npy m.vtkhdf --max-volume-error none --report q.json" + steps);
  EXPECT_EQ(json::parse(read("q.json"))["specks"], report["specks"]);
  EXPECT_EQ(run("verify v.npy m.vtkhdf --max-volume-error none").code, 5);
  // The same from a config file, where a number need be no string.
  write("c.toml", "merge = \"1,2=77\"\ndrop_specks = \"30/26\"\nwindow = 8\n");
  expect_done("mesh v.npy -o n.vtkhdf --config c.toml");
  EXPECT_EQ(digest("n.vtkhdf"), digest("m.vtkhdf"));
  write("d.toml", "drop_specks = 30\ncrop = [0, 0, 0, 8, 8, 8]\n");
  expect_done("mesh v.npy -o o.vtkhdf --config d.toml --window 8");
}

/// Two blocks that share an edge hang together, until a row of voxels is filled.
TEST_F(ChooseLabelsTest, WeldedBlocksAreOnePart) {
  std::string bytes(12 * 12 * 12, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t x = i % 12, y = i / 12 % 12, z = i / 144;
    if (z < 2 || z >= 10) continue;
    if (x >= 2 && x < 6 && y >= 2 && y < 6) bytes[i] = 1;
    if (x >= 6 && x < 10 && y >= 6 && y < 10) bytes[i] = 2;
  }
  write("w.raw", bytes);
  const std::string in = " w.raw --shape 12,12,12 --dtype u8 ",
                    alone = " --background 0 --report r.json";
  expect_done("mesh" + in + "-o hangs.vtu" + alone);
  EXPECT_EQ(json::parse(read("r.json"))["parts"]["found"], 2);
  EXPECT_TRUE(json::parse(read("r.json"))["welds"].is_null());
  expect_done("mesh" + in + "-o m.vtu --weld 0" + alone);
  const json report = json::parse(read("r.json"));
  EXPECT_EQ(report["parts"]["found"], 1);
  EXPECT_EQ(report["parts"]["hinge_edges"], 0);
  EXPECT_EQ(report["welds"], (json{{"labels_to_join", true}, {"rounds", 1}, {"voxels", 8}}));
  expect_done("verify" + in + "m.vtu --weld 0 --report v.json");
  EXPECT_EQ(json::parse(read("v.json"))["volume"]["per_label"][0]["voxels"], 136);
  EXPECT_EQ(info(in + "--weld 0")["welds"]["voxels"], 8);
  expect_failure(2, "info" + in + "--weld 9", "the volume has no label 9");
  EXPECT_EQ(run("mesh" + in + "-o m.vtu --force --weld 0" + alone).out.find("nothing:"),
            std::string::npos);
  EXPECT_NE(
      run("mesh" + in + "-o m.vtu --force --weld 0,1,2" + alone).out.find("welded      nothing:"),
      std::string::npos);
}

TEST_F(ChooseLabelsTest, VerifyTakesMeshesOfSomeLabels) {
  make_volume();
  expect_done("mesh v.npy -o some.vtkhdf --labels 2,3,7 --window 8");
  expect_done("mesh v.npy -o rest.vtkhdf --background 4 --window 8");
  const std::string judged = " --max-volume-error none --quality-floor 0.2 --max-distance 1.5 ";
  expect_done("verify v.npy some.vtkhdf --labels 2,3,7" + judged);
  expect_done("mesh v.npy -o range.vtkhdf --labels 2-3,7 --window 8");
  EXPECT_EQ(run("digest range.vtkhdf").out, run("digest some.vtkhdf").out);
  expect_failure(2, "mesh v.npy -o a.vtu --labels 3-2", "a range A-B from the smaller one on");
  expect_failure(2, "mesh v.npy -o a.vtu --labels 0-99999999", "at most 2^20");
  expect_failure(2, "mesh v.npy -o a.vtu --labels 2-99", "no label");
  expect_done("verify v.npy rest.vtkhdf --background 4" + judged);
  const std::string judging = "verify v.npy" + judged;
  // The file tells.
  expect_done(judging + "some.vtkhdf");
  expect_done(judging + "rest.vtkhdf");
  for (const char* wrong :
       {"some.vtkhdf --labels 2,3", "some.vtkhdf --labels 1,2,3,7", "rest.vtkhdf --background 5"}) {
    EXPECT_EQ(run(judging + wrong).code, 5) << wrong;
  }
  expect_failure(2, "verify v.npy some.vtkhdf --labels 99", "no label 99");
  expect_failure(2, "verify v.npy some.vtkhdf --labels 2 --background 1", "one of them");
  expect_failure(2, "verify v.npy some.vtkhdf --labels 2 --topology interfaces", "all labels");
}

// Thick slices as a user meets them: good meshes by default, refusals before any work.

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
  expect_done("mesh s.npy -o s.vtu --report r.json --spacing 4,4,40");
  const json r = report("r.json");
  EXPECT_EQ(r["lattice"], json::parse(R"({"shape_xyz": [24, 24, 80], "spacing_xyz": [4.0, 4.0, 4.0],
                            "layers_xyz": [1, 1, 10]})"));
  EXPECT_EQ(r["input"]["shape_xyz"], json::parse("[24, 24, 8]"));
  EXPECT_EQ(r["input"]["spacing_xyz"], json::parse("[4.0, 4.0, 40.0]"));
  EXPECT_EQ(r["input"]["voxels"], 24 * 24 * 8);
  const double vertices = r["output"]["vertices"];
  EXPECT_DOUBLE_EQ(r["output"]["vertex_fraction"], vertices / (25 * 25 * 9));
  expect_done("mesh s.npy -o s.vtu --report r.json --preset draft --spacing 4,4,40");
  EXPECT_EQ(report("r.json")["lattice"]["layers_xyz"], json::parse("[1, 1, 10]"));
  expect_done("verify s.npy s.vtu --spacing 4,4,40");
}

/// Promises are about the thin slices, which verify and info make, too.
TEST_F(ThickSlicesTest, ArePointedToAndInterpolated) {
  make_slices();
  const std::string spacing = " --spacing 4,4,40";
  EXPECT_NE(run("mesh s.npy -o s.vtu" + spacing).out.find("--interpolate-slices"),
            std::string::npos);
  const std::string smooth = spacing + " --interpolate-slices";
  const ProgramRun done = run("mesh s.npy -o i.vtu --report r.json" + smooth);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("8 slices along z became 10 thin ones each"), std::string::npos);
  EXPECT_EQ(done.out.find("--interpolate-slices"), std::string::npos);
  EXPECT_EQ(report("r.json")["interpolated"],
            json::parse(R"({"axis": "z", "slices": 8, "layers": 10})"));
  expect_done("verify s.npy i.vtu" + smooth);
  EXPECT_EQ(json::parse(run("info s.npy --json" + smooth).out)["shape_xyz"],
            json::parse("[24, 24, 80]"));
  EXPECT_NE(run("digest s.vtu").out, run("digest i.vtu").out);
  expect_done("mesh s.npy -o j.vtu --threads 2" + smooth);
  EXPECT_EQ(run("digest i.vtu").out, run("digest j.vtu").out);
  expect_failure(2, "mesh s.npy -o k.vtu --interpolate-slices", "no thick slices");
}

TEST_F(ThickSlicesTest, BoxIsThatOfTheInput) {
  make_slices();
  for (const std::string frame :
       {" --spacing 0.1,0.7,2.3", " --spacing 0.1,0.7,2.3 --origin 0.3,-1e3,12.7"}) {
    expect_done("mesh s.npy -o smooth.vtu" + frame);
    expect_done("mesh s.npy -o voxel.vtu --surface voxel" + frame);
    const json smooth = json::parse(run("info smooth.vtu --json").out);
    EXPECT_EQ(smooth["box"], json::parse(run("info voxel.vtu --json").out)["box"]);
  }
}

TEST_F(ThickSlicesTest, FloorThatCannotBePromisedIsRefusedBeforeTheWork) {
  make_slices();
  const std::string mesh = "mesh s.npy -o s.vtu --spacing 1,1.49,1.51 ";
  expect_failure(2, mesh + "--quality-floor 0.5",
                 "--quality-floor 0.315 can be, or set --start dense");
  expect_failure(2, mesh + "--quality-floor 0.316", "--quality-floor 0.315 can be");
  expect_done(mesh + "--quality-floor 0.315");
  expect_done("verify s.npy s.vtu --spacing 1,1.49,1.51 --quality-floor 0.315");
  expect_done("mesh s.npy -o s.vtu --spacing 1,1.49,1.51 --quality-floor 0.5 --start dense");
  expect_done("mesh s.npy -o s.vtu --quality-floor 0.5");
  expect_done("verify s.npy s.vtu --quality-floor 0.5");
}

TEST_F(ThickSlicesTest, LatticeThatIsTooLongIsRefused) {
  make_slices();
  expect_failure(3, "mesh s.npy -o s.vtu --spacing 1e-3,1e-3,1e3", "with --crop");
}

/// A bound holds in the voxels that the mesh was made in.
TEST_F(ThickSlicesTest, VerifyCountsInTheLattice) {
  make_slices();
  const std::string frame = " --spacing 1,1,6";
  const std::string bound = " --max-distance 1.5" + frame;
  expect_done("mesh s.npy -o s.vtu" + frame);
  expect_done("mesh s.npy -o v.vtu --surface voxel" + frame);
  const ProgramRun smooth = run("verify s.npy s.vtu --report q.json" + bound);
  EXPECT_EQ(smooth.code, 0) << smooth.out;
  EXPECT_NE(smooth.out.find("voxels cut into 1 x 1 x 6 layers"), std::string::npos) << smooth.out;
  EXPECT_EQ(report("q.json")["lattice"]["layers_xyz"], json::parse("[1, 1, 6]"));
  expect_done("verify s.npy v.vtu" + bound);
}

TEST_F(ThickSlicesTest, ResumeGoesOnAndRefusesAnotherLattice) {
  expect_done("synth noise --shape 30,30,12 --labels 3 --seed 1 -o n.npy");
  const std::string mesh = "mesh n.npy -o n.vtu --window 8 --spacing ";
  expect_done("mesh n.npy -o whole.vtu --window 8 --spacing 1,1,3");
  const ProgramRun stopped =
      run(mesh + "1,1,3", "timeout --foreground --preserve-status -s TERM 0.6");
  EXPECT_EQ(stopped.code, 75) << stopped.err;
  expect_failure(2, mesh + "1,1,4 --resume", "spacing was 1,1,3 and is 1,1,4");
  expect_failure(2, mesh + "1,1,3 --resume --surface voxel", "and is");
  expect_done(mesh + "1,1,3 --resume --report r.json");
  EXPECT_GT(report("r.json")["engine"]["windows_resumed"], 0);
  EXPECT_EQ(read("n.vtu"), read("whole.vtu"));
}

}  // namespace
}  // namespace mw::cli
