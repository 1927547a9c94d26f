// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The work folder and the files of a run are apart, or the run says so before any work.
#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

class PathsTest : public ProgramTest {};

/// The input is damaged behind its header: who began to read would say so.
TEST_F(PathsTest, WorkFoldersThatCollideAreRefusedBeforeWork) {
  make_volume();
  write("v.npy", read("v.npy").substr(0, 300));
  write("names.csv", "id,name\n1,one\n");
  const std::string mesh = "mesh v.npy -o m.vtu ";
  expect_failure(2, mesh + "--workdir m.vtu", "--workdir m.vtu: this is the output");
  expect_failure(2, mesh + "--workdir ./x/../m.vtu", "this is the output");
  expect_failure(2, mesh + "--workdir m.vtu/", "this is the output");
  expect_failure(2, mesh + "--workdir m.vtu/work", "lies in m.vtu, the output");
  expect_failure(2, mesh + "--workdir .", "has v.npy in it, the input");
  expect_failure(2, "mesh v.npy -o w/m.vtu --workdir w", "has w/m.vtu in it, the output");
  expect_failure(2, mesh + "--workdir v.npy", "this is the input");
  expect_failure(2, mesh + "--report r.json --workdir r.json", "this is --report");
  expect_failure(2, mesh + "--html r.html --workdir r.html", "this is --html");
  expect_failure(2, mesh + "--trace t.csv --workdir t.csv", "this is --trace");
  expect_failure(2, mesh + "--names names.csv --workdir names.csv", "this is --names");
  expect_failure(2, mesh + "--report m.vtu.work", "this is --report");
  expect_failure(2, "mesh v.npy -o m.xdmf --workdir m.h5", "this is the output");
  expect_failure(3, mesh + "--workdir m.vtu2", "v.npy");
}

TEST_F(PathsTest, LinksAreFollowed) {
  make_volume();
  std::filesystem::create_directory(folder() / "real");
  std::filesystem::create_symlink("real", folder() / "link");
  expect_failure(2, "mesh v.npy -o real/m.vtu --workdir link", "has real/m.vtu in it");
  expect_failure(2, "mesh v.npy -o link/m.vtu --workdir real/m.vtu", "this is the output");
  expect_done("mesh v.npy -o link/m.vtu --workdir real/work");
}

}  // namespace
}  // namespace mw::cli
