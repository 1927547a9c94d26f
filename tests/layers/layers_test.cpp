// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The way data goes: no file includes what is above it or beside its trade.
#include <regex>

#include "tests/layers/rules.h"
#include "tests/temp_folder.h"

namespace mw::layers {
namespace {

using mw::test::content_of;
using Tree = std::map<std::string, std::vector<Include>>;  ///< path from the root -> its includes

Tree read_tree() {
  const std::filesystem::path root = MW_SOURCE_DIR;
  Tree tree;
  for (const char* top : {"kernels", "io", "engine"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      const std::string name = entry.path().lexically_relative(root).generic_string();
      tree[name] = includes_of(content_of(entry.path()));
    }
  }
  return tree;
}

/// Follows the quoted includes from `file`; the first circle found, as "a -> b -> a".
class CircleFinder {
 public:
  explicit CircleFinder(const Tree& tree) : tree_(tree) {}

  std::string find() {
    for (const auto& [file, includes] : tree_) {
      if (visit(file)) return circle_;
    }
    return {};
  }

 private:
  enum class State { kNew, kOpen, kDone };

  bool visit(const std::string& file) {
    State& state = states_[file];
    circle_ = file;
    if (state != State::kNew) return state == State::kOpen;
    state = State::kOpen;
    const auto found = tree_.find(file);
    for (const Include& include : found == tree_.end() ? std::vector<Include>{} : found->second) {
      if (!include.quoted || !visit(include.name)) continue;
      circle_ = file + " -> " + circle_;
      return true;
    }
    states_[file] = State::kDone;
    return false;
  }

