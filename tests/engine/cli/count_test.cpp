// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// --count and --across: what is asked is what is got, the same for any number of threads, and a run
// that goes on does not ask anew.
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/file/errors.h"
#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using nlohmann::json;

class CountTest : public ProgramTest {
 protected:
  void synth(const std::string& kind, const std::string& options) const {
    expect_done("synth " + kind + " -o v.npy " + options);
  }
  /// The report of a mesh that is made of v.npy.
  [[nodiscard]] json report_of(const std::string& options) const {
    expect_done("mesh v.npy -o v.vtkhdf --report r.json " + options);
    return json::parse(read("r.json"));
  }
  void expect_same_for_threads(const std::string& count,
                               const std::vector<std::string>& numbers) const {
    const json one = report_of(count + "--threads 1");
    for (const std::string& threads : numbers) {
      const json other = report_of(count + "--threads " + threads);
      EXPECT_EQ(other["digest"], one["digest"]) << threads;
      EXPECT_EQ(other["size"]["count"]["scale"], one["size"]["count"]["scale"]) << threads;
    }
  }
  [[nodiscard]] std::uint64_t tets_of(const std::string& options) const {
    return report_of(options)["output"]["tets"];
  }
};

TEST_F(CountTest, IsMetWithinATenth) {
  struct Case {
    std::string kind, volume, count, options;
  };
  const std::vector<Case> cases{
      {"voronoi", "--shape 48,48,48 --labels 20 --seed 1", "25000", ""},
      {"voronoi", "--shape 60,40,30 --labels 6 --seed 2", "40000", "--background 1"},
      {"spheres", "--shape 64,64,64 --labels 4 --seed 3", "20000", "--size '2=1,*=2'"},
      {"spheres", "--shape 40,40,80 --labels 9 --seed 4", "20000", "--background 0 --gradation 1"},
      {"tubes", "--shape 56,56,56 --labels 5 --seed 5", "30000", "--max-distance 1"},
      {"tubes", "--shape 64,48,32 --labels 3 --seed 6", "50000", "--spacing 1,1,2"},
      // From here on parts stand for the whole, and some miss the number at first.
      {"voronoi", "--shape 64,64,64 --labels 30 --seed 1", "20000", ""},
      {"voronoi", "--shape 64,64,64 --labels 30 --seed 1", "60000", ""},
      {"spheres", "--shape 90,60,60 --labels 9 --seed 2", "40000", "--background 0"},
      {"tubes", "--shape 60,60,40 --labels 5 --seed 5", "30000", "--spacing 1,1,2"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.kind + " " + c.volume + " " + c.options);
    synth(c.kind, c.volume);
    const json r = report_of("--count " + c.count + " " + c.options);
    const double asked = std::stod(c.count), got = r["output"]["tets"];
    EXPECT_NEAR(got / asked, 1.0, 0.1);
    EXPECT_EQ(r["size"]["count"]["asked"], static_cast<std::uint64_t>(asked));
    EXPECT_EQ(r["size"]["count"]["got"], r["output"]["tets"]);
    EXPECT_FALSE(r["size"]["count"]["is_least"]);
    EXPECT_FALSE(r["size"]["count"]["is_most"]);
    EXPECT_GT(r["size"]["count"]["pilot"]["meshes"], 0);
  }
}

TEST_F(CountTest, IsTheSameForAnyNumberOfThreads) {
  synth("voronoi", "--shape 40,40,40 --labels 10 --seed 7");
  expect_same_for_threads("--count 12000 --across 3 ", {"2", "3", "4"});
  synth("voronoi", "--shape 64,64,64 --labels 30 --seed 1");
  expect_same_for_threads("--count 20000 ", {"2"});
}

/// Parts of a volume stand for it, so that pilots take less than meshing it once does.
TEST_F(CountTest, MeshesPartsOfAVolume) {
  synth("voronoi", "--shape 72,72,72 --labels 20 --seed 3");
  const json pilot = report_of("--count 60000")["size"]["count"]["pilot"];
  EXPECT_LE(pilot["voxels"].get<double>(), 0.4 * 72 * 72 * 72);
}

/// A mesh that misses the number is made again, by a resumed run, too.
TEST_F(CountTest, ComesAgainWhereItMissed) {
  synth("voronoi", "--shape 64,64,64 --labels 30 --seed 1");
  const std::string mesh = "mesh v.npy -o v.vtu --report r.json --html p.html --count 20000";
  const ProgramRun stopped = run(mesh, "sh -c '(sleep 1; mkdir p.html) & exec \"$0\" \"$@\"'");
  ASSERT_EQ(stopped.code, 2) << stopped.err;
  const json whole = json::parse(read("r.json"));
  EXPECT_GT(whole["size"]["count"]["pilot"]["voxels"].get<double>(), 64 * 64 * 64);
  const std::string vtu = read("v.vtu");
  std::filesystem::remove(folder() / "p.html");
  expect_done(mesh + " --resume");
  EXPECT_EQ(json::parse(read("r.json"))["size"]["count"]["scale"], whole["size"]["count"]["scale"]);
  EXPECT_EQ(read("v.vtu"), vtu);
}

