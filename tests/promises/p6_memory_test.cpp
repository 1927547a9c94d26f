// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6: the kernel's own figure of the program's memory stays under --memory, from reading
// labels to the digest of the finished mesh.
#include <nlohmann/json.hpp>

#include "tests/engine/cli/run_program.h"
#include "tests/sanitizers.h"

namespace mw::cli {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMebibyte = 1 << 20;

class MemoryProgramTest : public ProgramTest {
 protected:
  void make(const std::string& kind, const std::string& shape, int labels) const {
    expect_done("synth " + kind + " --shape " + shape + " --labels " + std::to_string(labels) +
                " --seed 1 -o v.npy");
  }

  /// The least budget that a message names; 0: none.
  static std::uint64_t advised_mebibytes(const std::string& message) {
    for (const std::string_view before : {"is less than ", "--memory "}) {
      const std::size_t at = message.find(before);
      if (at != message.npos) return std::stoull(message.substr(at + before.size()));
    }
    return 0;
  }

  /// Runs with less memory than works, then with the least that is asked for, until it is done;
  /// the report of the last run.
  json under_min_budget(const std::string& options, const std::string& volume = "v.npy") const {
    const std::string start =
        "mesh " + volume + " -o v.vtu --report r.json " + options + " --memory ";
    std::string budget = "1";
    for (int i = 0; i < 8; ++i) {
      const ProgramRun result = run((start + budget).append("MiB"));
      if (result.code == 0) return json::parse(read("r.json"));
      EXPECT_EQ(result.code, 4) << result.err;
      const std::uint64_t advised = advised_mebibytes(result.err);
      EXPECT_GT(advised, std::stoull(budget)) << result.err;
      budget = std::to_string(advised);
      std::filesystem::remove_all(folder() / "v.vtu.work");
    }
    ADD_FAILURE() << "the budgets that are asked for do not suffice";
    return {};
  }

  static void expect_within(const json& report) {
    const std::uint64_t budget = report["engine"]["memory_budget_bytes"];
    EXPECT_LE(report["engine"]["peak_accounted_bytes"], budget);
    if (!mw::test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
    EXPECT_LE(report["performance"]["peak_rss_bytes"], budget);
    // Windows and blocks are there as well: the figure is of the program that meshed.
    EXPECT_GT(report["performance"]["peak_rss_bytes"], 10 * kMebibyte);
  }
};

TEST_F(MemoryProgramTest, Promise6LeastBudgetBoundsResidentMemory) {
  make("voronoi", "64,48,48", 20);
  for (const char* options :
       {"--start coarse --threads 1", "--start octree --threads 4", "--start dense --threads 2"}) {
    SCOPED_TRACE(options);
    const json r = under_min_budget(options);
    ASSERT_FALSE(r.is_null());
    expect_within(r);
  }
}

TEST_F(MemoryProgramTest, Promise6HoldsForNoiseAndManyThreads) {
  make("noise", "30,26,26", 1000);
  for (const char* threads : {"2", "8"}) {
    SCOPED_TRACE(threads);
    const json r = under_min_budget(std::string("--window 16 --threads ") + threads);
    ASSERT_FALSE(r.is_null());
    expect_within(r);
  }
}

/// A chunk that is the whole volume is unpacked to a file, piece by piece.
TEST_F(MemoryProgramTest, Promise6HoldsForOneLargeChunk) {
  expect_done("synth spheres --shape 160,128,128 --labels 2 --seed 1 --dtype u64 -o v.npy");
  std::filesystem::create_directory(folder() / "v.zarr");
  std::ofstream(folder() / "v.zarr" / ".zarray")
      << R"({"zarr_format": 2, "shape": [128, 128, 160], "chunks": [128, 128, 160],
             "dtype": "<u8", "order": "C", "fill_value": 0, "filters": null,
             "compressor": {"id": "gzip", "level": 1}})";
  const std::string in = folder().string();
  const std::string pack = "tail -c +193 " + in + "/v.npy | gzip -1 > " + in + "/v.zarr/0.0.0";
  ASSERT_EQ(std::system(pack.c_str()), 0);
  const json r = under_min_budget("--threads 2 --certify off", "v.zarr");
  ASSERT_FALSE(r.is_null());
  expect_within(r);
  // The chunk is 20 MiB, and would not have a place twice over beside all else.
  EXPECT_LT(r["engine"]["memory_budget_bytes"], 80 * kMebibyte);
  expect_done("mesh v.npy -o plenty.vtu --memory 4GiB");
  EXPECT_EQ(read("v.vtu"), read("plenty.vtu"));
}

/// Blocks have to go to disk, and the merge has to read them back.
TEST_F(MemoryProgramTest, Promise6HoldsWhenBlocksAreSpilled) {
  make("voronoi", "112,64,64", 60);
  const json r = under_min_budget("--threads 2");
  ASSERT_FALSE(r.is_null());
  expect_within(r);
  EXPECT_GT(r["engine"]["bytes_written"], 0);
  expect_done("mesh v.npy -o plenty.vtu --memory 4GiB");
  EXPECT_EQ(read("v.vtu"), read("plenty.vtu"));
}

/// getrusage's figure begins with the memory of the process that started it; VmHWM does not.
TEST_F(MemoryProgramTest, ReportsItsOwnMemoryAndNotItsStarters) {
  if (!mw::test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  make_volume();
  const ProgramRun result = run("mesh v.npy -o v.vtu --report r.json",
                                "sh -c 'held=$(head -c 150000000 /dev/zero | tr \"\\\\0\" x); "
                                "exec \"$@\"' sh");
  ASSERT_EQ(result.code, 0) << result.err;
  const json r = json::parse(read("r.json"));
  EXPECT_LT(r["performance"]["peak_rss_bytes"], 100 * kMebibyte);
}

/// Dust in a ball: its specks want more than all else.
TEST_F(MemoryProgramTest, TheBudgetThatSpecksAskForWorks) {
  constexpr int kSize = 136;
  std::string voxels;
  for (int z = 0; z < kSize; ++z) {
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const bool dust = x % 2 == 1 && y % 2 == 1 && z % 2 == 1;
        voxels += dust ? '\x03' : x < kSize / 2 ? '\x01' : '\x02';
      }
    }
  }
  std::ofstream(folder() / "v.raw") << voxels;
  const std::string options =
      "mesh v.raw --shape 136,136,136 --dtype u8 -o v.vtu --drop-specks 2 --threads 1 --memory ";
  const ProgramRun refused = run(options + "16MiB");
  EXPECT_EQ(refused.code, 4) << refused.err;
  EXPECT_NE(refused.err.find("components are smaller"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("is enough"), std::string::npos);
  const std::uint64_t advised = advised_mebibytes(refused.err);
  EXPECT_GT(advised, 16U);
  expect_done(options + std::to_string(advised) + "MiB");
}

TEST_F(MemoryProgramTest, TellsAtOnceWhenNothingCouldWork) {
  make_volume();
  const ProgramRun result = run("mesh v.npy -o v.vtu --memory 10MiB");
  EXPECT_EQ(result.code, 4);
  EXPECT_GT(advised_mebibytes(result.err), 10U) << result.err;
  EXPECT_EQ(files(), (std::set<std::string>{"v.npy"}));
}

}  // namespace
}  // namespace mw::cli
