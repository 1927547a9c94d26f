// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A final block in the coordinates that are written.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/output/label_selection.h"
#include "io/labels/label_table.h"
#include "io/mesh/mesh_sink.h"
#include "io/volume/volume_space.h"
#include "kernels/core/lattice.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// Returns the place in the volume's space of a point of the lattice that cuts its voxels into
/// layers.  Each coordinate is divided once, so that corners of voxels stay whole numbers.
[[nodiscard]] inline io::Position physical(Point p, const io::VolumeSpace& space,
                                           Index3 layers = {1, 1, 1}) {
  const auto in_voxels = [](std::int32_t units, std::int64_t of_voxel) {
    return static_cast<double>(units) / static_cast<double>(of_voxel * kUnitsPerVoxel);
  };
  return to_world(space,
                  {in_voxels(p.x, layers.x), in_voxels(p.y, layers.y), in_voxels(p.z, layers.z)});
}

/// A final block as sinks take it, except that tets name vertices by their rows in the block.
struct WrittenBlock {
  BlockMesh block;                      ///< the part that is written
  std::vector<io::Position> positions;  ///< places of its vertices in the volume's space
  std::vector<io::TetRows> tets;        ///< positively oriented in the world, by rows of the block
  std::vector<RawLabel> labels;         ///< by tet
};

/// layers are those that each voxel of the volume was cut into.
[[nodiscard]] WrittenBlock written_block(BlockMesh block, const io::DenseVolume& volume,
                                         Index3 layers);

/// Replaces rows of the block by those of the mesh.
void give_rows(std::vector<io::TetRows>& tets, std::span<const std::uint64_t> rows);

/// Returns what is known of the mesh before its first row is written.
[[nodiscard]] io::MeshHeader header_of(const io::DenseVolume& volume,
                                       const LabelSelection& selection, std::uint64_t tets,
                                       const std::optional<io::MeshPromises>& promises);

}  // namespace mw::engine
