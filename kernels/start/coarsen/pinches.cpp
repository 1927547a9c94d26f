// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A table over all sets of the eight voxels at a corner, and sets of voxels as words.
#include "kernels/start/coarsen/pinches.h"

#include <algorithm>

namespace mw {
namespace {

constexpr unsigned kAtCorner = 0xff;

/// The voxels on the higher side of the corner, along each axis.
constexpr std::array<unsigned, 3> kHighSide{0b10101010, 0b11001100, 0b11110000};

/// Do the voxels hang together by faces?  None of them do.
constexpr bool hangs_together(unsigned voxels) {
  unsigned seen = voxels & (~voxels + 1);
  for (unsigned before = 0; seen != before;) {
    before = seen;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned step = 1U << axis;
      seen |= ((seen & ~kHighSide[axis]) << step | (seen & kHighSide[axis]) >> step) & voxels;
    }
  }
  return seen == voxels;
}

constexpr Pinches find_pinches(unsigned voxels) {
  unsigned out = hangs_together(voxels) && hangs_together(kAtCorner & ~voxels) ? 0U : 1U;
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (unsigned side = 0; side < 2; ++side) {
      const unsigned around = side == 1 ? kHighSide[axis] : kAtCorner & ~kHighSide[axis];
      const unsigned in = voxels & around, rest = around & ~voxels;
      out |= (hangs_together(in) && hangs_together(rest) ? 0U : 1U) << (1 + 2 * axis + side);
    }
  }
  return static_cast<Pinches>(out);
}

constexpr std::array<Pinches, 256> make_table() {
  std::array<Pinches, 256> out{};
  for (unsigned voxels = 0; voxels < out.size(); ++voxels) out[voxels] = find_pinches(voxels);
  return out;
}

constexpr std::array<Pinches, 256> kPinches = make_table();

/// A set of the voxels around a cube.
using Voxels = std::uint64_t;

/// How far voxel i of a corner, or of a cube, is from the first one in the 4^3 around the cube.
constexpr unsigned step_in_box(unsigned i) {
  return (i & 1U) + 4 * (i >> 1 & 1U) + 16 * (i >> 2);
}

/// The first of the cube's own voxels.
constexpr unsigned kFirstOfCube = 1 + 4 + 16;

/// Returns those of the voxels that are at the corner of which voxel `first` is the lowest one.
std::uint8_t at_corner(Voxels voxels, unsigned first) {
  const auto from = static_cast<std::uint32_t>(voxels >> first);
  return static_cast<std::uint8_t>((from & 3U) | (from >> 2 & 12U) | (from >> 12 & 0x30U) |
                                   (from >> 14 & 0xc0U));
}

bool adds_pinch(Voxels now, Voxels before) {
  for (unsigned z = 0; z < 3; ++z) {
    for (unsigned y = 0; y < 3; ++y) {
      for (unsigned x = 0; x < 3; ++x) {
        const unsigned first = x + 4 * y + 16 * z;
        const unsigned pinched = kPinches[at_corner(now, first)];
        if (pinched == 0) continue;
        if ((pinched & ~unsigned{kPinches[at_corner(before, first)]}) != 0) return true;
      }
    }
  }
  return false;
}

}  // namespace

Pinches pinches_at_corner(std::uint8_t voxels) {
  return kPinches[voxels];
}

bool adds_pinch(const LabelsAroundCube& now, const CubeLabels& before) {
  CubeLabels labels = before;  // the cube's own label now is one that it had
  std::sort(labels.begin(), labels.end());
  const auto end = std::unique(labels.begin(), labels.end());
  return std::any_of(labels.begin(), end, [&](Label label) {
    Voxels after = 0;
    for (unsigned i = 0; i < now.size(); ++i) {
      after |= (now[i] == label ? Voxels{1} : Voxels{0}) << i;
    }
    Voxels then = after;
    for (unsigned i = 0; i < before.size(); ++i) {
      const Voxels voxel = Voxels{1} << (kFirstOfCube + step_in_box(i));
      then = before[i] == label ? then | voxel : then & ~voxel;
    }
    return adds_pinch(after, then);
  });
}

}  // namespace mw
