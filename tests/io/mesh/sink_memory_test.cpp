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
/// Buffers of a sink, of HDF5, and of the allocator.
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

}  // namespace
}  // namespace mw::io
