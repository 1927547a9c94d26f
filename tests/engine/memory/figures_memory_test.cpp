// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6: what a finished mesh and the measuring of it hold does not grow with the mesh.
#include "engine/finish/figures.h"
#include "io/file/scratch/scratch_file.h"
#include "tests/engine/memory/counted_memory.h"

namespace mw::engine {
namespace {

/// Histograms, lists of runs of sorts, and what allocators round up.
constexpr std::uint64_t kFixedBytes = 256 << 10;

/// A bar of cubes, every second one another label, five tets each.
void stream_bar(std::uint64_t cubes, io::MeshSink& sink) {
  const auto plane = [](std::uint64_t x) {
    const auto at = static_cast<double>(x);
    return std::vector<io::Position>{{at, 0, 0}, {at, 1, 0}, {at, 0, 1}, {at, 1, 1}};
  };
  sink.begin({.tets = 5 * cubes});
  sink.write_vertices(plane(0));
  for (std::uint64_t x = 0; x < cubes; ++x) {
    sink.write_vertices(plane(x + 1));
    const std::uint64_t a = 4 * x;
    const std::uint64_t b = a + 4;
    // The diagonals of the planes by turns.
    const std::vector<io::TetRows> tets =
        x % 2 == 0 ? std::vector<io::TetRows>{{a, a + 1, a + 2, b},
                                              {a + 1, a + 2, a + 3, b + 3},
                                              {b, b + 1, b + 3, a + 1},
                                              {b, b + 2, b + 3, a + 2},
                                              {a + 1, a + 2, b, b + 3}}
                   : std::vector<io::TetRows>{{a, a + 1, a + 3, b + 1},
                                              {a, a + 2, a + 3, b + 2},
                                              {b, b + 1, b + 2, a},
                                              {b + 1, b + 2, b + 3, a + 3},
                                              {a, a + 3, b + 1, b + 2}};
    sink.write_tets(tets, std::vector<RawLabel>(5, x % 2));
  }
  sink.finish();
}

TEST(Promise6BoundedMemory, OfMeasuringAMeshOfAnyLength) {
  constexpr std::uint64_t kCubes = 200'000;
  const std::uint64_t before = mw::test::allocated_bytes();
  mw::test::start_peak();
  io::ScratchMesh mesh(io::scratch_folder());
  io::ScratchMeshSink sink(mesh);
  stream_bar(kCubes, sink);
  const FiguresTask task{.sort_bytes = 1 << 20};
  const audit::ShapeReport shape = measure(mesh, task).shape;
  EXPECT_LE(mw::test::peak_allocated_bytes() - before,
            io::ScratchMesh::kBufferBytes + bytes_to_measure(task) + kFixedBytes);
  EXPECT_EQ(shape.triangles, 2 * (kCubes - 1));
  EXPECT_NEAR(shape.area, kCubes - 1, 1e-6);
}

}  // namespace
}  // namespace mw::engine
