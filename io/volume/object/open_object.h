// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds an object in a volume that has coarser copies, and shows it alone (--object).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "io/volume/object/object_cells.h"

namespace mw::io {

/// The label of all that is not the object.
inline constexpr RawLabel kNotTheObject = 0;
/// How many voxels around an object its volume has.
inline constexpr std::int64_t kObjectMargin = 4;

/// A volume in which all voxels except an object's are kNotTheObject.  Only cells of the object are
/// read.
/// Thread safety: that of the volume below.
class ObjectVolume : public VolumeView {
 public:
  ObjectVolume(std::unique_ptr<LabelVolume> volume, ObjectLabels labels, ObjectCells cells);

  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  ObjectLabels labels_;
  ObjectCells cells_;
};

/// The most voxels of a copy that are looked through to find where an object is.
inline constexpr std::uint64_t kMostScannedVoxels = std::uint64_t{1} << 32;

/// A volume and its copies of lower resolution.
struct ScaledVolume {
  std::string name;  ///< for messages
  std::unique_ptr<LabelVolume> volume;
  int copies = 0;
  /// Opens a copy, 0 the coarsest.
  std::function<std::unique_ptr<LabelVolume>(int)> open_copy = {};
  /// Coarser copies are passed over while the next finer one has at most this many voxels.
  std::uint64_t cheap_voxels = std::uint64_t{1} << 24;
  /// The bytes of the budget, and the loop, for those that read several cells at once.
  std::uint64_t memory = std::uint64_t{256} << 20U;
  VisitAtOnce at_once = visit_in_turn;
};

/// What is seen of a volume when only an object matters.
struct ObjectView {
  std::unique_ptr<LabelVolume> volume;  ///< as large as the whole, all but the object one label
  Box3 box;                             ///< around the object, with kObjectMargin, in bounds
};

/// Looks through the finest copy that is cheap to read (if none is, the coarsest) or, where it
/// lacks a label, through finer ones up to the volume itself, and follows the labels from there in
/// the volume (follow_object()).  So parts are not found that no copy shows and that touch no part
/// that one does.  Nothing outside of `bounds` is looked at.  REQUIRES: labels not empty.
/// ERRORS: mw::Error(kUsage) for the label kNotTheObject; kInput when a label is not found, also
/// because finer copies have more than kMostScannedVoxels; what reading throws.
[[nodiscard]] ObjectView open_object(ScaledVolume scaled, ObjectLabels labels, const Box3& bounds);

}  // namespace mw::io
