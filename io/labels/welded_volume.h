// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume in which labels that hang together by an edge or a corner are joined by faces (--weld).
#pragma once

#include <vector>

#include "io/labels/label_table.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// What was changed.
struct WeldFacts {
  std::uint64_t voxels = 0;
  int rounds = 0;
  bool has_solid = false;  ///< some voxel is no giver's; without one there is nothing to join
};

/// Fills voxels of some labels, the givers, with the other labels, which are solid.  A place is an
/// edge at which two solid voxels meet and the other two voxels are givers', or a corner at which
/// two do and the other six are.  One voxel is filled at an edge and two at a corner, until there
/// is no such place.
///
/// In a round all places are found in the volume as it was when the round began.  At an edge the
/// voxel with more solid neighbours across faces is filled, the first of two with as many.  A
/// filled voxel takes the label that most of these neighbours have, the smaller label of two.  Each
/// round makes the solid larger, so that there is a last one.
///
/// The volume is read once in tiles, afterwards only where something changed; only the voxels that
/// changed are held.
/// Thread safety: as the volume below, which must outlive it.
class WeldedVolume : public VolumeView {
 public:
  /// REQUIRES: givers are not empty.
  /// ERRORS: mw::Error(kUsage) for a giver that the volume does not have; mw::Error(kResource) when
  /// the voxels that change take more than `memory` bytes; what the volume throws.
  WeldedVolume(const LabelVolume& volume, const std::vector<RawLabel>& givers,
               std::uint64_t memory);

  [[nodiscard]] const WeldFacts& facts() const { return facts_; }
  void read(const Box3& box, std::span<RawLabel> out) const override;
  /// Returns the bytes that this object holds.
  [[nodiscard]] std::uint64_t held_bytes() const { return filled_.capacity() * sizeof(Filled); }

 private:
  struct Filled {
    std::int64_t at = 0;  ///< offset of the voxel, x fastest
    RawLabel label = 0;
  };
  class Tile;
  class Round;

  void check_givers(const std::vector<char>& seen) const;
  /// Adds what one round fills.  REQUIRES: found ascends, each voxel once.
  void keep(const std::vector<Filled>& found);

  LabelTable givers_;
  std::vector<Filled> filled_;  ///< ascending
  WeldFacts facts_;
};

}  // namespace mw::io
