// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Synthetic labelled volumes of any size, for tests and benchmarks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw {

enum class SynthKind {
  kVoronoi,       ///< convex grains, labels 1..N, no background
  kTubes,         ///< bent tubes along z, labels 1..N on background 0
  kSpheres,       ///< separate balls, labels 1..N on background 0
  kNoise,         ///< each voxel by itself, labels 0..N-1
  kCheckerboard,  ///< (x + y + z) mod N
};

/// Knows "voronoi", "tubes", "spheres", "noise" and "checkerboard".
[[nodiscard]] std::optional<SynthKind> parse_synth_kind(std::string_view name);

struct SynthSpec {
  SynthKind kind = SynthKind::kVoronoi;
  Index3 shape;
  std::uint64_t labels = 2;  ///< N
  std::uint64_t seed = 0;
};

/// ERRORS: mw::Error(kUsage) unless N >= 1 and each axis has 1 to 2^20 voxels.
void check_synth_spec(const SynthSpec& spec);

/// Writes the voxels of planes z0 .. z0+nz-1, x fastest.  Objects sit in the cells of a jittered
/// grid of at least N cells (fewer only when there are fewer voxels).  Where there are more,
/// neighbouring cells of a row share a label; each has a grain, but only the first a tube or ball.
/// A grain whose seed lies behind the last voxel may have no voxel, so about N labels occur.  Only
/// integers decide, so the bits are the same everywhere; a voxel depends on spec and place alone.
/// REQUIRES: check_synth_spec passes; planes in the shape; out.size() == nz * shape.y * shape.x.
/// Cost: voronoi 27 distances a voxel, others less; no memory that grows with the volume.
void synth_slab(const SynthSpec& spec, std::int64_t z0, std::int64_t nz, std::span<RawLabel> out);

}  // namespace mw
