// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An object alone, in a box around it (--object).
#pragma once

#include <memory>

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

}  // namespace mw::io
