// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How deep pixels of a slice are in labels, and how thick these are there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw::io {

/// A pixel of a slice, or a step between two.
struct Pixel {
  std::int64_t u = 0;
  std::int64_t v = 0;
};

/// The steps within reach, the shortest first, with their exact squared lengths.  Lengths are in
/// widths of the finest voxel, squares in kUnits of its area.
class SliceSteps {
 public:
  static constexpr std::int64_t kUnits = 256;
  /// How deep in a label, and how thick, still makes a difference; and how far labels are seen.
  static constexpr std::int64_t kDepth = 12;
  static constexpr std::int64_t kSight = 16;
  static constexpr std::int64_t kDepth2 = kDepth * kDepth * kUnits;
  static constexpr std::int64_t kSight2 = kSight * kSight * kUnits;

  struct Step {
    std::int64_t square = 0;
    Pixel by;
  };

  /// edges are those of a pixel.  REQUIRES: neither is below 1, except for rounding.
  explicit SliceSteps(const std::array<double, 2>& edges);

  [[nodiscard]] std::span<const Step> steps() const { return steps_; }
  /// Returns the square of a step of one pixel along u, or along v.
  [[nodiscard]] std::int64_t square_u() const { return squares_[0]; }
  [[nodiscard]] std::int64_t square_v() const { return squares_[1]; }
  /// Returns how many pixels away labels still say something of a pixel.
  [[nodiscard]] Pixel reach() const;

 private:
  std::array<std::int64_t, 2> squares_;
  std::vector<Step> steps_;
};

/// Where a pixel is, as a label sees it.
struct LabelDepth {
  double depth = 0;   ///< distance to the label's contour; negative outside of it
  double radius = 0;  ///< half the label's thickness here, or where it is nearest
  /// radius^2 minus the squared distance from the middle of the label: along the axis of slices it
  /// is a parabola in a ball, a tube that lies or an ellipsoid.
  double height = 0;
};

/// A window of a slice.  What it says of pixels that are SliceSteps::reach() and more inside of the
/// window, or of the slice, depends on the slice alone.
/// Thread safety: none.
class SliceDistances {
 public:
  /// The window's labels are at `labels`, u fastest; steps must outlive it.
  SliceDistances(const SliceSteps& steps, Pixel shape, std::vector<RawLabel> labels);

  [[nodiscard]] RawLabel label(Pixel p) const { return labels_[at(p)]; }
  [[nodiscard]] LabelDepth depth_of(Pixel p, RawLabel label);

 private:
  [[nodiscard]] std::size_t at(Pixel p) const {
    return static_cast<std::size_t>(p.v * shape_.u + p.u);
  }
  [[nodiscard]] bool contains(Pixel p) const {
    return p.u >= 0 && p.v >= 0 && p.u < shape_.u && p.v < shape_.v;
  }
  void measure();
  [[nodiscard]] std::vector<std::int64_t> row_distances() const;
  [[nodiscard]] std::int32_t square_to_other(Pixel p,
                                             const std::vector<std::int64_t>& in_rows) const;
  /// Returns the squared radius of the largest disc of p's label that covers p.
  [[nodiscard]] std::int32_t radius2(Pixel p);
  [[nodiscard]] LabelDepth inside(Pixel p);
  [[nodiscard]] LabelDepth outside(Pixel p, RawLabel label);

  const SliceSteps* steps_;
  Pixel shape_;
  std::vector<RawLabel> labels_;
  std::vector<RawLabel> present_;      ///< ascending
  std::vector<std::int32_t> squares_;  ///< to the nearest pixel of another label; empty at first
  std::vector<std::int32_t> radii2_;   ///< 0: not known yet
};

}  // namespace mw::io
