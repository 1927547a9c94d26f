// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// --count and --across: what is asked is what is got, the same for any number of threads, and a run
// that goes on does not ask anew.
#include <cmath>
#include <nlohmann/json.hpp>

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
      {"tubes", "--shape 64,48,32 --labels 3 --seed 6", "50000", "--spacing 1,1,2"}};
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
  const std::string count = "--count 12000 --across 3 ";
  const json one = report_of(count + "--threads 1");
  for (const std::string threads : {"2", "3", "4"}) {
    const json other = report_of(count + "--threads " + threads);
    EXPECT_EQ(other["digest"], one["digest"]) << threads;
    EXPECT_EQ(other["size"]["count"]["scale"], one["size"]["count"]["scale"]) << threads;
  }
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
  EXPECT_GT(whole["pilot"]["meshes"], 1);
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