/// A run that is killed while it makes the first mesh, which misses, ends as one that was not.
TEST_F(CountTest, ComesAgainAfterAKill) {
  synth("voronoi", "--shape 64,64,64 --labels 30 --seed 1");
  const std::string mesh = "mesh v.npy --count 20000 --save-every 0 -o ";
  const auto begin = std::chrono::steady_clock::now();
  expect_done(mesh + "whole.vtu");
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
  int killed = 0;
  for (const double share : {0.1, 0.2, 0.4, 0.6, 0.8}) {
    SCOPED_TRACE(share);
    run(mesh + "v.vtu --force", io::text("timeout --foreground -s KILL ", share * whole.count()));
    if (!files().contains("v.vtu.work")) continue;
    ++killed;
    expect_done(mesh + "v.vtu --resume");
    EXPECT_EQ(read("v.vtu"), read("whole.vtu"));
    std::filesystem::remove(folder() / "v.vtu");
  }
  EXPECT_GT(killed, 0);
}

TEST_F(CountTest, MeetsItWithAnImageOfSizes) {
  synth("voronoi", "--shape 64,64,64 --labels 9 --seed 4");
  expect_done("mesh v.npy -o v.vtu --report r.json --size @v.npy --count 12000");
  EXPECT_NEAR(json::parse(read("r.json"))["output"]["tets"].get<double>(), 12000, 1200);
}

/// A part is never thinner than a slice, whatever the number of its layers.
TEST_F(CountTest, MeshesWithThickSlices) {
  synth("voronoi", "--shape 40,40,3 --labels 5 --seed 6");
  expect_done("mesh v.npy -o v.vtu --report r.json --spacing 1,1,50 --count 20000");
  EXPECT_NEAR(json::parse(read("r.json"))["output"]["tets"].get<double>(), 20000, 4000);
}

TEST_F(CountTest, MeetsItInACellOfOddShape) {
  synth("voronoi", "--shape 15,17,13 --labels 4 --seed 3");
  for (const std::string axes : {"x", "xyz"}) {
    expect_done(
        "mesh v.npy -o v.vtu --report r.json --count 1500 --force --background 1 --periodic " +
        axes);
    EXPECT_NEAR(json::parse(read("r.json"))["output"]["tets"].get<double>(), 1500, 150) << axes;
  }
}

TEST_F(CountTest, SaysOfALargerVolumeWhatCannotBeHad) {
  synth("tubes", "--shape 64,64,64 --labels 5 --seed 8");
  const ProgramRun done = run("mesh v.npy -o v.vtu --report r.json --count 100");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("fewer tets than"), std::string::npos) << done.err;
  EXPECT_TRUE(json::parse(read("r.json"))["size"]["count"]["is_least"]);
}

TEST_F(CountTest, SaysWhatCannotBeHad) {
  synth("voronoi", "--shape 24,24,24 --labels 8 --seed 8");
  for (const auto& [count, key, words] : {std::tuple{"10", "is_least", "fewer tets than"},
                                          std::tuple{"100000000", "is_most", "more tets than"}}) {
    const ProgramRun done =
        run(std::string("mesh v.npy -o v.vtu --report r.json --count ") + count);
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_NE(done.err.find(words), std::string::npos) << done.err;
    EXPECT_TRUE(json::parse(read("r.json"))["size"]["count"][key]) << count;
  }
}

/// With the size that was found the mesh has the number that was asked for.
TEST_F(CountTest, SaysTheSizeThatItFound) {
  synth("spheres", "--shape 48,48,48 --labels 3 --seed 2");
  const std::string out =
      run("mesh v.npy -o v.vtu --report r.json --background 0 --spacing 2,2,2 --count 8000").out;
  const json count = json::parse(read("r.json"))["size"]["count"];
  const std::string said = "\ncount       8,000 tets were asked: edges of about ";
  const std::size_t at = out.find(said);
  ASSERT_NE(at, out.npos) << out;
  const double size = std::stod(out.substr(at + said.size()));
  EXPECT_NEAR(size / count["size"].get<double>(), 1, 1e-3);
  EXPECT_LE(count["pilot"]["meshes"], 2);
  EXPECT_NEAR(static_cast<double>(
                  tets_of("--background 0 --spacing 2,2,2 --size " + std::to_string(size))) /
                  8000,
              1, 0.1);
  const std::string two = run("mesh v.npy -o v.vtu --size '1=2,*=3' --count 8000").out;
  EXPECT_NE(two.find("tets were asked: sizes are multiplied by "), two.npos) << two;
}

