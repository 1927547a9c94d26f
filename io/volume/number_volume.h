// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes whose voxels are numbers, and not only labels: one number a voxel, several in one file,
// or a score for each label.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "io/volume/label_volume.h"
#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw::io {

/// An interface of those LabelVolumes whose voxels can be read as numbers.
/// Thread safety: read_numbers() may be called from many threads.
class NumberVolume {
 public:
  virtual ~NumberVolume() = default;
  /// Reads a box of any numbers; integers that a double does not hold are rounded.
  virtual void read_numbers(const Box3& box, std::span<double> out) const = 0;
};

/// A score for each label and voxel.  The label of a voxel is the one of the highest score, and the
/// smallest of several, so that two labels meet where their scores are equal.
/// Thread safety: const members may be called from many threads.
class LabelScores {
 public:
  virtual ~LabelScores() = default;
  [[nodiscard]] virtual Index3 shape() const = 0;
  /// Labels are 0 to labels() - 1.
  [[nodiscard]] virtual std::size_t labels() const = 0;
  /// Reads the scores of a label, x fastest.  REQUIRES: what LabelVolume::read() requires.
  virtual void read_scores(RawLabel label, const Box3& box, std::span<double> out) const = 0;
};

/// A file with several numbers a voxel, as it is opened where OpenOptions::values asks for them.
/// Everything except parts() is that of the first part.
class NumberStack : public VolumeView {
 public:
  /// REQUIRES: at least one part; all of the same shape and place, and NumberVolumes.
  explicit NumberStack(std::vector<std::shared_ptr<const LabelVolume>> parts)
      : VolumeView(parts.front()), parts_(std::move(parts)) {}

  [[nodiscard]] const std::vector<std::shared_ptr<const LabelVolume>>& parts() const {
    return parts_;
  }
  void read(const Box3& box, std::span<RawLabel> out) const override { below().read(box, out); }

 private:
  std::vector<std::shared_ptr<const LabelVolume>> parts_;
};

}  // namespace mw::io
