// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One allocation that fails, whichever it is, is exit 4 or does no harm; never a crash.
#include "tests/engine/cli/run_program.h"
#include "tests/io/mesh/mesh_endings.h"
#include "tests/sanitizers.h"

namespace mw::cli {
namespace {

/// False where not every allocation is ours to survive: sanitizers bring their own allocator, and
/// libgcov (.ci/coverage) allocates at the exit and crashes where it gets nothing.
#ifdef MW_COVERAGE
constexpr bool kAllocationsAreOurs = false;
#else
constexpr bool kAllocationsAreOurs = mw::test::kResidentMemoryIsOurs;
#endif

class FailingMalloc : public ProgramTest {
 protected:
  /// v.npy and m.vtu, small.
  void make_inputs() const {
    expect_done("synth voronoi --shape 8,8,8 --labels 3 --seed 1 -o v.npy");
    expect_done("mesh v.npy -o m.vtu");
  }

  static std::string preloaded(const std::string& more) {
    return "LD_PRELOAD='" MW_FAILING_MALLOC "' " + more;
  }

  [[nodiscard]] unsigned long count(const std::string& arguments) const {
    const ProgramRun counted = run(arguments, preloaded("FAILING_MALLOC_COUNT=count"));
    EXPECT_EQ(counted.code, 0) << counted.err;
    return std::stoul("0" + read("count"));
  }

  /// Fails about this many of the allocations of a run that writes `output`.
  void fail_some(const std::string& arguments, const std::string& output, unsigned times) const {
    const unsigned long all = count(arguments);
    ASSERT_GT(all, 500U) << "the module is not there";
    const std::string whole = read(output);
    for (unsigned long n = 1; n < all; n += all / times + 1) {
      std::filesystem::remove(folder() / output);
      const ProgramRun failed = run(arguments, preloaded("FAILING_MALLOC_AT=" + std::to_string(n)));
      if (failed.code == 0) {
        EXPECT_EQ(read(output), whole) << n;
        continue;
      }
      EXPECT_EQ(failed.code, 4) << arguments << ", allocation " << n << ": " << failed.err;
      EXPECT_NE(failed.err.find("memory"), std::string::npos) << failed.err;
      std::filesystem::remove_all(folder() / (output + ".work"));
    }
    expect_done(arguments);
    EXPECT_EQ(read(output), whole);
    for (const std::string& name : files()) EXPECT_EQ(name.find("partial"), name.npos) << name;
  }
};

TEST_F(FailingMalloc, ConvertEndsWithFourInEveryFormat) {
  if (!kAllocationsAreOurs) GTEST_SKIP() << "a sanitizer or libgcov allocates, too";
  make_inputs();
  const std::vector<std::string> endings = io::mesh_endings();
  EXPECT_GE(endings.size(), 7U);
  for (const std::string& ending : endings) {
    fail_some("convert m.vtu o" + ending, "o" + ending, 15);
  }
}

TEST_F(FailingMalloc, MeshEndsWithFourInEveryFormat) {
  if (!kAllocationsAreOurs) GTEST_SKIP() << "a sanitizer or libgcov allocates, too";
  make_inputs();
  for (const std::string name : {"o.vtkhdf", "o.xdmf", "o.vtu", "o.msh"}) {
    fail_some("mesh v.npy --threads 2 --progress none --report r.json -o " + name, name, 25);
  }
}

}  // namespace
}  // namespace mw::cli
