// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Gather and scatter between blocks and the mesh of a window.
#include "engine/window/window.h"

#include <algorithm>
#include <utility>

#include "kernels/core/error.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {
namespace {

void check_extent(const BlockTet& t, std::span<const BlockVertex> vertices) {
  Point lo = vertices[t.vertices[0]].position, hi = lo;
  for (const std::uint32_t v : t.vertices) {
    const Point p = vertices[v].position;
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  const std::int64_t extent =
      std::max({std::int64_t{hi.x} - lo.x, std::int64_t{hi.y} - lo.y, std::int64_t{hi.z} - lo.z});
  if (extent > kMaxTetExtent) {
    throw Error(ErrorKind::kInternal, "a tetrahedron outgrew the range of exact arithmetic");
  }
}

std::int32_t lattice(std::int64_t voxels) {
  return static_cast<std::int32_t>(voxels * kUnitsPerVoxel);
}

/// Tets and samples of a block that is being made, with rows of the window.
struct Share {
  std::vector<BlockTet> tets;
  std::vector<BlockSample> samples;
};

/// Makes the block of a share.  row is scratch: a number for each vertex, 0 before and afterwards.
BlockMesh pack(const TetMesh& mesh, Share share, std::vector<std::uint32_t>& row) {
  BlockMesh out;
  std::size_t used = 0;
  for (const BlockTet& t : share.tets) {
    for (LocalVertex v : t.vertices) used += std::exchange(row[v], 1U) == 0 ? 1U : 0U;
  }
  out.vertices.reserve(used);
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (row[v] == 0) continue;
    row[v] = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(mesh.vertex(v));
  }
  for (BlockTet& t : share.tets) {
    for (std::uint32_t& v : t.vertices) v = row[v];
  }
  for (BlockSample& s : share.samples) {
    for (std::uint32_t& v : s.triangle) v = row[v];
  }
  make_canonical(share.samples, used);
  out.tets = std::move(share.tets);
  out.samples = std::move(share.samples);
  std::fill(row.begin(), row.end(), 0U);
  return out;
}

/// Adds the samples on the faces of a tet that is on their side.
void take_samples(const WindowContent& content, const BlockTet& tet, Share& share) {
  if (content.samples.empty()) return;
  const auto& v = tet.vertices;
  const std::array<TriangleKey, 4> faces{
      {{v[1], v[2], v[3]}, {v[0], v[2], v[3]}, {v[0], v[1], v[3]}, {v[0], v[1], v[2]}}};
  const auto may_carry = [&](LocalVertex w) {
    return !content.mesh.is_free(w) || content.mesh.on_interface(w);
  };
  for (const TriangleKey& face : faces) {
    if (!may_carry(face[0]) || !may_carry(face[1]) || !may_carry(face[2])) continue;
    if (!content.samples.has(face, tet.label)) continue;
    for (const FaceSamples s : content.samples.of(face)) {
      share.samples.push_back({face, tet.label, s});
    }
  }
}

/// Finds the places, among the blocks of a window, of those that own tets.
class Owners {
 public:
  Owners(const WindowGrid& grid, Index3 window) : above_(grid.least_sums_above(window)) {
    const Index3 blocks = grid.blocks();
    row_ = window.x + 1 < blocks.x ? 2 : 1;
    layer_ = window.y + 1 < blocks.y ? 2 * row_ : row_;
  }

  [[nodiscard]] std::uint8_t of(const TetMesh& mesh, const BlockTet& tet) const {
    std::array<std::int64_t, 3> sum{};
    for (LocalVertex v : tet.vertices) {
      const Point p = mesh.position(v);
      sum[0] += p.x;
      sum[1] += p.y;
      sum[2] += p.z;
    }
    return static_cast<std::uint8_t>((sum[0] >= above_[0] ? 1U : 0U) +
                                     (sum[1] >= above_[1] ? row_ : 0U) +
                                     (sum[2] >= above_[2] ? layer_ : 0U));
  }

 private:
  std::array<std::int64_t, 3> above_;
  unsigned row_ = 1;    ///< blocks of the window in a row
  unsigned layer_ = 1;  ///< and in a layer
};

}  // namespace

Point lattice_corner(Index3 volume) {
  return {lattice(volume.x), lattice(volume.y), lattice(volume.z)};
}

WindowContent gather(std::vector<BlockMesh> blocks, Index3 volume, BoxPlanes inner) {
  BlockMesh merged = merge_blocks(std::move(blocks));
  for (const BlockTet& t : merged.tets) check_extent(t, merged.vertices);
  CarriedSamples samples;
  for (const BlockSample& s : merged.samples) samples.add(s.triangle, s.side, s.samples);
  merged.samples = {};
  const bool one_label =
      std::all_of(merged.tets.begin(), merged.tets.end(),
                  [&](const BlockTet& t) { return t.label == merged.tets[0].label; });
  return {TetMesh(merged.vertices, merged.tets, lattice_corner(volume), inner), std::move(samples),
          one_label};
}

std::vector<BlockMesh> scatter(const WindowContent& content, const WindowGrid& grid,
                               Index3 window) {
  const TetMesh& mesh = content.mesh;
  const std::size_t blocks = grid.blocks_of(window).size();
  std::vector<BlockTet> tets = mesh.sorted_tets();
  for (BlockTet& t : tets) t.label = without_side(t.label);
  const std::size_t count = tets.size();
  std::vector<std::uint8_t> owners;
  owners.reserve(count);
  const Owners owners_of(grid, window);
  for (const BlockTet& t : tets) owners.push_back(owners_of.of(mesh, t));
  std::vector<std::uint32_t> row(mesh.vertex_count());
  std::vector<BlockMesh> out;
  // Blocks are made one by one, so that only one list at a time has room that it does not need.
  for (std::size_t block = 0; block < blocks; ++block) {
    Share share;
    for (std::size_t i = 0; i < count; ++i) {
      if (owners[i] != block) continue;
      share.tets.push_back(tets[i]);
      take_samples(content, tets[i], share);
    }
    share.tets.shrink_to_fit();
    out.push_back(pack(mesh, std::move(share), row));
  }
  return out;
}

Box3 voxels_around(const TetMesh& mesh, std::int64_t halo) {
  Point lo = mesh.position(0), hi = lo;
  for (LocalVertex v = 1; v < mesh.vertex_count(); ++v) {
    const Point p = mesh.position(v);
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  const auto floor_voxel = [](std::int32_t u) { return std::int64_t{u} / kUnitsPerVoxel; };
  const Index3 around{halo, halo, halo};
  return {Index3{floor_voxel(lo.x), floor_voxel(lo.y), floor_voxel(lo.z)} - around,
          Index3{floor_voxel(hi.x) + 1, floor_voxel(hi.y) + 1, floor_voxel(hi.z) + 1} + around};
}

}  // namespace mw::engine
