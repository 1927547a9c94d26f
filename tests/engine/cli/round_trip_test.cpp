// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From volume to verified mesh and on, as a user goes.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using nlohmann::json;

class RoundTripTest : public ProgramTest {
 protected:
  [[nodiscard]] json report(const std::string& name) const { return json::parse(read(name)); }
};

TEST_F(RoundTripTest, MeshVerifyDigestInfoConvert) {
  make_volume();
  expect_done("mesh v.npy -o v.vtu --window 8");
  expect_done("verify v.npy v.vtu");
  expect_done("convert v.vtu v.mesh");
  expect_done("verify v.npy v.mesh");
  const std::string digest = run("digest v.vtu").out;
  EXPECT_TRUE(digest.starts_with("sha256:")) << digest;
  EXPECT_EQ(digest.size(), 7U + 64U + 1U);
  EXPECT_EQ(run("digest v.mesh").out, digest);
  const json mesh = json::parse(run("info v.mesh --json").out);
  EXPECT_EQ(mesh["digest"].get<std::string>() + "\n", digest);
  EXPECT_EQ(mesh["box"]["hi"], json::parse("[20.0, 20.0, 20.0]"));
  EXPECT_NE(run("info v.vtu").out.find("vertices"), std::string::npos);
  const json volume = json::parse(run("info v.npy --json").out);
  EXPECT_EQ(volume["shape_xyz"], json::parse("[20, 20, 20]"));
  EXPECT_EQ(volume["labels"]["count"], mesh["labels"]["count"]);
}

TEST_F(RoundTripTest, EveryFormatHoldsTheSameMesh) {
  make_volume();
  for (const std::string name : {"v.vtkhdf", "v.vtu", "v.mesh"}) {
    expect_done("mesh v.npy -o " + name + " --window 8 --report r.json");
    expect_done("verify v.npy " + name);
    EXPECT_EQ(run("digest " + name).out, run("digest v.vtkhdf").out);
    EXPECT_EQ(report("r.json")["digest"].get<std::string>() + "\n", run("digest v.vtkhdf").out);
    const json facts = json::parse(run("info " + name + " --json").out);
    EXPECT_EQ(facts["tets"], report("r.json")["output"]["tets"]);
    EXPECT_EQ(facts["vertices"], report("r.json")["output"]["vertices"]);
    expect_done("convert " + name + " back.vtkhdf");
    EXPECT_TRUE(read("back.vtkhdf") == read("v.vtkhdf")) << name;
  }
}

TEST_F(RoundTripTest, VerifyFailsForAnotherVolume) {
  make_volume("v.npy", 1);
  make_volume("other.npy", 2);
  expect_done("mesh other.npy -o other.vtu");
  const ProgramRun result = run("verify v.npy other.vtu --report q.json");
  EXPECT_EQ(result.code, 5) << result.out << result.err;
  EXPECT_NE(result.out.find("FAIL  P"), std::string::npos) << result.out;
  EXPECT_EQ(report("q.json")["passed"], false);
}

TEST_F(RoundTripTest, VerifyFailsBelowTheQualityFloor) {
  make_volume();
  expect_done("mesh v.npy -o v.vtu");
  EXPECT_EQ(run("verify v.npy v.vtu --quality-floor 0.9").code, 5);
}

TEST_F(RoundTripTest, SpacingAndOriginReachTheMesh) {
  make_volume();
  const std::string frame = " --spacing 0.5,2,3 --origin -1,10,0.25";
  expect_done("mesh v.npy -o v.vtu" + frame);
  const json box = json::parse(run("info v.vtu --json").out)["box"];
  EXPECT_EQ(box["lo"], json::parse("[-1.0, 10.0, 0.25]"));
  EXPECT_EQ(box["hi"], json::parse("[9.0, 50.0, 60.25]"));
  expect_done("verify v.npy v.vtu --quality-floor 0.2 --max-distance 1.5" + frame);
  EXPECT_EQ(run("verify v.npy v.vtu").code, 5);
}

TEST_F(RoundTripTest, RawFilesNeedTheirFacts) {
  make_volume();
  const std::string whole = read("v.npy");
  write("v.raw", whole.substr(whole.size() - 8000));
  expect_done("mesh v.npy -o a.vtu");
  expect_done("mesh v.raw -o b.vtu --shape 20,20,20 --dtype u8");
  expect_done("verify v.raw b.vtu --shape 20,20,20 --dtype u8 --endian little");
  EXPECT_EQ(run("digest a.vtu").out, run("digest b.vtu").out);
}

