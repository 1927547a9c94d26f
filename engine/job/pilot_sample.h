// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The parts of a volume that stand for the whole in a pilot mesh (count_pilot.h).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/labels/prepared_labels.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/output/label_selection.h"
#include "kernels/core/index.h"

namespace mw::engine {

/// What a box of the lattice holds of labels that are written.
struct BoxContent {
  std::int64_t faces = 0;  ///< between two labels
  std::int64_t voxels = 0;

  BoxContent& operator+=(const BoxContent& other) {
    faces += other.faces;
    voxels += other.voxels;
    return *this;
  }
};

/// A part of the volume that is meshed, and what of it counts.
struct PilotPart {
  Box3 voxels;          ///< of the volume
  Box3 within;          ///< whose tets count, in the lattice of these voxels
  double weight = 0.0;  ///< tets of the volume for each that counts
};

/// Cuts a lattice into boxes, of which some are meshed and stand for all.
///
/// A lattice of up to `max_cut` voxels is cut into some eight boxes.  One of them is meshed: that
/// in which faces and voxels are mixed most as in the whole, among those that have half of their
/// share or more.  A larger one is cut into boxes of 80 voxels, and up to 16 of them are drawn,
/// evenly along the volume and without any random number, with chances in proportion to what they
/// hold.  Tets within 8 voxels of a cut do not count.
class PilotSample {
 public:
  /// REQUIRES: all that is given outlives the object.
  PilotSample(const VoxelLattice& lattice, const PreparedLabels& labels, const LabelSelection& kept,
              std::int64_t max_cut);

  /// Returns what the whole lattice holds.
  [[nodiscard]] const BoxContent& content() const { return total_; }
  /// Returns the parts that are meshed; none where the lattice is too small for any but the whole.
  /// A voxel counts as `faces_a_voxel` faces.
  [[nodiscard]] std::vector<PilotPart> parts(double faces_a_voxel) const;

 private:
  struct Box {
    Box3 lattice;
    Box3 within;  ///< of it, what is not near a cut
    BoxContent counted;
  };

  [[nodiscard]] BoxContent content_of(const Box3& box) const;
  [[nodiscard]] BoxContent content_of_slab(const Box3& box) const;
  [[nodiscard]] PilotPart part_of(const Box& box, double weight) const;
  [[nodiscard]] const Box* most_typical(double faces_a_voxel) const;
  [[nodiscard]] std::vector<PilotPart> drawn(double faces_a_voxel) const;

  const VoxelLattice& lattice_;
  const PreparedLabels& labels_;
  const LabelSelection& kept_;
  bool is_cut_in_few_ = false;
  std::vector<Box> boxes_;
  BoxContent total_;
};

}  // namespace mw::engine
