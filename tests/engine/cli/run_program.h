// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Runs the built program as a user does: arguments, environment, exit code, output.
#pragma once

#include <sys/wait.h>

#include "tests/temp_folder.h"
#include "tests/testing.h"

namespace mw::cli {

struct ProgramRun {
  int code = -1;
  std::string out;
  std::string err;
};

using mw::test::content_of;

/// A test with an empty folder that is the program's working directory.
class ProgramTest : public testing::Test {
 protected:
  /// Runs `prefix program arguments` in a shell; prefix holds variables or a wrapping command.
  ProgramRun run(const std::string& arguments, const std::string& prefix = {}) const {
    const std::string command = "cd '" + folder_.path().string() + "' && " + prefix + " '" +
                                MW_PROGRAM + "' " + arguments + " >.out 2>.err </dev/null";
    const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe)
    ProgramRun result;
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    result.out = content_of(folder_.path() / ".out");
    result.err = content_of(folder_.path() / ".err");
    std::filesystem::remove(folder_.path() / ".out");
    std::filesystem::remove(folder_.path() / ".err");
    return result;
  }

  /// Expects exit code and a message with this piece.
  void expect_failure(int code, const std::string& arguments, const std::string& piece,
                      const std::string& prefix = {}) const {
    const std::set<std::string> before = files();
    const ProgramRun result = run(arguments, prefix);
    EXPECT_EQ(result.code, code) << arguments << "\n" << result.err;
    EXPECT_NE(result.err.find("mwmesh: error: "), std::string::npos) << arguments;
    EXPECT_NE(result.err.find(piece), std::string::npos) << arguments << "\n" << result.err;
    EXPECT_EQ(files(), before) << arguments << ": left files behind";
  }

  void expect_done(const std::string& arguments, const std::string& prefix = {}) const {
    const ProgramRun result = run(arguments, prefix);
    EXPECT_EQ(result.code, 0) << arguments << "\n" << result.err << result.out;
  }

  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << content;
  }

  [[nodiscard]] std::string read(const std::string& name) const {
    return content_of(folder_.path() / name);
  }

  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

  /// v.npy: 20^3 voxels of convex grains.
  void make_volume(const std::string& name = "v.npy", int seed = 1) const {
    expect_done("synth voronoi --shape 20,20,20 --labels 12 --seed " + std::to_string(seed) +
                " -o " + name);
  }

 private:
  mw::test::TempFolder folder_;
};

}  // namespace mw::cli
