// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Label coarsening: voxels change labels, one proven flip at a time, until small cubes are uniform.
#pragma once

#include "kernels/core/label.h"
#include "kernels/size/size_field.h"

namespace mw {

/// Voxels around a tile that its coarsened labels depend on.
inline constexpr std::int64_t kCoarsenHalo = 16;

/// How far around a cube of 2^3 voxels its visit looks at labels.
inline constexpr std::int64_t kCoarsenReach = 2;

/// Which cubes may be coarsened.
struct CoarsenRegion {
  Box3 within;  ///< cubes that are not wholly in this box, usually the volume, stay as they are
  /// If true, a cube stays, too, where two labels meet in a plane that halves it and goes on for a
  /// voxel all around it: where such a plane ends at cubes that stay, it would get a step there.
  bool keeps_flat = false;
};

struct CoarsenStats {
  std::uint64_t mixed_cubes = 0;
  std::uint64_t made_uniform = 0;

  CoarsenStats& operator+=(const CoarsenStats& other) {
    mixed_cubes += other.mixed_cubes;
    made_uniform += other.made_uniform;
    return *this;
  }
};

/// Relabels voxels so that most cubes of 2^3 voxels at even positions become uniform: then the
/// octree of the start mesh can begin one level coarser at interfaces, with a quarter of the
/// vertices.  Shape is not lost, because quadrics and samples still come from the input's labels.
///
/// A cube takes the label that most of its voxels have, or the next that three of them have, when
/// every voxel gets there by changes of label that keep topology (simple_voxel.h), when no label is
/// pinched then where it was not (pinches.h), and when afterwards
///  - each of its voxels lies within D of an input voxel of that label (output to input), and
///  - each input face between two labels that loses its carrier finds another (input to output,
///    carrier_faces.h).
/// A label with only two voxels of the cube would be a thread that becomes four times as thick and
/// touches labels that it is not near in the input; no face would draw it back from there.
/// Otherwise the cube stays as it was, and so does a cube where sizes do not allow cells of twice
/// its edge: vertices could not go back from there to where the input has the interface, as edges
/// may not become longer on the way.
///
/// Cubes are visited in eight colours, by the parity of their position; cubes of one colour do not
/// see each other, so the result is a local function: it depends on labels nearer than
/// kCoarsenHalo.
///
/// `labels` holds the input's labels on entry and the coarsened ones of `tile` on return; the halo
/// is scratch.  sizes limit edges; null sets no limits.
/// REQUIRES: original and labels are equal and cover the tile with its halo; tile inside the volume
///           with even low corner, and even high corner where that is not the volume's side;
///           region.within has an even low corner.
/// ENSURES: every label keeps its topology, and is pinched only where the input is; tiles fit
///          together; statistics count cubes in the tile.
CoarsenStats coarsen(const LabelBox& original, LabelBox& labels, const Box3& tile,
                     const CoarsenRegion& region, double max_distance,
                     const SizeField* sizes = nullptr);

}  // namespace mw
