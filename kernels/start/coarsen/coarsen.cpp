// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Visits cubes by colour, flips all voxels of a cube to one label, and undoes what is refused.
#include "kernels/start/coarsen/coarsen.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <utility>

#include "kernels/core/index.h"
#include "kernels/start/carrier_faces.h"
#include "kernels/start/cells/cell.h"
#include "kernels/start/coarsen/pinches.h"
#include "kernels/start/coarsen/simple_voxel.h"

namespace mw {
namespace {

/// A label with fewer voxels in a cube is a thread there and may not take the cube.
constexpr std::ptrdiff_t kLeastVoxels = 3;

constexpr unsigned kColours = 8;

Index3 cube_voxel(Index3 cube, unsigned i) {
  return cube + Index3{i & 1U, i >> 1 & 1U, i >> 2 & 1U};
}

/// A face relative to another, and how far its voxels are from that one's lower voxel in an array.
struct FaceStep {
  VoxelFace face;
  std::ptrdiff_t lower = 0;
  std::ptrdiff_t upper = 0;
};

std::vector<FaceStep> steps_to(const std::vector<VoxelFace>& faces, const Box3& box) {
  const Index3 shape = box.shape();
  const auto step = [&](Index3 v) { return (v.z * shape.y + v.y) * shape.x + v.x; };
  std::vector<FaceStep> out;
  for (const VoxelFace& f : faces) out.push_back({f, step(f.lower), step(f.upper())});
  return out;
}

/// Faces near a cube that were looked at.
class FacesNear {
 public:
  explicit FacesNear(Index3 cube) : lo_(cube - Index3{kReach, kReach, kReach}) {}

  /// Returns whether it is the first time.  REQUIRES: the face's lower voxel is at most three
  /// voxels before the cube's first, and four behind it.
  bool is_new(const VoxelFace& face) {
    const Index3 at = face.lower - lo_;
    const auto bit =
        static_cast<std::size_t>(((at.z * kEdge + at.y) * kEdge + at.x) * 3 + face.axis);
    const bool is_new = !seen_[bit];
    seen_[bit] = true;
    return is_new;
  }

 private:
  static constexpr std::int64_t kReach = 3, kEdge = 8;

  Index3 lo_;
  std::bitset<3 * kEdge * kEdge * kEdge> seen_;
};

/// REQUIRES: `original` and `labels` cover the same box.
class Coarsener {
 public:
  Coarsener(const LabelBox& original, LabelBox& labels, double max_distance, bool keeps_flat,
            const SizeField* sizes)
      : original_(original), labels_(labels), keeps_flat_(keeps_flat), sizes_(sizes) {
    const CarrierFaces faces(max_distance);
    for (unsigned axis = 0; axis < 3; ++axis) {
      carriers_[axis] = steps_to(faces.of(axis), labels.box);
      carried_by_[axis] = steps_to(faces.carried_by(axis), labels.box);
    }
    const double reach = std::min(max_distance, kMaxCoarseDistance);
    for_each_index(Box3{{-1, -1, -1}, {2, 2, 2}}, [&](Index3 o) {
      if (static_cast<double>(o.x * o.x + o.y * o.y + o.z * o.z) <= reach * reach) {
        displacements_.push_back(o);
      }
    });
  }

  /// Gives a mixed cube one label if it can; returns whether it did.
  bool visit(Index3 cube) {
    CubeLabels before;
    for (unsigned i = 0; i < 8; ++i) before[i] = labels_.at(cube_voxel(cube, i));
    if (!sizes_allow(cube, before) || (keeps_flat_ && is_flat(cube))) return false;
    for (Label to : candidates(before)) {
      if (flip_all(cube, to) && !adds_pinch(around(cube), before) && keeps_carriers(cube, before)) {
        return true;
      }
      for (unsigned i = 0; i < 8; ++i) at(cube_voxel(cube, i)) = before[i];
    }
    return false;
  }

 private:
  Label& at(Index3 v) { return labels_.labels[static_cast<std::size_t>(labels_.box.offset(v))]; }

