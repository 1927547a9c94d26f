// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Small meshes, and what connect() makes of them.
#pragma once

#include <map>

#include "engine/connect/connect_mesh.h"
#include "io/mesh/mesh_data.h"
#include "tests/oracle/small_volumes.h"
#include "tests/temp_folder.h"

namespace mw::engine::test {

using audit::test::below;
using audit::test::five_tet_mesh;
using audit::test::kVolumeKinds;
using audit::test::random_volume_of;
using audit::test::SmallMesh;
using audit::test::SmallVolume;
using audit::test::VolumeKind;

/// Five tets a voxel, without those of labels below one, and without vertices that no tet has.
inline io::MeshData mesh_without(const SmallVolume& volume, std::uint32_t left_out) {
  const SmallMesh all = five_tet_mesh(volume);
  io::MeshData out;
  std::map<std::uint64_t, std::uint64_t> rows;
  for (std::size_t t = 0; t < all.tets.size(); ++t) {
    if (all.labels[t] < left_out) continue;
    io::TetRows& tet = out.tets.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [at, is_new] = rows.try_emplace(all.tets[t][i], out.vertices.size());
      if (is_new) out.vertices.push_back(all.vertices[all.tets[t][i]]);
      tet[i] = at->second;
    }
    out.labels.push_back(all.labels[t]);
  }
  return out;
}

inline io::MeshData random_mesh(unsigned seed) {
  std::mt19937 random(seed);
  const auto kind = static_cast<VolumeKind>(seed % kVolumeKinds);
  const Index3 shape{2 + below(random, 5), 2 + below(random, 5), 2 + below(random, 6)};
  const std::uint32_t left_out = below(random, 3);
  return mesh_without(random_volume_of(random, kind, shape, 4), left_out);
}

struct Connected {
  io::MeshData mesh;
  ConnectFacts facts;
};

inline Connected connect(const io::MeshData& mesh, const ConnectOptions& options,
                         std::size_t memory = 1 << 16, int threads = 1) {
  const ::mw::test::TempFolder folder;
  io::ScratchMesh stored(folder.path());
  io::ScratchMeshSink into(stored);
  io::write_mesh(mesh, into);
  Connected out{.mesh = {}, .facts = engine::connect(stored, {options, memory, memory, threads})};
  io::MeshDataSink back;
  stored.copy_to(back);
  out.mesh = std::move(back.mesh());
  return out;
}

}  // namespace mw::engine::test
