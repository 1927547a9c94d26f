// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Synthetic labelled volumes: which kind, and the kinds without objects.
#include "kernels/synth/synth.h"

#include <string>

#include "kernels/core/assert.h"
#include "kernels/core/error.h"
#include "kernels/core/index.h"
#include "kernels/synth/cell_objects.h"

namespace mw {
namespace {

/// Fills the slab with value(voxel).
template <class Value>
void fill_slab(const Box3& slab, std::span<RawLabel> out, Value value) {
  std::size_t i = 0;
  for (std::int64_t z = slab.lo.z; z < slab.hi.z; ++z) {
    for (std::int64_t y = slab.lo.y; y < slab.hi.y; ++y) {
      for (std::int64_t x = slab.lo.x; x < slab.hi.x; ++x) out[i++] = value(Index3{x, y, z});
    }
  }
}

void synth_noise(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out) {
  fill_slab(slab, out, [&](Index3 v) {
    return static_cast<RawLabel>((Wide{hash_position(spec.seed, v)} * spec.labels) >> 64);
  });
}

void synth_checkerboard(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out) {
  fill_slab(slab, out,
            [&](Index3 v) { return static_cast<RawLabel>(v.x + v.y + v.z) % spec.labels; });
}

}  // namespace

std::optional<SynthKind> parse_synth_kind(std::string_view name) {
  if (name == "voronoi") return SynthKind::kVoronoi;
  if (name == "tubes") return SynthKind::kTubes;
  if (name == "spheres") return SynthKind::kSpheres;
  if (name == "noise") return SynthKind::kNoise;
  if (name == "checkerboard") return SynthKind::kCheckerboard;
  return std::nullopt;
}

void check_synth_spec(const SynthSpec& spec) {
  if (spec.labels < 1) throw Error(ErrorKind::kUsage, "labels: at least 1 is needed");
  for (const std::int64_t extent : {spec.shape.x, spec.shape.y, spec.shape.z}) {
    if (extent >= 1 && extent <= kMaxAxisVoxels) continue;
    throw Error(ErrorKind::kUsage,
                "shape: each axis needs 1 to " + std::to_string(kMaxAxisVoxels) + " voxels");
  }
}

void synth_slab(const SynthSpec& spec, std::int64_t z0, std::int64_t nz, std::span<RawLabel> out) {
  const Box3 slab{{0, 0, z0}, {spec.shape.x, spec.shape.y, z0 + nz}};
  MW_ASSERT(z0 >= 0 && z0 + nz <= spec.shape.z);
  MW_ASSERT(out.size() == static_cast<std::size_t>(slab.voxels()));
  switch (spec.kind) {
    case SynthKind::kVoronoi:
      return synth_voronoi(spec, slab, out);
    case SynthKind::kTubes:
      return synth_tubes(spec, slab, out);
    case SynthKind::kSpheres:
      return synth_spheres(spec, slab, out);
    case SynthKind::kNoise:
      return synth_noise(spec, slab, out);
    case SynthKind::kCheckerboard:
      return synth_checkerboard(spec, slab, out);
  }
}

}  // namespace mw