  /// Labels that may take the cube, the most frequent first, then by label.
  static std::vector<Label> candidates(CubeLabels labels) {
    std::sort(labels.begin(), labels.end());
    std::vector<std::pair<std::ptrdiff_t, Label>> counted;
    for (auto i = labels.begin(); i != labels.end();) {
      const auto end = std::upper_bound(i, labels.end(), *i);
      counted.emplace_back(i - end, *i);
      i = end;
    }
    std::sort(counted.begin(), counted.end());
    std::vector<Label> out;
    for (const auto& [count, label] : counted) {
      if (-count >= kLeastVoxels) out.push_back(label);
    }
    return out;
  }

  [[nodiscard]] bool sizes_allow(Index3 cube, const CubeLabels& labels) const {
    constexpr int kTwiceTheCube = 2;
    return sizes_ == nullptr || std::all_of(labels.begin(), labels.end(), [&](Label l) {
             return sizes_->allows_cell(cube, kTwiceTheCube, l);
           });
  }

  bool flip_all(Index3 cube, Label to) {
    std::array<Index3, 8> left;
    std::size_t count = 0;
    for (unsigned i = 0; i < 8; ++i) {
      const Index3 v = cube_voxel(cube, i);
      if (labels_.at(v) == to) continue;
      if (!was_near(v, to) || is_in_sheet(v)) return false;
      left[count++] = v;
    }
    for (bool changed = true; changed && count > 0;) {
      changed = false;
      for (std::size_t i = 0; i < count;) {
        if (!relabel_keeps_topology(neighbourhood(left[i]), to)) {
          ++i;
          continue;
        }
        at(left[i]) = to;
        std::move(left.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                  left.begin() + static_cast<std::ptrdiff_t>(count),
                  left.begin() + static_cast<std::ptrdiff_t>(i));
        --count;
        changed = true;
      }
    }
    return count == 0;
  }

  /// True if two labels meet in a plane that halves the cube and goes on for a voxel all around it,
  /// or up to the volume's side.
  [[nodiscard]] bool is_flat(Index3 cube) const {
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (is_flat_across(cube, axis)) return true;
    }
    return false;
  }

  [[nodiscard]] bool is_flat_across(Index3 cube, unsigned axis) const {
    const Index3 step = axis_vector(axis), first = axis_vector((axis + 1) % 3),
                 second = axis_vector((axis + 2) % 3);
    const Label lower = original_.at(cube), upper = original_.at(cube + step);
    if (lower == upper) return false;
    const auto is_one = [&](Index3 v, Label wanted) {
      const Label label = original_.at(v);
      return label == wanted || label == kExterior;
    };
    Index3 row = cube - first - second;
    for (int i = 0; i < 4; ++i, row = row + first) {
      Index3 v = row;
      for (int k = 0; k < 4; ++k, v = v + second) {
        if (!is_one(v, lower) || !is_one(v + step, upper)) return false;
      }
    }
    return true;
  }

  /// Output to input: all of voxel v is within D of an input voxel of the label.
  [[nodiscard]] bool was_near(Index3 v, Label label) const {
    return std::any_of(displacements_.begin(), displacements_.end(),
                       [&](Index3 o) { return original_.at(v + o) == label; });
  }

  /// True if along an axis one or two voxels of the label, this one among them, have other labels
  /// on both sides.
  [[nodiscard]] bool is_thin(Index3 v, Index3 step) const {
    const Label label = original_.at(v);
    const auto is_other = [&](Index3 w) {
      const Label l = original_.at(w);
      return l != label && l != kExterior;
    };
    const bool below = is_other(v - step), above = is_other(v + step);
    if (below && above) return true;
    if (below) return original_.at(v + step) == label && is_other(v + step + step);
    return above && original_.at(v - step) == label && is_other(v - step - step);
  }

  /// True for a voxel of a sheet that is one or two voxels thick and would get a notch without it:
  /// at least three of its neighbours in the sheet are as thin as it is.
  [[nodiscard]] bool is_in_sheet(Index3 v) const {
    constexpr int kInSheet = 3;
    const std::array<Index3, 3> steps{axis_vector(0), axis_vector(1), axis_vector(2)};
    return std::any_of(steps.begin(), steps.end(), [&](Index3 across) {
      if (!is_thin(v, across)) return false;
      int thin = 0;
      for (const Index3 step : steps) {
        if (step == across) continue;
        for (const Index3 w : {v - step, v + step}) {
          thin += original_.at(w) == original_.at(v) && is_thin(w, across) ? 1 : 0;
        }
      }
      return thin >= kInSheet;
    });
  }

