// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume whose smallest components have taken the labels around them (--drop-specks).
#pragma once

#include "io/labels/specks.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// What was changed.
struct SpeckFacts {
  std::uint64_t components = 0;
  std::uint64_t voxels = 0;
  int rounds = 0;
};

/// settle_specks() has the rule.  The volume is read twice at the start, plane by plane, which for
/// a file whose fastest axis is z takes several times as long as for others.  The volume is never
/// held; only the runs of voxels that change are.
/// Thread safety: as the volume below, which must outlive it.
class DespeckledVolume : public VolumeView {
 public:
  /// Memory: see find_specks() and find_contacts(); afterwards 20 bytes a run and 8 a speck.
  /// ERRORS: those of find_specks() and find_contacts(), and what the volume throws.
  DespeckledVolume(const LabelVolume& volume, const SpeckRule& rule,
                   const SpeckLimits& limits = {});

  [[nodiscard]] const SpeckFacts& facts() const { return facts_; }
  void read(const Box3& box, std::span<RawLabel> out) const override;
  /// Returns the bytes that this object holds.
  [[nodiscard]] std::uint64_t held_bytes() const;

 private:
  void find_planes();
  void change_row(Index3 first, std::span<RawLabel> row) const;

  std::vector<SpeckRun> runs_;     ///< the runs that change, ascending by z, y, begin
  std::vector<RawLabel> becomes_;  ///< by speck
  std::vector<std::size_t> plane_begin_;
  SpeckFacts facts_;
};

}  // namespace mw::io
