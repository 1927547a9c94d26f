// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6, of values of tets: what is set aside is no less than what is allocated.
#include "engine/finish/sample.h"

#include <numeric>

#include "io/mesh/mesh_data.h"
#include "tests/engine/memory/counted_memory.h"
#include "tests/engine/memory_run.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

constexpr std::size_t kSortBytes = 1 << 16;
/// Runs of the sort, and what allocators round up.
constexpr std::uint64_t kFixedBytes = 256 << 10;

TEST(Promise6BoundedMemory, OfValuesOfTets) {
  for (const Statistic statistic : {Statistic::kMean, Statistic::kMode}) {
    std::mt19937 random(77);
    const SmallVolume voxels =
        random_volume_of(random, static_cast<VolumeKind>(0), {24, 20, 22}, 5);
    const MemoryVolume file(voxels, {});
    // Each voxel has a value of its own, so that shares are as many as can be.
    SmallVolume numbers{.shape = {60, 50, 40}};
    numbers.labels.resize(static_cast<std::size_t>(numbers.shape.product()));
    std::iota(numbers.labels.begin(), numbers.labels.end(), 0);
    const auto image = std::make_shared<MemoryVolume>(numbers, Frame{.spacing = {0.4, 0.4, 0.55}});
    ImageSampler sampler({{.name = "x", .statistic = statistic, .image = image}}, file.info(), 2);
    const ::mw::test::TempFolder folder;
    io::ScratchMesh mesh(folder.path());
    {
      const SmallMesh tets = five_tet_mesh(voxels);
      mesh.add_vertices(tets.vertices);
      mesh.add_tets(tets.tets, std::vector<RawLabel>(tets.labels.begin(), tets.labels.end()));
    }
    const std::uint64_t before = mw::test::allocated_bytes();
    mw::test::start_peak();
    sample(mesh, sampler, kSortBytes, [] {});
    EXPECT_LE(mw::test::peak_allocated_bytes() - before,
              io::ScratchMesh::kBufferBytes + bytes_to_sample(sampler, kSortBytes) + kFixedBytes);
  }
}

}  // namespace
}  // namespace mw::engine