/// The factor reaches labels with a size alone, and what is said when that is not enough is true.
TEST_F(CountTest, SaysThatLabelsWithoutASizeAreOutOfReach) {
  synth("voronoi", "--shape 32,32,32 --labels 12 --seed 1");
  const json plain = report_of("");
  const std::uint64_t tets = plain["output"]["tets"];
  const std::uint64_t labels = plain["input"]["labels"];
  const auto count = [&](double share) {
    return std::to_string(static_cast<std::uint64_t>(share * static_cast<double>(tets)));
  };
  const auto without = [&](std::uint64_t number) {
    return io::text(number, " labels have no size, so no factor reaches their tets; add *=H");
  };
  struct Case {
    std::string options;
    std::uint64_t labels_without_size;
    std::string said, not_said;
  };
  const std::vector<Case> cases{
      {"--size 4=1 --count " + count(0.5), labels - 1, without(labels - 1), "--max-distance"},
      {"--size '4|1=1' --count " + count(0.5), labels, without(labels), "--max-distance"},
      {"--size '4|1=1' --count " + count(0.8), labels, without(labels), "--max-distance"},
      {"--size 4=1 --count 100000000", labels - 1, without(labels - 1), "cutting"},
      {"--size 4=1 --labels 4 --count 10", 0, "raise --max-distance", "no size"},
      {"--size '4=1,*=3' --count " + count(0.05), 0, "raise --max-distance", "no size"},
      {"--count 100000000", 0, "cutting tets", "no size"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.options);
    const ProgramRun done = run("mesh v.npy -o v.vtu --force --report r.json " + c.options);
    EXPECT_EQ(done.code, 0) << done.err;
    const json told = json::parse(read("r.json"))["size"]["count"];
    EXPECT_EQ(told["labels_without_size"], c.labels_without_size);
    EXPECT_NE(told["is_least"], told["is_most"]);
    EXPECT_NE(done.err.find(c.said), std::string::npos) << done.err;
    EXPECT_EQ(done.err.find(c.not_said), std::string::npos) << done.err;
    EXPECT_EQ(done.err.find("left out"), std::string::npos) << done.err;
  }
}

/// Parts are left out behind the pilot, which does not know of them.
TEST_F(CountTest, SaysThatPartsWereLeftOut) {
  synth("spheres", "--shape 24,24,24 --labels 3 --seed 4");
  const ProgramRun largest = run("mesh v.npy -o v.vtu --count 2000 --background 0 --parts largest");
  EXPECT_NE(largest.err.find("; the pilot expected "), std::string::npos) << largest.err;
  EXPECT_NE(largest.err.find(" parts were left out (--parts)"), std::string::npos) << largest.err;
}

/// A run whose page could not be written goes on with what its pilot found.
TEST_F(CountTest, IsNotAskedAgainByResume) {
  synth("voronoi", "--shape 32,32,32 --labels 6 --seed 7");
  const std::string mesh = "mesh v.npy -o v.vtu --report r.json --html p.html ";
  // The name of the page is taken while the run goes on.
  const ProgramRun stopped =
      run(mesh + "--count 6000", "sh -c '(sleep 0.5; mkdir p.html) & exec \"$0\" \"$@\"'");
  ASSERT_EQ(stopped.code, 2) << stopped.err;
  ASSERT_TRUE(files().contains("v.vtu.work")) << stopped.err;
  std::filesystem::remove(folder() / "p.html");
  const json whole = json::parse(read("r.json"))["size"]["count"];
  EXPECT_GT(whole["pilot"]["meshes"], 0);
  const std::string vtu = read("v.vtu");
  expect_failure(2, mesh + "--count 5000 --resume", "count was 6000 and is 5000");
  expect_done(mesh + "--count 6000 --resume");
  const json count = json::parse(read("r.json"))["size"]["count"];
  EXPECT_TRUE(count["pilot"].is_null());
  EXPECT_EQ(count["scale"], whole["scale"]);
  EXPECT_EQ(read("v.vtu"), vtu);
}

TEST_F(CountTest, MoreAcrossIsMoreTets) {
  synth("tubes", "--shape 48,48,48 --labels 4 --seed 9");
  std::uint64_t before = tets_of("");
  for (const std::string across : {"1", "2", "4"}) {
    const json r = report_of("--across " + across);
    EXPECT_GE(r["output"]["tets"], before) << across;
    EXPECT_EQ(r["size"]["across"]["asked"], std::stoi(across));
    EXPECT_GT(r["size"]["across"]["voxels"], 0);
    before = r["output"]["tets"];
  }
  EXPECT_NE(run("mesh v.npy -o v.vtu --across 16").err.find("too thin"), std::string::npos);
}

}  // namespace
}  // namespace mw::cli
