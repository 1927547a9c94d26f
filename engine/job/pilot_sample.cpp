// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/pilot_sample.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mw::engine {
namespace {

/// Voxels beside a cut whose tets do not count, as the cut changes them.
constexpr std::int64_t kHalo = 8;
/// What a part has more of, also beyond that (found on grains, EM and a kidney: 1.00 to 1.10).
constexpr double kMoreAtCuts = 1.04;
/// The edges of boxes: at least, and of a large lattice.
constexpr std::int64_t kLeastEdge = 28, kLargeEdge = 80;
constexpr std::int64_t kFewBoxes = 8, kFewestOfFew = 6, kFewestOfMany = 4;
/// One in kShare voxels is meshed, in a number of boxes between these bounds.
constexpr std::int64_t kShare = 10, kFewestDrawn = 2, kMostDrawn = 16;

double weight_of(const BoxContent& content, double faces_a_voxel) {
  return static_cast<double>(content.faces) + faces_a_voxel * static_cast<double>(content.voxels);
}

using Axes = std::array<std::int64_t, 3>;

Axes axes_of(Index3 v) {
  return {v.x, v.y, v.z};
}

Index3 index_of(const Axes& v) {
  return {v[0], v[1], v[2]};
}

/// Returns into how many pieces each axis is cut so that there are some eight boxes.  None is
/// thinner than a voxel of the volume, which is cut into `layers`.
Axes few_pieces(const Axes& shape, const Axes& layers) {
  Axes out{1, 1, 1};
  while (index_of(out).product() < kFewBoxes) {
    unsigned longest = 0;
    for (unsigned axis = 1; axis < 3; ++axis) {
      if (shape[axis] * out[longest] > shape[longest] * out[axis]) longest = axis;
    }
    const std::int64_t edge = std::max(kLeastEdge, layers[longest]);
    if (shape[longest] < edge * (out[longest] + 1)) break;
    ++out[longest];
  }
  return out;
}

Axes many_pieces(const Axes& shape, const Axes& layers) {
  Axes out{};
  for (unsigned axis = 0; axis < 3; ++axis) {
    out[axis] = std::max<std::int64_t>(1, shape[axis] / std::max(kLargeEdge, layers[axis]));
  }
  return out;
}

/// Returns a piece of the lattice, which begins and ends between voxels of the volume.
Box3 box_at(const Axes& shape, const Axes& piece, const Axes& pieces, const Axes& layers) {
  Axes lo{}, hi{};
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto cut_before = [&](std::int64_t number) {
      return shape[axis] * number / pieces[axis] / layers[axis] * layers[axis];
    };
    lo[axis] = cut_before(piece[axis]);
    hi[axis] = piece[axis] + 1 == pieces[axis] ? shape[axis] : cut_before(piece[axis] + 1);
  }
  return {index_of(lo), index_of(hi)};
}

/// Returns what of a box is not near a cut.
Box3 without_halo(const Box3& box, const Axes& shape) {
  Axes lo = axes_of(box.lo), hi = axes_of(box.hi);
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (lo[axis] > 0) lo[axis] += kHalo;
    if (hi[axis] < shape[axis]) hi[axis] = std::max(lo[axis], hi[axis] - kHalo);
  }
  return {index_of(lo), index_of(hi)};
}

}  // namespace

PilotSample::PilotSample(const VoxelLattice& lattice, const PreparedLabels& labels,
                         const LabelSelection& kept, std::int64_t max_cut)
    : lattice_(lattice), labels_(labels), kept_(kept) {
  const Index3 shape = lattice.info().shape;
  is_cut_in_few_ = shape.product() <= max_cut;
  const Axes edges = axes_of(shape), layers = axes_of(lattice.layers());
  const Axes pieces = is_cut_in_few_ ? few_pieces(edges, layers) : many_pieces(edges, layers);
  for_each_index(Box3{{0, 0, 0}, index_of(pieces)}, [&](Index3 piece) {
    const Box3 box = box_at(edges, axes_of(piece), pieces, layers);
    const Box3 within = without_halo(box, edges);
    boxes_.push_back({box, within, content_of(within)});
    total_ += content_of(box);
  });
}

