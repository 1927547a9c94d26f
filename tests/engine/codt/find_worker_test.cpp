// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The worker is found beside the program and in the prefix of a library, and nowhere else.
#include "engine/codt/find_worker.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include "kernels/core/error.h"
#include "tests/testing.h"

namespace mw::engine::codt {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using Path = std::filesystem::path;

const std::string kPrograms = MW_INSTALLED_PROGRAMS;

std::vector<Path> junctions_of(const Path& object) {
  return worker_paths({.program = "/usr/bin/python3.11", .object = object});
}

/// The variable as it was, when the test is over.
class HeldVariable {
 public:
  HeldVariable() {
    const char* const value = std::getenv(kWorkerVariable);  // NOLINT(concurrency-mt-unsafe)
    if (value != nullptr) was_ = value;
  }
  ~HeldVariable() {
    if (was_.empty())
      ::unsetenv(kWorkerVariable);  // NOLINT(concurrency-mt-unsafe)
    else
      ::setenv(kWorkerVariable, was_.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
  }
  HeldVariable(const HeldVariable&) = delete;
  HeldVariable& operator=(const HeldVariable&) = delete;

 private:
  std::string was_;
};

TEST(FindWorker, LooksBesideTheProgramFirst) {
  EXPECT_EQ(junctions_of("/opt/x/libmwmesh.so").front(), "/usr/bin/mwmesh-codt");
}

TEST(FindWorker, LooksBesideTheLibrary) {
  EXPECT_THAT(junctions_of("/opt/x/libmwmesh.so"), Contains(Path("/opt/x/mwmesh-codt")));
}

TEST(FindWorker, LooksInThePrefixOfALibraryWhereverItWasMoved) {
  const Path library = Path("/moved/here") / MW_INSTALLED_LIBRARY / "libmwmesh.so.0.1";
  EXPECT_THAT(junctions_of(library), Contains(Path("/moved/here") / kPrograms / "mwmesh-codt"));
}

TEST(FindWorker, LooksWhereTheBuildIsInstalled) {
  EXPECT_EQ(junctions_of({}).back(), Path(MW_INSTALL_PREFIX) / kPrograms / "mwmesh-codt");
}

// As in a chroot without /proc.
TEST(FindWorker, LooksWhereTheBuildIsInstalledWhenNothingIsKnown) {
  EXPECT_EQ(worker_paths({}).size(), 1U);
}

// A user who may write to /tmp must not decide what a library in /tmp/x starts.
TEST(FindWorker, LooksNowhereAboveAFolderThatIsNoPrefix) {
  EXPECT_EQ(junctions_of("/tmp/x/libmwmesh.so").size(), 3U);
  EXPECT_EQ(junctions_of(Path("/tmp/x" + std::string(MW_INSTALLED_LIBRARY)) / "l.so").size(), 3U);
}

TEST(FindWorker, TheHostIsThisProgram) {
  const WorkerHost host = this_host();
  EXPECT_TRUE(std::filesystem::is_regular_file(host.program));
  // A name that PATH resolved tells no place.
  if (!host.object.empty()) {
    EXPECT_EQ(host.object, host.program);
  }
}

TEST(FindWorker, TheVariableIsAskedFirstAndAlone) {
  const HeldVariable held;
  ::setenv(kWorkerVariable, "/bin/true", 1);  // NOLINT(concurrency-mt-unsafe)
  EXPECT_EQ(find_worker(), "/bin/true");
  ::setenv(kWorkerVariable, "/no/such/worker", 1);  // NOLINT(concurrency-mt-unsafe)
  try {
    (void)find_worker();
    FAIL() << "found what is not there";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_THAT(error.what(), HasSubstr("/no/such/worker"));
  }
}

}  // namespace
}  // namespace mw::engine::codt
