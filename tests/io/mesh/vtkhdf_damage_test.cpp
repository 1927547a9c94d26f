// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Damaged .vtkhdf meshes are errors; the HDF5 library crashes on some of them.
#include "io/mesh/apart_mesh.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/sample_mesh.h"

namespace mw::io {
namespace {

/// Reads the mesh or throws the error of bad input; anything else fails the test.
void try_mesh(const std::filesystem::path& path, std::size_t position, int& refused) {
  try {
    const MeshData mesh = read_mesh(path);
    ASSERT_LE(mesh.tets.size(), 1000U) << position;
  } catch (const Error& error) {
    ASSERT_EQ(error.kind(), ErrorKind::kInput) << position << ": " << error.what();
    ++refused;
  }
}

TEST(VtkhdfDamage, EightBytesOfOnesAnywhere) {
  const TempDir dir;
  const auto path = dir.path() / "good.vtkhdf";
  write_mesh(sample_mesh(7, false), *open_mesh_sink(path));
  const std::string good = content_of(path);
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); at += 8) {
    std::string bad = good;
    for (std::size_t i = at; i < std::min(at + 8, good.size()); ++i) bad[i] = '\xff';
    try_mesh(dir.file("bad.vtkhdf", bad), at, refused);
  }
  EXPECT_GT(refused, 100);
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
