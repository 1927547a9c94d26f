// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes whose voxels can be read as what they are, numbers, and not only as labels.
#pragma once

#include <span>

#include "kernels/core/index.h"

namespace mw::io {

/// An interface of those LabelVolumes whose voxels can be read as numbers.
/// Thread safety: read_numbers() may be called from many threads.
class NumberVolume {
 public:
  virtual ~NumberVolume() = default;
  /// Reads a box of any numbers; integers that a double does not hold are rounded.
  virtual void read_numbers(const Box3& box, std::span<double> out) const = 0;
};

}  // namespace mw::io
