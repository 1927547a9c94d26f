// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The kinds of synthetic volumes that are made of objects in cells.
#pragma once

#include "kernels/synth/synth.h"

namespace mw {

/// All: out has the voxels of slab, whole planes of the volume, x fastest.
void synth_voronoi(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out);
void synth_tubes(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out);
void synth_spheres(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out);

}  // namespace mw