  const Tree& tree_;
  std::map<std::string, State> states_;
  std::string circle_;
};

TEST(Layers, NoFileIncludesWhatItMayNot) {
  const Tree tree = read_tree();
  ASSERT_GT(tree.size(), 50U);
  for (const auto& [file, includes] : tree) {
    for (const Include& include : includes) {
      const std::optional<std::string> reason = why_forbidden(file, include);
      EXPECT_FALSE(reason) << *reason;
    }
  }
}

/// std::filesystem's iterator ends the process where memory is out; entries_in of io/file does not.
TEST(Layers, NoFileListsAFolderByAnIterator) {
  for (const auto& [file, includes] : read_tree()) {
    const std::string content = content_of(std::filesystem::path(MW_SOURCE_DIR) / file);
    EXPECT_EQ(content.find("directory_iterator"), std::string::npos) << file;
  }
}

/// The C library's functions differ in last digits between processors and versions; those of
/// kernels/core/elementary.h do not.  Audits tell figures alone.  std::hypot of three numbers may
/// stay: libstdc++ makes it of square roots.
TEST(Layers, NoFileCallsFunctionsThatDifferAmongMachines) {
  const std::regex calls(
      "std::(exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|sin|cos|tan|asin|acos|"
      "atan|atan2|sinh|cosh|tanh|tgamma|lgamma|erf)\\(");
  for (const auto& [file, includes] : read_tree()) {
    if (file.starts_with("kernels/audit/")) continue;
    const std::string content = content_of(std::filesystem::path(MW_SOURCE_DIR) / file);
    std::smatch found;
    EXPECT_FALSE(std::regex_search(content, found, calls)) << file << ": " << found.str();
  }
}

TEST(Layers, NoCircleOfHeaders) {
  const Tree tree = read_tree();
  EXPECT_EQ(CircleFinder(tree).find(), "");
}

TEST(Layers, FindsACircle) {
  const Tree tree{{"a.h", {{"b.h", true}}}, {"b.h", {{"c.h", true}}}, {"c.h", {{"b.h", true}}}};
  EXPECT_NE(CircleFinder(tree).find().find("b.h -> c.h -> b.h"), std::string::npos);
  EXPECT_EQ(CircleFinder({{"a.h", {{"b.h", true}}}, {"b.h", {}}}).find(), "");
}

TEST(Layers, ReadsIncludeLines) {
  const std::vector<Include> expected{{"a/b.h", true}, {"vector", false}, {"c.h", true}};
  EXPECT_EQ(includes_of("#include \"a/b.h\"\n#include <vector>\n// #include <no>\n"
                        "int x;\n  #  include \"c.h\"  // why\n"),
            expected);
}

struct Edge {
  const char* file;
  Include include;
};

TEST(Layers, RuleForbids) {
  const Edge edges[] = {
      {"kernels/mesh/a.cpp", {"io/mesh/mesh_sink.h", true}},
      {"kernels/mesh/a.cpp", {"engine/run/run.h", true}},
      {"kernels/mesh/a.cpp", {"tbb/parallel_for.h", false}},
      {"kernels/mesh/a.cpp", {"boost/multiprecision/cpp_int.hpp", false}},
      {"kernels/mesh/a.cpp", {"fstream", false}},
      {"kernels/mesh/a.cpp", {"chrono", false}},
      {"kernels/mesh/a.cpp", {"unistd.h", false}},
      {"kernels/mesh/a.cpp", {"malloc.h", false}},
      {"kernels/mesh/a.cpp", {"kernels/audit/audit.h", true}},
      {"kernels/core/a.h", {"kernels/mesh/tet_mesh.h", true}},
      {"kernels/audit/a.cpp", {"kernels/quality/quality.h", true}},
      {"io/mesh/a.cpp", {"engine/run/run.h", true}},
      {"io/mesh/a.cpp", {"kernels/mesh/tet_mesh.h", true}},
      {"io/mesh/a.cpp", {"tbb/parallel_for.h", false}},
      {"io/mesh/a.cpp", {"boost/interprocess/mapped_region.hpp", false}},
      {"engine/a.cpp", {"io/volume/npy/open_npy.h", true}},
      {"engine/a.cpp", {"io/mesh/vtu/vtu.h", true}},
      {"engine/a.cpp", {"io/volume/open_volume.h", true}},
      {"engine/a.cpp", {"io/mesh/open_mesh.h", true}},
      {"engine/a.cpp", {"engine/cli/program.h", true}},
      {"engine/cli/a.cpp", {"nlohmann/json.hpp", false}},
      {"engine/cli/a.cpp", {"CLI/CLI.hpp", false}},
      {"engine/cli/serve/a.cpp", {"microhttpd.h", false}},
      {"engine/a.cpp", {"microhttpd.h", false}},
      {"io/remote/a.cpp", {"microhttpd.h", false}},
      {"engine/run/a.cpp", {"engine/team/team_processes.h", true}},
      {"engine/store/a.cpp", {"engine/team/team_processes.h", true}},
      {"engine/march/a.cpp", {"engine/team/team_processes.h", true}},
      {"engine/labels/a.cpp", {"engine/team/team_processes.h", true}},
      {"engine/output/a.cpp", {"engine/team/team_processes.h", true}},
      {"engine/job/a.cpp", {"engine/team/team_processes.h", true}},
      {"engine/cli/a.cpp", {"engine/team/team_processes.h", true}},
      {"engine/api/a.cpp", {"engine/team/team_processes.h", true}},
      {"engine/store/a.cpp", {"engine/window/window.h", true}},
      {"engine/store/a.cpp", {"engine/output/finish.h", true}},
      {"engine/march/a.cpp", {"engine/store/run_store.h", true}},
      {"engine/march/a.cpp", {"engine/window/window_visitor.h", true}},
      {"engine/window/a.cpp", {"engine/store/run_store.h", true}},
      {"engine/output/a.cpp", {"engine/store/run_store.h", true}},
      {"engine/system/a.cpp", {"engine/settings/settings.h", true}},
      {"engine/labels/a.cpp", {"engine/run/run.h", true}},
      {"engine/picture/a.cpp", {"engine/run/run.h", true}},
      {"engine/run/a.cpp", {"engine/picture/draw.h", true}},
      {"engine/new_room/a.cpp", {"engine/run/run.h", true}},
      {"engine/job/a.cpp", {"engine/api/jobs.h", true}},
      {"engine/cli/a.cpp", {"engine/api/jobs.h", true}},
      {"engine/api/a.cpp", {"engine/cli/values.h", true}},
      {"engine/api/a.cpp", {"io/mesh/vtu/vtu.h", true}},
      {"engine/mwmesh.h", {"engine/run/run.h", true}},
      {"engine/mwmesh_c.h", {"cstdint", false}},
      {"engine/mwmesh.h", {"Eigen/Dense", false}},
      {"engine/cli/a.cpp", {"tests/engine/a.h", true}},
      {"engine/cli/a.h", {"tetgen.h", false}},
      {"kernels/odt/a.h", {"tetgen.h", true}},
      {"engine/codt/a.cpp", {"tetgen.h", false}},
      {"engine/cli/a.cpp", {"tetgen.h", false}},
      {"engine/codt/worker/a.cpp", {"tetgen.h", false}},
      {"engine/codt/a.cpp", {"engine/codt/worker/constrained_delaunay.h", true}},
      {"engine/a.cpp", {"engine/codt/worker/constrained_delaunay.h", true}},
      {"kernels/odt/a.cpp", {"engine/codt/wire.h", true}},
      {"somewhere/a.cpp", {"vector", false}},
  };
  for (const Edge& edge : edges) {
    EXPECT_TRUE(why_forbidden(edge.file, edge.include)) << edge.file << " " << edge.include.name;
  }
}

TEST(Layers, RuleAllows) {
  const Edge edges[] = {
      {"kernels/mesh/a.cpp", {"kernels/core/index.h", true}},
      {"kernels/mesh/a.cpp", {"kernels/quadric/quadric.h", true}},
      {"kernels/mesh/a.cpp", {"Eigen/Dense", false}},
      {"kernels/mesh/a.cpp", {"vector", false}},
      {"kernels/audit/a.cpp", {"boost/multiprecision/cpp_int.hpp", false}},
      {"kernels/audit/a.cpp", {"kernels/audit/check.h", true}},
      {"io/mesh/vtu/a.cpp", {"pugixml.hpp", false}},
      {"io/file/a.cpp", {"fcntl.h", false}},
      {"io/json/json.cpp", {"nlohmann/json.hpp", false}},
      {"io/mesh/a.cpp", {"openssl/evp.h", false}},
      {"io/mesh/a.cpp", {"kernels/core/label.h", true}},
      {"engine/a.cpp", {"io/volume/label_volume.h", true}},
      {"engine/a.cpp", {"io/mesh/mesh_sink.h", true}},
      {"engine/a.cpp", {"kernels/simplify/simplify.h", true}},
      {"engine/a.cpp", {"engine/store/run_store.h", true}},
      {"engine/api/a.cpp", {"io/mesh/open_mesh.h", true}},
      {"engine/api/a.cpp", {"engine/picture/draw.h", true}},
      {"engine/picture/a.cpp", {"io/mesh/grouped/grouped_mesh.h", true}},
      {"engine/mpi/main.cpp", {"engine/team/team_processes.h", true}},
      {"engine/mwmesh.h", {"span", false}},
      {"engine/mwmesh.h", {"mwmesh_c.h", true}},
      {"engine/mwmesh_c.h", {"stdint.h", false}},
      {"engine/store/a.cpp", {"engine/window/block_store.h", true}},
      {"engine/march/a.cpp", {"engine/window/window_grid.h", true}},
      {"engine/a.cpp", {"tbb/flow_graph.h", false}},
      {"engine/a.cpp", {"chrono", false}},
      {"engine/codt/worker/constrained_delaunay.cpp", {"tetgen.h", false}},
      {"engine/codt/worker/a.cpp", {"engine/codt/worker/constrained_delaunay.h", true}},
      {"engine/codt/a.cpp", {"boost/interprocess/mapped_region.hpp", false}},
      {"engine/cli/a.cpp", {"io/mesh/open_mesh.h", true}},
      {"engine/cli/command_line.cpp", {"CLI/CLI.hpp", false}},
      {"engine/cli/serve/folder_server.cpp", {"microhttpd.h", false}},
  };
  for (const Edge& edge : edges) {
    EXPECT_FALSE(why_forbidden(edge.file, edge.include)) << edge.file << " " << edge.include.name;
  }
}

}  // namespace
}  // namespace mw::layers