std::vector<PilotPart> PilotSample::parts(double faces_a_voxel) const {
  const std::int64_t fewest = is_cut_in_few_ ? kFewestOfFew : kFewestOfMany;
  if (static_cast<std::int64_t>(boxes_.size()) < fewest) return {};
  if (!is_cut_in_few_) return drawn(faces_a_voxel);
  const Box* const box = most_typical(faces_a_voxel);
  if (box == nullptr) return {};
  return {part_of(*box, weight_of(total_, faces_a_voxel) / weight_of(box->counted, faces_a_voxel))};
}

BoxContent PilotSample::content_of(const Box3& box) const {
  constexpr std::int64_t kSlab = 16;
  BoxContent out;
  for (Box3 slab = box; slab.lo.z < box.hi.z; slab.lo.z = slab.hi.z) {
    slab.hi.z = std::min(box.hi.z, slab.lo.z + kSlab);
    out += content_of_slab(slab);
  }
  return out;
}

BoxContent PilotSample::content_of_slab(const Box3& box) const {
  BoxContent out;
  const LabelBox labels = labels_.original({box.lo, box.hi + Index3{1, 1, 1}});
  for_each_index(box, [&](Index3 v) {
    const Label own = labels.at(v);
    const bool is_written = kept_.keeps(own);
    out.voxels += is_written ? 1 : 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const Label next = labels.at(v + axis_vector(axis));
      if (next == own || next == kExterior) continue;
      out.faces += is_written || kept_.keeps(next) ? 1 : 0;
    }
  });
  return out;
}

PilotPart PilotSample::part_of(const Box& box, double weight) const {
  const Index3 layers = lattice_.layers(), lo = box.lattice.lo, hi = box.lattice.hi;
  const Box3 voxels{{lo.x / layers.x, lo.y / layers.y, lo.z / layers.z},
                    {(hi.x + layers.x - 1) / layers.x, (hi.y + layers.y - 1) / layers.y,
                     (hi.z + layers.z - 1) / layers.z}};
  return {voxels, {box.within.lo - lo, box.within.hi - lo}, weight / kMoreAtCuts};
}

const PilotSample::Box* PilotSample::most_typical(double faces_a_voxel) const {
  const auto faces_of = [](const BoxContent& c) {
    return static_cast<double>(c.faces) / static_cast<double>(std::max<std::int64_t>(1, c.voxels));
  };
  double counted = 0;
  for (const Box& box : boxes_) counted += weight_of(box.counted, faces_a_voxel);
  const double least = counted / (2 * static_cast<double>(boxes_.size()));
  const Box* out = nullptr;
  for (const Box& box : boxes_) {
    if (box.counted.voxels == 0 || weight_of(box.counted, faces_a_voxel) < least) continue;
    const auto off = [&](const Box& b) { return std::abs(faces_of(b.counted) - faces_of(total_)); };
    if (out == nullptr || off(box) < off(*out)) out = &box;
  }
  return out;
}

std::vector<PilotPart> PilotSample::drawn(double faces_a_voxel) const {
  const std::int64_t all = static_cast<std::int64_t>(boxes_.size());
  const std::int64_t wanted = std::clamp(all / kShare, kFewestDrawn, kMostDrawn);
  double counted = 0;
  for (const Box& box : boxes_) counted += weight_of(box.counted, faces_a_voxel);
  const double step = counted / static_cast<double>(wanted);
  // Along the sum of what counts, each odd multiple of half a step draws the box that it lies in.
  double before = 0;
  std::vector<PilotPart> out;
  for (const Box& box : boxes_) {
    const double weight = weight_of(box.counted, faces_a_voxel);
    const double draws =
        std::floor((before + weight) / step + 0.5) - std::floor(before / step + 0.5);
    before += weight;
    if (draws == 0 || weight == 0) continue;
    out.push_back(part_of(box, draws * step / weight * weight_of(total_, faces_a_voxel) / counted));
  }
  return out;
}

}  // namespace mw::engine