TEST_F(RoundTripTest, SelectedLabelsOnlyAreWritten) {
  make_volume();
  expect_done("mesh v.npy -o all.vtu");
  expect_done("mesh v.npy -o some.vtu --labels 1,2");
  expect_done("mesh v.npy -o rest.vtu --background 1");
  const json all = json::parse(run("info all.vtu --json").out);
  const json some = json::parse(run("info some.vtu --json").out);
  const json rest = json::parse(run("info rest.vtu --json").out);
  EXPECT_EQ(some["labels"]["count"], 2);
  EXPECT_EQ(rest["labels"]["count"], all["labels"]["count"].get<int>() - 1);
  EXPECT_LT(some["vertices"], all["vertices"]);
  expect_done("mesh v.npy -o some.vtkhdf --labels 1,2 --report r.json");
  EXPECT_EQ(report("r.json")["output"]["vertices"], some["vertices"]);
  EXPECT_EQ(report("r.json")["output"]["tets"], some["tets"]);
  EXPECT_EQ(report("r.json")["digest"], some["digest"]);
}

/// A junction at the box may hold an edge that is a little shorter.
TEST_F(RoundTripTest, GrainsHaveNoShortEdges) {
  int as_long = 0;
  for (const char* const seed : {"1", "2", "3", "4", "5", "6"}) {
    const std::string volume = std::string("g") + seed + ".npy";
    expect_done("synth voronoi --shape 40,40,40 --labels 12 --seed " + std::string(seed) + " -o " +
                volume);
    expect_done("mesh " + volume + " -o g.vtu --force --report r.json");
    const auto shortest = report("r.json")["quality"]["edge_min"].get<double>();
    EXPECT_GE(shortest, 0.5);
    as_long += shortest >= 0.7 ? 1 : 0;
  }
  EXPECT_GE(as_long, 5);
}

TEST_F(RoundTripTest, ReportHasEveryDocumentedKey) {
  make_volume();
  expect_done("mesh v.npy -o v.vtu --report r.json --window 8 --edge-variance 0.5");
  const json r = report("r.json");
  const char* keys[] = {"/version",
                        "/settings/window",
                        "/input/shape_xyz",
                        "/input/spacing_xyz",
                        "/input/labels",
                        "/input/voxels",
                        "/output/vertices",
                        "/output/tets",
                        "/output/vertex_fraction",
                        "/quality/radius_ratio_min",
                        "/quality/radius_ratio_mean",
                        "/quality/radius_ratio_histogram",
                        "/quality/sliver_fraction",
                        "/quality/dihedral_min_deg",
                        "/quality/dihedral_max_deg",
                        "/quality/edge_min",
                        "/quality/edge_max",
                        "/quality/height_min",
                        "/shape/volume_error_mean_abs",
                        "/shape/volume_error_max_abs",
                        "/shape/volume_error_worst_label",
                        "/shape/labels_measured",
                        "/shape/area",
                        "/shape/bend_p50_deg",
                        "/shape/bend_p95_deg",
                        "/shape/bend_p99_deg",
                        "/shape/bend_max_deg",
                        "/shape/sharp_share",
                        "/shape/per_label/0/label",
                        "/shape/per_label/0/voxels",
                        "/shape/per_label/0/volume_voxels",
                        "/shape/per_label/0/volume_error",
                        "/distance/max_voxels",
                        "/distance/mean_voxels",
                        "/distance/per_label",
                        "/topology/checked",
                        "/topology/labels_changed",
                        "/performance/wall_s",
                        "/performance/cpu_s",
                        "/performance/voxels_per_s",
                        "/performance/voxels_per_s_per_core",
                        "/performance/peak_rss_bytes",
                        "/performance/stages",
                        "/engine/windows",
                        "/engine/threads",
                        "/engine/memory_budget_bytes",
                        "/engine/peak_accounted_bytes",
                        "/engine/blocks_spilled",
                        "/engine/bytes_written",
                        "/engine/bytes_read",
                        "/digest"};
  for (const char* key : keys) EXPECT_TRUE(r.contains(json::json_pointer(key))) << key;
  EXPECT_EQ(r["settings"]["window"], 8);
  EXPECT_EQ(r["settings"]["edge_variance"], 0.5);
  EXPECT_EQ(r["input"]["voxels"], 8000);
  EXPECT_EQ(r["quality"]["radius_ratio_histogram"].size(), 20U);
  EXPECT_GE(r["quality"]["radius_ratio_min"], 0.1);
  EXPECT_GE(r["engine"]["windows"], 64);
  EXPECT_GT(r["performance"]["peak_rss_bytes"], 1 << 20);
  EXPECT_EQ(r["digest"].get<std::string>() + "\n", run("digest v.vtu").out);
}

