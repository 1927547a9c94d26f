// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads windows of slices, a few gaps at a time, and fills columns of pixels between them.
#include "io/labels/interpolated_volume.h"

#include <algorithm>
#include <array>
#include <utility>

#include "io/file/errors.h"
#include "io/labels/slice_gap.h"
#include "kernels/core/assert.h"
#include "kernels/core/lattice.h"

namespace mw::io {
namespace {

/// Pixels along each edge, and gaps, that are worked on at a time.
constexpr std::int64_t kPartEdge = 128;
constexpr std::int64_t kPartGaps = 4;

std::int64_t& along(Index3& index, int axis) {
  return axis == 0 ? index.x : axis == 1 ? index.y : index.z;
}
std::int64_t along(const Index3& index, int axis) {
  return axis == 0 ? index.x : axis == 1 ? index.y : index.z;
}

/// The axes of pixels in slices that follow each other along `axis`.
std::array<int, 2> pixel_axes(int axis) {
  return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

/// Returns the edge of voxels along an axis, in widths of the finest voxel.
double relative_edge(const VolumeInfo& volume, int axis) {
  const Vector3& s = volume.space.spacing;
  return s[static_cast<std::size_t>(axis)] / std::min({s[0], s[1], s[2]});
}

/// Returns the gap of a thin slice: gap g is from the middle of slice g to that of the next.
std::int64_t gap_of(std::int64_t thin, std::int64_t layers) {
  const std::int64_t from_first = thin - layers / 2;
  return from_first < 0 ? -1 : from_first / layers;
}

/// Returns the first thin slice of a gap.
std::int64_t begin_of(std::int64_t gap, std::int64_t layers) {
  return std::max<std::int64_t>(gap * layers + layers / 2, 0);
}

}  // namespace

/// Some gaps of a box, and the slices around them.
class InterpolatedVolume::Part {
 public:
  /// box is in the thin slices of up to kPartGaps gaps.
  Part(const InterpolatedVolume& volume, const Box3& box)
      : volume_(volume),
        axis_(volume.facts_.axis),
        layers_(volume.facts_.layers),
        box_(box),
        window_(window(volume, box)) {
    std::vector<RawLabel> labels(static_cast<std::size_t>(window_.voxels()));
    volume.below().read(window_, labels);
    const std::int64_t first = along(window_.lo, axis_), end = along(window_.hi, axis_);
    for (std::int64_t slice = first; slice < end; ++slice) add(slice, labels);
  }

  /// Writes the labels of the box to their places among those of `all`.
  void fill(const Box3& all, std::span<RawLabel> out) {
    const std::int64_t first = gap_of(along(box_.lo, axis_), layers_);
    const std::int64_t last = gap_of(along(box_.hi, axis_) - 1, layers_);
    for (std::int64_t gap = first; gap <= last; ++gap) {
      Box3 base = box_;
      along(base.lo, axis_) = std::max(along(box_.lo, axis_), begin_of(gap, layers_));
      along(base.hi, axis_) = along(base.lo, axis_) + 1;
      const std::int64_t end = std::min(along(box_.hi, axis_), begin_of(gap + 1, layers_));
      for_each_index(base, [&](Index3 v) {
        const Pixel p = pixel_of(v);
        const RawLabel lower = slice(gap).label(p), upper = slice(gap + 1).label(p);
        const std::int64_t change = lower == upper ? 0 : begin_of(gap, layers_) + height(gap, p);
        for (; along(v, axis_) < end; ++along(v, axis_)) {
          out[static_cast<std::size_t>(all.offset(v))] = along(v, axis_) < change ? lower : upper;
        }
      });
    }
  }

 private:
  static Box3 window(const InterpolatedVolume& volume, const Box3& box) {
    const SliceFacts& facts = volume.facts_;
    const auto [u, v] = pixel_axes(facts.axis);
    const Pixel reach = volume.steps_.reach();
    Box3 out = box;
    along(out.lo, u) -= reach.u;
    along(out.hi, u) += reach.u;
    along(out.lo, v) -= reach.v;
    along(out.hi, v) += reach.v;
    along(out.lo, facts.axis) = gap_of(along(box.lo, facts.axis), facts.layers) - 1;
    along(out.hi, facts.axis) = gap_of(along(box.hi, facts.axis) - 1, facts.layers) + 3;
    return intersection(out, {{0, 0, 0}, volume.below().info().shape});
  }

  [[nodiscard]] Pixel pixel_of(const Index3& v) const {
    const auto [u_axis, v_axis] = pixel_axes(axis_);
    return {along(v, u_axis) - along(window_.lo, u_axis),
            along(v, v_axis) - along(window_.lo, v_axis)};
  }

  void add(std::int64_t slice, const std::vector<RawLabel>& labels) {
    const auto [u, v] = pixel_axes(axis_);
    const Index3 shape = window_.shape();
    Box3 one = window_;
    along(one.lo, axis_) = slice;
    along(one.hi, axis_) = slice + 1;
    std::vector<RawLabel> own;
    own.reserve(static_cast<std::size_t>(one.voxels()));
    for_each_index(
        one, [&](Index3 w) { own.push_back(labels[static_cast<std::size_t>(window_.offset(w))]); });
    slices_.emplace_back(volume_.steps_, Pixel{along(shape, u), along(shape, v)}, std::move(own));
  }