  [[nodiscard]] Neighbourhood neighbourhood(Index3 v) const {
    return cube_from<3>(v - Index3{1, 1, 1});
  }
  [[nodiscard]] LabelsAroundCube around(Index3 cube) const {
    return cube_from<4>(cube - Index3{1, 1, 1});
  }

  /// The labels of the n^3 voxels from `lo` on, x fastest.
  template <std::size_t n>
  [[nodiscard]] std::array<Label, n * n * n> cube_from(Index3 lo) const {
    std::array<Label, n * n * n> out;
    const Index3 shape = labels_.box.shape();
    const Label* row = labels_.labels.data() + labels_.box.offset(lo);
    for (std::size_t z = 0; z < n; ++z) {
      for (std::size_t y = 0; y < n; ++y) {
        const Label* from =
            row + (static_cast<std::int64_t>(z) * shape.y + static_cast<std::int64_t>(y)) * shape.x;
        for (std::size_t x = 0; x < n; ++x) out[(z * n + y) * n + x] = from[x];
      }
    }
    return out;
  }

  /// Input to output: each input face whose carrier may have been a face of the cube's voxels
  /// still has one.
  bool keeps_carriers(Index3 cube, const CubeLabels& before) {
    const Label now = labels_.at(cube);
    FacesNear seen(cube);
    const auto label_before = [&](Index3 v) {
      const Index3 i = v - cube;
      const bool in_cube = ((i.x | i.y | i.z) & ~std::int64_t{1}) == 0;
      return in_cube ? before[static_cast<std::size_t>(i.x + 2 * i.y + 4 * i.z)] : labels_.at(v);
    };
    for (unsigned i = 0; i < 8; ++i) {
      if (before[i] == now) continue;
      const Index3 v = cube_voxel(cube, i);
      for (unsigned axis = 0; axis < 3; ++axis) {
        const Index3 step = axis_vector(axis);
        for (const VoxelFace& face : {VoxelFace{v, axis}, VoxelFace{v - step, axis}}) {
          const LabelPair pair = label_pair(label_before(face.lower), label_before(face.upper()));
          if (pair.low == pair.high || pair.high == kExterior) continue;
          if (!others_carry(face, pair, cube, seen)) return false;
        }
      }
    }
    return true;
  }

  /// True if each input face that a face may have carried, and that was not seen yet, has a
  /// carrier.
  [[nodiscard]] bool others_carry(const VoxelFace& lost, LabelPair labels, Index3 cube,
                                  FacesNear& seen) const {
    const Label* at = original_.labels.data() + original_.box.offset(lost.lower);
    for (const FaceStep& f : carried_by_[lost.axis]) {
      const Label lower = at[f.lower], upper = at[f.upper];
      const bool is_same =
          lower == labels.low ? upper == labels.high : lower == labels.high && upper == labels.low;
      if (!is_same) continue;
      const VoxelFace face{lost.lower + f.face.lower, f.face.axis};
      if (seen.is_new(face) && !has_carrier(face, lower, upper, cube)) return false;
    }
    return true;
  }

  /// True if a face of the input, between these labels, has a carrier (may_carry()).  Faces farther
  /// from the cube than its colour may see do not count.
  [[nodiscard]] bool has_carrier(const VoxelFace& face, Label lower, Label upper,
                                 Index3 cube) const {
    const Index3 reach{kCoarsenReach, kCoarsenReach, kCoarsenReach};
    const Box3 seen{cube - reach, cube + reach + Index3{2, 2, 2}};
    const Label* at = labels_.labels.data() + labels_.box.offset(face.lower);
    return std::any_of(carriers_[face.axis].begin(), carriers_[face.axis].end(),
                       [&](const FaceStep& c) {
                         const Label below = at[c.lower], above = at[c.upper];
                         const bool is_turned = c.face.axis != face.axis && below == upper;
                         if (!(below == lower && above == upper) && !(is_turned && above == lower))
                           return false;
                         const VoxelFace carrier{face.lower + c.face.lower, c.face.axis};
                         return seen.contains(carrier.lower) && seen.contains(carrier.upper());
                       });
  }