TEST_F(RoundTripTest, TetgenGivesASoundMeshAndAReport) {
  if (!std::filesystem::exists(MW_CODT_WORKER)) GTEST_SKIP() << "built without TetGen";
  make_volume();
  expect_done(
      "mesh v.npy -o v.vtu --window 10 --optimizer tetgen --odt-iterations 2 --report r.json");
  expect_done("verify v.npy v.vtu");
  const json codt = report("r.json")["engine"]["codt"];
  for (const char* key :
       {"windows", "iterations", "vertices_moved", "vertices_added", "patches", "patches_unproved",
        "patches_unimproved", "fallbacks", "workers_restarted", "seconds"}) {
    EXPECT_TRUE(codt.contains(key)) << key;
  }
  EXPECT_GT(codt["patches"], 100);
  EXPECT_LE(codt["iterations"], 2 * codt["windows"].get<int>());
  EXPECT_EQ(codt["fallbacks"], 0);
  expect_done("mesh v.npy -o w.vtu --window 10 --report r.json");
  EXPECT_FALSE(report("r.json")["engine"].contains("codt"));
}

TEST_F(RoundTripTest, EveryStartAndOptimizerGivesASoundMesh) {
  make_volume();
  for (const char* flags : {"--start dense", "--start octree", "--optimizer none",
                            "--max-distance none --edge-variance 0.1 --window 10"}) {
    expect_done(std::string("mesh v.npy -o v.vtu ") + flags);
    // Without a bound on the distance nothing holds volumes to 5 %.
    expect_done("verify v.npy v.vtu --max-volume-error none");
  }
}

TEST_F(RoundTripTest, ThreadsDoNotChangeTheMesh) {
  make_volume();
  for (const std::string order : {"raster", "colour"}) {
    const std::string mesh = "mesh v.npy --window 8 --order " + order;
    expect_done(mesh + " -o one.vtu --threads 1");
    const std::string digest = run("digest one.vtu").out;
    for (const int threads : {0, 2, 3}) {
      expect_done(mesh + " -o v.vtu --report r.json --threads " + std::to_string(threads));
      EXPECT_EQ(run("digest v.vtu").out, digest);
      const json used = report("r.json")["engine"]["threads"];
      EXPECT_TRUE(threads == 0 ? used >= 1 : used == threads) << used;
    }
    expect_done("verify v.npy v.vtu --max-distance 1.5");
  }
}

