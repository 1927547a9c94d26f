// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Damaged files of solver formats are errors or other meshes, never a crash or all memory.
#include <random>

#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

/// A mesh of two labels whose files are then damaged.
class SolverDamage : public testing::Test {
 protected:
  void make(const std::string& name, Element element = Element::kTet10) {
    path_ = dir_.path() / name;
    write_mesh(grid_mesh({2, 1, 1}, 1), *open_mesh_sink(path_, element));
  }

  /// Whether the mesh was refused; anything but an error of input fails the test.
  [[nodiscard]] bool refused(const std::string& what) const {
    try {
      const MeshData mesh = read_mesh(path_);
      EXPECT_LE(mesh.tets.size(), 1000U) << what;
      for (const TetRows& tet : mesh.tets) {
        for (const std::uint64_t row : tet) EXPECT_LT(row, mesh.vertices.size()) << what;
      }
      return false;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << what << ": " << error.what();
      return true;
    }
  }

  void cut_everywhere(const std::string& name, std::size_t step) {
    const std::string good = content_of(dir_.path() / name);
    for (std::size_t size = 0; size < good.size(); size += step) {
      dir_.file(name, good.substr(0, size));
      EXPECT_TRUE(refused("cut at " + std::to_string(size)));
    }
    dir_.file(name, good);
  }

  void flip_anywhere(const std::string& name, int times) {
    const std::string good = content_of(dir_.path() / name);
    std::mt19937 random(7);
    int errors = 0;
    for (int i = 0; i < times; ++i) {
      std::string bad = good;
      const std::size_t at = random() % bad.size();
      // Digits as often as anything else: they are what lies.
      bad[at] = random() % 2 == 0 ? static_cast<char>('0' + random() % 10)
                                  : static_cast<char>(random() % 256);
      dir_.file(name, bad);
      errors += refused("byte " + std::to_string(at)) ? 1 : 0;
    }
    EXPECT_GT(errors, times / 20);
    dir_.file(name, good);
  }

  TempDir dir_;
  std::filesystem::path path_;
};

TEST_F(SolverDamage, OfTetgen) {
  make("m.node");
  cut_everywhere("m.node", 3);
  cut_everywhere("m.ele", 3);
  flip_anywhere("m.node", 500);
  flip_anywhere("m.ele", 500);
  flip_anywhere("m.node.labels.csv", 100);
}

TEST_F(SolverDamage, OfFebio) {
  make("m.feb");
  const std::string good = content_of(path_);
  // Behind the last tag nothing is lost.
  dir_.file("m.feb", good.substr(0, good.size() - 1));
  EXPECT_FALSE(refused("without the last line end"));
  dir_.file("m.feb", good.substr(0, good.size() - 1));
  cut_everywhere("m.feb", 29);
  flip_anywhere("m.feb", 500);
}

TEST_F(SolverDamage, OfXdmf) {
  make("m.xdmf");
  const std::string good = content_of(path_);
  for (std::size_t size = 0; size + 1 < good.size(); size += 83) {
    dir_.file("m.xdmf", good.substr(0, size));
    EXPECT_TRUE(refused("cut at " + std::to_string(size)));
  }
  dir_.file("m.xdmf", good);
  flip_anywhere("m.xdmf", 150);
}

TEST_F(SolverDamage, OfItsNumbers) {
  make("m.xdmf");
  const std::string good = content_of(dir_.path() / "m.h5");
  int errors = 0;
  for (std::size_t at = 0; at < good.size(); at += 72) {
    std::string bad = good;
    for (std::size_t i = at; i < std::min(at + 8, good.size()); ++i) bad[i] = '\xff';
    dir_.file("m.h5", bad);
    errors += refused("ones at " + std::to_string(at)) ? 1 : 0;
  }
  EXPECT_GT(errors, 20);
  dir_.file("m.h5", good);
  cut_everywhere("m.h5", 397);
}

TEST_F(SolverDamage, OfTenNodesInVtk) {
  make("m.vtu");
  flip_anywhere("m.vtu", 500);
  make("m.vtkhdf");
  const std::string good = content_of(path_);
  int errors = 0;
  for (std::size_t at = 0; at < good.size(); at += 72) {
    std::string bad = good;
    for (std::size_t i = at; i < std::min(at + 8, good.size()); ++i) bad[i] = '\xff';
    dir_.file("m.vtkhdf", bad);
    errors += refused("ones at " + std::to_string(at)) ? 1 : 0;
  }
  EXPECT_GT(errors, 20);
}

}  // namespace
}  // namespace mw::io