  const LabelBox& original_;
  LabelBox& labels_;
  std::array<std::vector<FaceStep>, 3> carriers_;    ///< by axis, as CarrierFaces::of()
  std::array<std::vector<FaceStep>, 3> carried_by_;  ///< as CarrierFaces::carried_by()
  bool keeps_flat_;
  const SizeField* sizes_;
  std::vector<Index3> displacements_;
};

/// The box of the cubes of a colour that can matter for the tile.  It shrinks with each colour by
/// what one visit sees.
Box3 box_of_colour(const Box3& tile, const Box3& within, unsigned colour) {
  return intersection(grown(tile, kCoarsenReach * (7 - static_cast<std::int64_t>(colour))), within);
}

unsigned colour_of(Index3 cube) {
  return static_cast<unsigned>((cube.x >> 1 & 1) + 2 * (cube.y >> 1 & 1) + 4 * (cube.z >> 1 & 1));
}

/// Calls use(x) for each even x at which a cube has several labels, in the row of cubes from `row`.
template <typename Use>
void each_mixed_in_row(const Label* row, Index3 shape, std::int64_t cubes, const Use& use) {
  const Label *const y = row + shape.x, *const z = row + shape.x * shape.y, *const yz = z + shape.x;
  for (std::int64_t x = 0; x < 2 * cubes; x += 2) {
    const Label l = row[x];
    const Label differs = (row[x + 1] ^ l) | (y[x] ^ l) | (y[x + 1] ^ l) | (z[x] ^ l) |
                          (z[x + 1] ^ l) | (yz[x] ^ l) | (yz[x + 1] ^ l);
    if (differs != 0) use(x);
  }
}

/// The cubes that have several labels, by colour.  The others stay as they are, so one pass finds
/// all that is ever to be visited.
std::array<std::vector<Index3>, kColours> mixed_cubes(const LabelBox& labels, const Box3& tile,
                                                      const Box3& within) {
  std::array<std::vector<Index3>, kColours> out;
  std::array<Box3, kColours> boxes;
  for (unsigned c = 0; c < kColours; ++c) boxes[c] = box_of_colour(tile, within, c);
  const Box3& all = boxes[0];
  const std::int64_t cubes = all.shape().x / 2;
  for (Index3 at = all.lo; at.z + 2 <= all.hi.z; at.z += 2) {
    for (at.y = all.lo.y; at.y + 2 <= all.hi.y; at.y += 2) {
      const Label* const row = labels.labels.data() + labels.box.offset({all.lo.x, at.y, at.z});
      each_mixed_in_row(row, labels.box.shape(), cubes, [&](std::int64_t x) {
        const Index3 cube{all.lo.x + x, at.y, at.z};
        const unsigned colour = colour_of(cube);
        const Box3& box = boxes[colour];
        if (box.contains(cube) && box.contains(cube + Index3{1, 1, 1})) {
          out[colour].push_back(cube);
        }
      });
    }
  }
  return out;
}

}  // namespace

// More than five parameters: two views of labels, two boxes and two limits have no common owner.
CoarsenStats coarsen(const LabelBox& original, LabelBox& labels, const Box3& tile,
                     const CoarsenRegion& region, double max_distance, const SizeField* sizes) {
  const Box3& within = region.within;
  MW_ASSERT(((tile.lo.x | tile.lo.y | tile.lo.z | within.lo.x | within.lo.y | within.lo.z) & 1) ==
            0);
  Coarsener coarsener(original, labels, max_distance, region.keeps_flat, sizes);
  CoarsenStats stats;
  for (const std::vector<Index3>& cubes : mixed_cubes(labels, tile, within)) {
    for (const Index3& cube : cubes) {
      const bool is_uniform = coarsener.visit(cube);
      if (!tile.contains(cube)) continue;
      ++stats.mixed_cubes;
      stats.made_uniform += is_uniform ? 1U : 0U;
    }
  }
  return stats;
}

}  // namespace mw
