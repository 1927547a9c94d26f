// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6 for the sinks: memory does not grow with the mesh.
#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"
#include "io/mesh/tee_sink.h"
#include "tests/io/test_files.h"
#include "tests/peak_growth.h"
#include "tests/sanitizers.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kTets = 5'000'000;
constexpr std::uint64_t kBatch = 1000;  ///< tets of a block
/// Buffers of a sink, of HDF5, and of the allocator, which keeps those that grew.
constexpr long kRoomKib = 24 * 1024;

/// A fifth as many vertices as tets, by turns, never more than one batch in memory.
void stream_into(MeshSink& sink) {
  sink.begin({.tets = kTets});
  std::vector<Position> positions(kBatch / 5);
  std::vector<TetRows> tets(kBatch);
  std::vector<RawLabel> labels(kBatch);
  for (std::uint64_t first = 0; first < kTets; first += kBatch) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const std::uint64_t row = first / 5 + i;
      const auto x = static_cast<double>(row);
      positions[i] = {x / 1024, -x / 3, 1 / (x + 1)};
    }
    for (std::size_t i = 0; i < kBatch; ++i) {
      const std::uint64_t row = (first + i) / 5;
      tets[i] = {row, row / 2, row / 3, row - row % 100};
      labels[i] = row % 1000;
    }
    sink.write_vertices(positions);
    sink.write_tets(tets, labels);
  }
  sink.finish();
}

TEST(Promise6BoundedMemory, OfEverySink) {
  if (!mw::test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  const TempDir dir;
  for (const char* name : {"m.vtkhdf", "m.vtu", "m.mesh"}) {
    const auto path = dir.path() / name;
    const long growth = test::growth_of([&] { stream_into(*open_mesh_sink(path)); });
    EXPECT_GE(growth, 0) << name;
    EXPECT_LE(growth, kRoomKib) << name;
    EXPECT_GT(std::filesystem::file_size(path), 150U << 20) << name;
    RecordProperty(std::string(name) + "_growth_kib", std::to_string(growth));
    if (path.extension() != ".vtkhdf") std::filesystem::remove(path);
  }
  // Reading it back, too, takes no more.
  const long growth = test::growth_of([&] {
    DigestSink digest(dir.path());
    copy_mesh(dir.path() / "m.vtkhdf", digest);
    static_cast<void>(digest.digest());
  });
  EXPECT_GE(growth, 0);
  EXPECT_LE(growth, kRoomKib + 2 * static_cast<long>(DigestSink::kMemoryBytes >> 10) + 10 * 1024);
  RecordProperty("digest_growth_kib", std::to_string(growth));
}

// Promise 6 for the formats that group tets: memory does not grow with the mesh.

constexpr std::uint64_t kCubes = 60;  ///< along each edge; 1.3 million tets

std::uint64_t row_of(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return (z * (kCubes + 1) + y) * (kCubes + 1) + x;
}

/// Six tets around the diagonal of each cube of a layer; labels in blocks of 10 x 10 x 10 cubes.
void write_layer(std::uint64_t z, MeshSink& sink) {
  constexpr std::array<std::array<std::size_t, 3>, 6> kWays{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  std::vector<TetRows> tets;
  std::vector<RawLabel> labels;
  for (std::uint64_t cube = 0; cube < kCubes * kCubes; ++cube) {
    const std::uint64_t x = cube % kCubes;
    const std::uint64_t y = cube / kCubes;
    for (const auto& way : kWays) {
      std::array<std::uint64_t, 3> at{x, y, z};
      TetRows& tet = tets.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) {
        tet[i] = row_of(at[0], at[1], at[2]);
        if (i < 3) ++at[way[i]];
      }
      labels.push_back(1 + (z / 10 * 6 + y / 10) * 6 + x / 10);
    }
  }
  sink.write_tets(tets, labels);
}

void write_plane(std::uint64_t z, MeshSink& sink) {
  std::vector<Position> positions;
  for (std::uint64_t y = 0; y <= kCubes; ++y) {
    for (std::uint64_t x = 0; x <= kCubes; ++x) {
      positions.push_back(
          {static_cast<double>(x) / 3, static_cast<double>(y) / 7, static_cast<double>(z) / 9});
    }
  }
  sink.write_vertices(positions);
}

TEST(Promise6BoundedMemory, OfFormatsThatGroupTets) {
  if (!mw::test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  const TempDir dir;
  for (const char* name : {"m.msh", "m.inp"}) {
    const auto path = dir.path() / name;
    const long growth = test::growth_of([&] {
      const std::unique_ptr<MeshSink> sink = open_mesh_sink(path);
      sink->begin({.tets = 6 * kCubes * kCubes * kCubes});
      write_plane(0, *sink);
      for (std::uint64_t z = 0; z < kCubes; ++z) {
        write_plane(z + 1, *sink);
        write_layer(z, *sink);
      }
      sink->finish();
      EXPECT_GE(sink->buffer_bytes(), std::uint64_t{64} << 20);
    });
    EXPECT_GE(growth, 0) << name;
    EXPECT_LE(growth, 64 * 1024 + kRoomKib) << name;
    EXPECT_GT(std::filesystem::file_size(path), 40U << 20) << name;
    RecordProperty(std::string(name) + "_growth_kib", std::to_string(growth));
  }
}

}  // namespace
}  // namespace mw::io