  /// Returns a slice, the first or the last one instead of those that the volume does not have.
  [[nodiscard]] SliceDistances& slice(std::int64_t number) {
    const std::int64_t last = volume_.facts_.slices - 1;
    const std::int64_t there = std::clamp<std::int64_t>(number, 0, last);
    return slices_[static_cast<std::size_t>(there - along(window_.lo, axis_))];
  }

  /// Returns how many thin slices of a gap have the first slice's label.
  [[nodiscard]] std::int64_t height(std::int64_t gap, Pixel p) {
    const RawLabel lower = slice(gap).label(p), upper = slice(gap + 1).label(p);
    SliceGap seen{.thickness = volume_.thickness_};
    for (std::size_t i = 0; i < 4; ++i) {
      SliceDistances& at = slice(gap - 1 + static_cast<std::int64_t>(i));
      seen.lower[i] = at.depth_of(p, lower);
      seen.upper[i] = at.depth_of(p, upper);
    }
    // Thin slices are at odd parts of the gap if layers are even.  The first is then free, and the
    // last one is that of the next slice; else the first one is that of the slice.
    const std::int64_t odd = 1 - layers_ % 2;
    std::int64_t count = 1 - odd;
    for (std::int64_t i = 1 - odd; i < layers_ - odd; ++i) {
      const std::int64_t part = 2 * i + odd;
      const double margin = lower_margin(seen, part, 2 * layers_);
      if (margin > 0 || (margin == 0 && part < layers_)) ++count;
    }
    return count;
  }

  const InterpolatedVolume& volume_;
  int axis_;
  std::int64_t layers_;
  Box3 box_;
  Box3 window_;  ///< of the volume below
  std::vector<SliceDistances> slices_;
};

SliceFacts slices_of(const VolumeInfo& volume) {
  const Vector3& s = volume.space.spacing;
  const Index3 layers = layers_of(s);
  const int axis = s[2] >= std::max(s[0], s[1]) ? 2 : s[1] >= s[0] ? 1 : 0;
  return {.axis = axis, .slices = along(volume.shape, axis), .layers = along(layers, axis)};
}

VolumeInfo interpolated_info(const VolumeInfo& volume) {
  const SliceFacts facts = slices_of(volume);
  const Vector3& s = volume.space.spacing;
  if (facts.layers < 2) {
    fail_usage("--interpolate-slices: voxels of ", s[0], " x ", s[1], " x ", s[2],
               " are no thick slices, there is nothing to interpolate; leave it out, or set "
               "--spacing if this one is wrong");
  }
  if (facts.slices < 2) {
    fail_usage("--interpolate-slices: there is one slice only along ",
               std::string(1, "xyz"[facts.axis]),
               ", and nothing between slices; leave it out, or take more slices");
  }
  VolumeInfo out = volume;
  const auto axis = static_cast<std::size_t>(facts.axis);
  for (Index3* index : {&out.shape, &out.chunk, &out.first, &out.offset}) {
    along(*index, facts.axis) *= facts.layers;
  }
  for (const int a : pixel_axes(facts.axis)) {
    if (along(out.chunk, a) == 0) along(out.chunk, a) = kPartEdge;
  }
  out.space.spacing[axis] /= static_cast<double>(facts.layers);
  return out;
}

InterpolatedVolume::InterpolatedVolume(const LabelVolume& volume)
    : VolumeView(volume),
      facts_(slices_of(volume.info())),
      info_(interpolated_info(volume.info())),
      steps_({relative_edge(volume.info(), pixel_axes(facts_.axis)[0]),
              relative_edge(volume.info(), pixel_axes(facts_.axis)[1])}),
      thickness_(relative_edge(volume.info(), facts_.axis)) {}

void InterpolatedVolume::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  if (out.empty()) return;
  const int axis = facts_.axis;
  const auto [u_axis, v_axis] = pixel_axes(axis);
  const int u = u_axis, v = v_axis;
  const std::int64_t first = gap_of(along(box.lo, axis), facts_.layers);
  const std::int64_t gaps = gap_of(along(box.hi, axis) - 1, facts_.layers) + 1 - first;
  const auto tiles = [](std::int64_t all, std::int64_t each) { return (all + each - 1) / each; };
  const Index3 shape = box.shape();
  const Index3 parts{tiles(along(shape, u), kPartEdge), tiles(along(shape, v), kPartEdge),
                     tiles(gaps, kPartGaps)};
  for_each_index(parts, [&](Index3 i) {
    Box3 part = box;
    along(part.lo, u) += i.x * kPartEdge;
    along(part.lo, v) += i.y * kPartEdge;
    const std::int64_t gap = first + i.z * kPartGaps;
    along(part.lo, axis) = std::max(along(box.lo, axis), begin_of(gap, facts_.layers));
    along(part.hi, u) = along(part.lo, u) + kPartEdge;
    along(part.hi, v) = along(part.lo, v) + kPartEdge;
    along(part.hi, axis) = begin_of(gap + kPartGaps, facts_.layers);
    part = intersection(part, box);
    Part(*this, part).fill(box, out);
  });
}

}  // namespace mw::io
