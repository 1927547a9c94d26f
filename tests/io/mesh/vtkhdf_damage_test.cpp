// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Damaged .vtkhdf meshes are errors; the HDF5 library crashes on some of them.
#include "io/mesh/apart_mesh.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/sample_mesh.h"
#include "tests/io/mesh/written_mesh.h"

namespace mw::io {
namespace {

/// Eight bytes of ones at every step of a file; returns how many of these were refused.
int refused_of(const MeshData& mesh, Element element, std::size_t step) {
  const TempDir dir;
  const auto path = dir.path() / "good.vtkhdf";
  save(mesh, path, element);
  const std::string good = content_of(path);
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); at += step) {
    std::string bad = good;
    for (std::size_t i = at; i < std::min(at + 8, good.size()); ++i) bad[i] = '\xff';
    try_mesh(dir.file("bad.vtkhdf", bad), at, refused);
  }
  return refused;
}

TEST(VtkhdfDamage, EightBytesOfOnesAnywhere) {
  EXPECT_GT(refused_of(sample_mesh(7, false), Element::kTet4, 8), 100);
  EXPECT_GT(refused_of(grid_mesh({2, 1, 1}, 1), Element::kTet10, 72), 20);
}

TEST(VtuDamage, OfTenNodes) {
  const TempDir dir;
  save(grid_mesh({2, 1, 1}, 1), dir.path() / "m.vtu", Element::kTet10);
  EXPECT_GT(try_damage(dir, "m.vtu", content_of(dir.path() / "m.vtu")), 30);
}

/// What a reader that broke could send.
TEST(ApartMesh, NoRowIsTakenOnTrust) {
  const std::vector<Position> points(4, Position{0, 0, 0});
  const std::vector<TetRows> tets{{0, 1, 2, 4}};
  const std::vector<RawLabel> labels{1};
  const auto pass = [](const std::function<void(MeshSink&)>& read) {
    MeshDataSink out;
    return pass_mesh_apart({}, read, out);
  };
  EXPECT_NE(pass([](MeshSink&) {}), "");
  EXPECT_NE(pass([](MeshSink& sink) { sink.begin({}); }), "");
  EXPECT_NE(pass([&](MeshSink& sink) { sink.write_vertices(points), sink.finish(); }), "");
  const auto read = [&](std::span<const Position> vertices) {
    return [&, vertices](MeshSink& sink) {
      sink.begin({.tets = 1});
      sink.write_vertices(vertices);
      sink.write_tets(tets, labels);
      sink.finish();
    };
  };
  EXPECT_NE(pass(read(points)), "");
  const std::vector<Position> enough(5, Position{0, 0, 0});
  EXPECT_EQ(pass(read(enough)), "");
  const std::vector<Position> too_many(kMaxApartRows + 1, Position{0, 0, 0});
  EXPECT_NE(pass(read(too_many)), "");
}

/// An error of the one that receives ends the child.
TEST(ApartMesh, ErrorsOfTheSinkPass) {
  class FullDisk : public MeshDataSink {
    void write_vertices(std::span<const Position>) override {
      throw Error(ErrorKind::kResource, "disk full");
    }
  };
  FullDisk out;
  const std::vector<Position> points(4, Position{0, 0, 0});
  expect_error(ErrorKind::kResource, {"disk full"}, [&] {
    static_cast<void>(pass_mesh_apart(
        {},
        [&](MeshSink& sink) {
          sink.begin({});
          while (true) sink.write_vertices(points);
        },
        out));
  });
}

}  // namespace
}  // namespace mw::io