TEST_F(RoundTripTest, TraceHasALineForEveryVisit) {
  make_volume();
  expect_done("mesh v.npy -o v.vtu --window 8 --threads 2 --trace t.csv --report r.json");
  std::istringstream lines(read("t.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "march,x,y,z,start_s,end_s,cpu_s,slot,bytes");
  int visits = 0;
  while (std::getline(lines, line)) {
    int march = -1, x = -1, y = -1, z = -1, slot = -1;
    double start = -1, end = -1, cpu = -1;
    long bytes = -1;
    EXPECT_EQ(std::sscanf(line.c_str(), "%d,%d,%d,%d,%lf,%lf,%lf,%d,%ld", &march, &x, &y, &z,
                          &start, &end, &cpu, &slot, &bytes),
              9)
        << line;
    EXPECT_TRUE(start >= 0 && end > start && cpu >= 0 && (slot == 0 || slot == 1)) << line;
    EXPECT_GT(bytes, 0) << line;
    ++visits;
  }
  EXPECT_EQ(report("r.json")["engine"]["windows"], visits);
}

TEST_F(RoundTripTest, VerifyReport) {
  make_volume();
  expect_done("mesh v.npy -o v.vtu");
  expect_done("verify v.npy v.vtu --report q.json");
  const json q = report("q.json");
  EXPECT_EQ(q["topology"]["checked"], true);
  EXPECT_EQ(q["topology"]["labels_changed"], 0);
  EXPECT_EQ(q["passed"], true);
  EXPECT_GE(q["checks"].size(), 3U);
  EXPECT_GE(q["quality"]["radius_ratio_min"], 0.1);
}

/// The volume has to be one on which the two ways to mesh differ.
TEST_F(RoundTripTest, InterfacesAreKeptAndVerifiedOnRequest) {
  expect_done("synth voronoi --shape 32,32,32 --labels 40 --seed 3 -o v.npy");
  expect_done("mesh v.npy -o i.vtu --topology interfaces --report i.json");
  EXPECT_EQ(report("i.json")["settings"]["topology"], "interfaces");
  expect_done("verify v.npy i.vtu --topology interfaces --report q.json");
  const json kept = report("q.json")["topology"];
  EXPECT_GT(kept["interfaces"], 40);
  EXPECT_GT(kept["meetings"], kept["interfaces"]);
  EXPECT_EQ(kept["interfaces_changed"], 0);
  EXPECT_EQ(kept["meetings_changed"], 0);
  expect_done("mesh v.npy -o l.vtu");
  expect_done("verify v.npy l.vtu");
  const ProgramRun result = run("verify v.npy l.vtu --topology interfaces --report q.json");
  EXPECT_EQ(result.code, 5) << result.out << result.err;
  EXPECT_NE(result.out.find("FAIL  P1 meetings"), std::string::npos) << result.out;
  EXPECT_EQ(report("q.json")["topology"]["labels_changed"], 0);
  EXPECT_GT(report("q.json")["topology"]["meetings_changed"], 0);
  expect_failure(2, "verify v.npy l.vtu --topology all", "--topology");
}

TEST_F(RoundTripTest, VerifyMeasuresTheDistance) {
  make_volume();
  expect_done("mesh v.npy -o v.vtu --max-distance 1.5");
  const ProgramRun result = run("verify v.npy v.vtu --max-distance 1.5 --report q.json");
  EXPECT_EQ(result.code, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("ok    P4 distance"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\ndistance      "), std::string::npos) << result.out;
  const json q = report("q.json");
  const double largest = q["distance"]["max_voxels"];
  EXPECT_GT(largest, 0.1);
  EXPECT_LE(largest, 1.5);
  EXPECT_LT(q["distance"]["mean_voxels"], largest);
  EXPECT_EQ(q["distance"]["per_label"].size(), q["labels"]);
  double of_labels = 0;
  for (const json& row : q["distance"]["per_label"]) {
    EXPECT_TRUE(row["label"].is_number());
    of_labels = std::max(of_labels, row["input_to_mesh_max"].get<double>());
    of_labels = std::max(of_labels, row["mesh_to_input_max"].get<double>());
  }
  EXPECT_EQ(of_labels, largest);
  EXPECT_EQ(run("verify v.npy v.vtu --max-distance " + std::to_string(largest - 0.01)).code, 5);
  EXPECT_EQ(run("verify v.npy v.vtu --max-distance " + std::to_string(largest + 0.01)).code, 0);
  expect_done("verify v.npy v.vtu --max-distance none");
  expect_failure(2, "verify v.npy v.vtu --max-distance -1", "--max-distance -1");
}

TEST_F(RoundTripTest, VerifyNamesALabelThatTheMeshDoesNotHave) {
  expect_done("synth voronoi --shape 8,8,8 --labels 3 --seed 1 -o v.npy");
  expect_done("synth voronoi --shape 8,8,8 --labels 1 --seed 1 -o one.npy");
  expect_done("mesh one.npy -o one.vtu");
  const ProgramRun result = run("verify v.npy one.vtu --report q.json");
  EXPECT_EQ(result.code, 5);
  EXPECT_NE(result.out.find("FAIL  P4 distance"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("distance      infinite for "), std::string::npos) << result.out;
  EXPECT_TRUE(report("q.json")["distance"]["max_voxels"].is_null());
}

TEST_F(RoundTripTest, ProgressAsJsonLines) {
  make_volume();
  const ProgramRun result = run("mesh v.npy -o v.vtu --window 8 --progress jsonl");
  std::istringstream lines(result.err);
  json last;
  for (std::string line; std::getline(lines, line);) last = json::parse(line);
  EXPECT_EQ(last["event"], "window");
  EXPECT_EQ(last["done"], last["total"]);
  EXPECT_GE(last["wall_s"], 0.0);
  EXPECT_EQ(run("mesh v.npy -o v.vtu --progress auto").err, "");
}

TEST_F(RoundTripTest, SynthWritesWhatItIsAskedFor) {
  expect_done("synth noise --shape 7,5,3 --labels 300 --seed 4 -o n.npy");
  EXPECT_EQ(json::parse(run("info n.npy --json").out)["type"], "u16");
  expect_done("synth tubes --shape 7,5,3 --labels 2 --seed 4 --dtype u64 -o t.npy");
  EXPECT_EQ(json::parse(run("info t.npy --json").out)["type"], "u64");
  expect_failure(2, "synth noise --shape 9,9,9 --labels 300 --seed 4 --dtype u8 -o x.npy", "u8");
  expect_failure(2, "synth noise --shape 0,9,9 --labels 3 --seed 4 -o x.npy", "positive");
  expect_failure(2, "synth noise --shape 9,9,9 --labels 0 --seed 4 -o x.npy", "labels");
}

}  // namespace
}  // namespace mw::cli
