// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6 for the sinks: memory does not grow with the mesh.
#include "io/mesh/digest.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/open_mesh.h"
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

/// Cubes of six tets each; labels are blocks of them.
struct Cubes {
  std::uint64_t along = 0;     ///< along each edge
  std::uint64_t of_block = 1;  ///< likewise

  [[nodiscard]] std::uint64_t row(const std::array<std::uint64_t, 3>& at) const {
    return (at[2] * (along + 1) + at[1]) * (along + 1) + at[0];
  }
  [[nodiscard]] std::uint64_t tets() const { return 6 * along * along * along; }
};

/// Writes six tets around the diagonal of each cube of a layer.
void write_layer(const Cubes& cubes, std::uint64_t z, MeshSink& sink) {
  constexpr std::array<std::array<std::size_t, 3>, 6> kWays{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  std::vector<TetRows> tets;
  std::vector<RawLabel> labels;
  for (std::uint64_t cube = 0; cube < cubes.along * cubes.along; ++cube) {
    const std::uint64_t x = cube % cubes.along;
    const std::uint64_t y = cube / cubes.along;
    for (const auto& way : kWays) {
      std::array<std::uint64_t, 3> at{x, y, z};
      TetRows& tet = tets.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) {
        tet[i] = cubes.row(at);
        if (i < 3) ++at[way[i]];
      }
      const std::uint64_t block = cubes.of_block, blocks = cubes.along / block;
      labels.push_back(1 + (z / block * blocks + y / block) * blocks + x / block);
    }
  }
  sink.write_tets(tets, labels);
}

void write_plane(const Cubes& cubes, std::uint64_t z, MeshSink& sink) {
  std::vector<Position> positions;
  for (std::uint64_t y = 0; y <= cubes.along; ++y) {
    for (std::uint64_t x = 0; x <= cubes.along; ++x) {
      positions.push_back(
          {static_cast<double>(x) / 3, static_cast<double>(y) / 7, static_cast<double>(z) / 9});
    }
  }
  sink.write_vertices(positions);
}

/// Returns what writing the cubes takes, in KiB.
long growth_of_writing(const Cubes& cubes, const std::filesystem::path& path) {
  return test::growth_of([&] {
    const std::unique_ptr<MeshSink> sink = open_mesh_sink(path);
    sink->begin({.tets = cubes.tets()});
    write_plane(cubes, 0, *sink);
    for (std::uint64_t z = 0; z < cubes.along; ++z) {
      write_plane(cubes, z + 1, *sink);
      write_layer(cubes, z, *sink);
    }
    sink->finish();
    EXPECT_GE(sink->buffer_bytes(), std::uint64_t{64} << 20);
  });
}

TEST(Promise6BoundedMemory, OfFormatsThatGroupTets) {
  if (!mw::test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  const TempDir dir;
  for (const char* name : {"m.msh", "m.inp"}) {
    const auto path = dir.path() / name;
    const long growth = growth_of_writing({.along = 60, .of_block = 10}, path);
    EXPECT_GE(growth, 0) << name;
    EXPECT_LE(growth, 64 * 1024 + kRoomKib) << name;
    EXPECT_GT(std::filesystem::file_size(path), 40U << 20) << name;
    RecordProperty(std::string(name) + "_growth_kib", std::to_string(growth));
  }
}

/// Formats with names hold those of labels, but not those of their interfaces, which are more.
TEST(Promise6BoundedMemory, OfMeshesWithManyInterfaces) {
  if (!mw::test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  const TempDir dir;
  for (const char* name :
       {"m.msh", "m.msh2", "m.inp", "m.exo", "m.bdf", "m.k", "m.cdb", "m.feb", "m.xdmf"}) {
    const long growth = growth_of_writing({.along = 48}, dir.path() / name);
    EXPECT_GE(growth, 0) << name;
    EXPECT_LE(growth, 64 * 1024 + kRoomKib) << name;
    RecordProperty(std::string(name) + "_growth_kib", std::to_string(growth));
  }
}

}  // namespace
}  // namespace mw::io
