// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Small volumes of many kinds, and the mesh of five tets a voxel, for tests of the whole tree.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "kernels/audit/subject.h"

namespace mw::audit::test {

/// A volume that owns its labels.
struct SmallVolume {
  Index3 shape;
  std::size_t label_count = 1;
  std::vector<Label> labels;

  [[nodiscard]] VoxelLabels view() const { return {shape, labels}; }
  /// The labels as one string, for failure messages.
  [[nodiscard]] std::string text() const;
};

/// Whole number below `count`, the same with every standard library.
[[nodiscard]] std::uint32_t below(std::mt19937& random, std::uint32_t count);

/// Shape 1 .. 5 an axis, 1 .. 4 labels; noise, sponges, blobs, checkerboards, shells or rings by
/// turns, some with a few voxels changed.
[[nodiscard]] SmallVolume random_volume(std::mt19937& random);

/// Kinds of random volumes: the six of random_volume(), thin sheets with holes, single voxels.
enum class VolumeKind {
  kNoise,
  kBlobs,
  kCheckerboard,
  kSponge,
  kShells,
  kRings,
  kSheets,
  kSpecks,
};
inline constexpr std::uint32_t kVolumeKinds = 8;

[[nodiscard]] VolumeKind random_kind(std::mt19937& random);

/// Each edge is from min to max.
[[nodiscard]] Index3 random_shape(std::mt19937& random, std::uint32_t min, std::uint32_t max);

/// A volume of one kind, any shape and number of labels.  Not every label need occur.
[[nodiscard]] SmallVolume random_volume_of(std::mt19937& random, VolumeKind kind, Index3 shape,
                                           std::uint32_t labels);

/// A volume from a function of position, labels 0 .. label_count-1.
template <class LabelAt>
SmallVolume volume_from(Index3 shape, std::size_t label_count, LabelAt&& label_at) {
  SmallVolume volume{shape, label_count, {}};
  for (std::int64_t z = 0; z < shape.z; ++z) {
    for (std::int64_t y = 0; y < shape.y; ++y) {
      for (std::int64_t x = 0; x < shape.x; ++x) {
        volume.labels.push_back(static_cast<Label>(label_at(x, y, z)));
      }
    }
  }
  return volume;
}

/// A mesh that owns its arrays.
struct SmallMesh {
  std::vector<Position> vertices;
  std::vector<TetRow> tets;
  std::vector<Label> labels;

  [[nodiscard]] AuditMesh view() const { return {vertices, tets, labels}; }
};

/// Five positive tets a voxel, mirrored by parity so that neighbours' triangles match.
[[nodiscard]] SmallMesh five_tet_mesh(const SmallVolume& volume, const Frame& frame = {});

/// The mesh without other labels, and without the vertices that none of its tets has.
[[nodiscard]] SmallMesh kept_part(const SmallMesh& mesh, const KeptLabels& kept);

}  // namespace mw::audit::test
