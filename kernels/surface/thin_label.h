// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where a label of the input is a sheet, a thread or a lump of less than two voxels.
#pragma once

#include "kernels/core/label.h"
#include "kernels/core/lattice.h"

namespace mw {

/// Returns true if none of the 27 cubes of 2^3 voxels around the voxel corner nearest to a place,
/// which reach two voxels away from it, has that label alone.  Voxels outside of `labels` do not
/// have it.
[[nodiscard]] bool is_thin_at(const LabelBox& labels, Point place, Label label);

/// Returns true if the label is a wide sheet of about one voxel there: at least 56 of the 8^3
/// voxels around that corner have it (of a flat sheet 64 do), and no cube of 2^3 voxels within five
/// voxels of the corner has it alone.
[[nodiscard]] bool is_sheet_at(const LabelBox& labels, Point place, Label label);

/// Returns true if the label is a thread of about one voxel that goes on there: it is thin, and at
/// most 20 of the 8^3 voxels around that corner have it, some in every layer across some axis.
[[nodiscard]] bool is_thread_at(const LabelBox& labels, Point place, Label label);

/// Returns true if the label is thin there, and none of the voxels in the layer beyond three voxels
/// away from that corner has it: what is there of it is one of a few voxels, or several such.
[[nodiscard]] bool is_speck_at(const LabelBox& labels, Point place, Label label);

}  // namespace mw
