// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where a label of the input is a sheet, a thread or a lump of less than two voxels.
#pragma once

#include <optional>

#include "kernels/core/label.h"
#include "kernels/core/lattice.h"

namespace mw {

/// What a label of less than two voxels is like at a place.
struct ThinLabel {
  bool is_sheet = false;   ///< it is a wide sheet of about one voxel
  bool is_held = false;    ///< it is such a sheet, and touches itself in many places
  bool is_thread = false;  ///< it is a thread of about one voxel that goes on there
  bool is_speck = false;   ///< what is there of it is one of a few voxels, or several such
  bool is_small = false;   ///< it has few voxels there and does not go on to two sides

  ThinLabel& operator|=(const ThinLabel& other) {
    is_sheet = is_sheet || other.is_sheet;
    is_held = is_held || other.is_held;
    is_thread = is_thread || other.is_thread;
    is_speck = is_speck || other.is_speck;
    is_small = is_small || other.is_small;
    return *this;
  }
};

/// Looks at a label around the voxel corner nearest to a place.  Voxels outside of `labels` do not
/// have it.
///
/// The label is thin if none of the 27 cubes of 2^3 voxels that reach at most two voxels away from
/// the corner has it alone; otherwise nothing is returned.  It is a sheet if at least 56 of the 8^3
/// voxels around the corner have it (of a flat sheet 64 do), not all of them in one layer, and no
/// cube of 2^3 voxels within five voxels of the corner has it alone.  A sheet is held if two of
/// these 8^3 voxels touch by an edge alone at 16 edges or more.  It is a thread if at most 20
/// of these 8^3 voxels have it, some in every layer across some axis.  It is a speck if none of
/// their outermost layer has it.  It is small if at most three have it, and no axis is as for a
/// thread.
[[nodiscard]] std::optional<ThinLabel> thin_label_at(const LabelBox& labels, Point place,
                                                     Label label);

/// Counts the voxels of the part of a label that is nearest to a place: those that hang together by
/// faces.  Returns 0 where they reach the outermost of the 8^3 voxels around the corner nearest to
/// the place, or where no such voxel has the label.
[[nodiscard]] int voxels_of_part(const LabelBox& labels, Point place, Label label);

}  // namespace mw
