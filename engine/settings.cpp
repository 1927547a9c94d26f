// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which settings make sense.
#include "engine/settings.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/distance/distance_guard.h"

namespace mw::engine {
namespace {

constexpr int kMaxMarches = 4;
constexpr double kMaxDistance = 16.0;
constexpr int kMaxOdtIterations = 1000;
constexpr double kMaxGradation = 10.0;

[[noreturn]] void refuse(const std::string& setting, const std::string& allowed) {
  throw Error(ErrorKind::kUsage, setting + " must be " + allowed);
}

void check_sizes(const SizeSettings& sizes) {
  if (!(sizes.gradation >= 0.0 && sizes.gradation <= kMaxGradation)) {
    refuse("gradation", "from 0 to 10");
  }
  std::vector<RawLabel> labels;
  for (const LabelSize& s : sizes.labels) {
    if (!(s.longest_edge > 0.0) || !std::isfinite(s.longest_edge)) {
      refuse("size", "positive, for every label");
    }
    labels.push_back(s.label);
  }
  std::sort(labels.begin(), labels.end());
  if (std::adjacent_find(labels.begin(), labels.end()) != labels.end()) {
    refuse("size", "given once for a label");
  }
}

}  // namespace

int largest_cell_level(const MeshSettings& s) {
  constexpr int kMaxLevel = 4;
  if (s.start == StartMesh::kDense) return 0;
  const int block = s.window / 2;
  int level = 0;
  while (level < kMaxLevel && block % (2 << level) == 0) ++level;
  return level;
}

void check(const MeshSettings& s) {
  if (s.window < 4 || s.window > kMaxWindow || s.window % 2 != 0) {
    refuse("window", "an even number from 4 to " + std::to_string(kMaxWindow));
  }
  if (s.marches < 1 || s.marches > kMaxMarches) {
    refuse("marches", "from 1 to " + std::to_string(kMaxMarches));
  }
  if (s.odt_iterations < 1 || s.odt_iterations > kMaxOdtIterations) {
    refuse("odt-iterations", "from 1 to " + std::to_string(kMaxOdtIterations));
  }
  if (!(s.quality_floor >= 0.0 && s.quality_floor <= 0.5)) {
    refuse("quality-floor", "from 0 to 0.5");
  }
  if (s.edge_variance && !(*s.edge_variance > 0.0)) {
    refuse("edge-variance", "positive, or none");
  }
  if (s.target_reduction && !(*s.target_reduction > 0.0 && *s.target_reduction < 1.0)) {
    refuse("target-reduction", "between 0 and 1, or none");
  }
  if (s.max_distance &&
      !(*s.max_distance >= DistanceGuard::least_distance() && *s.max_distance <= kMaxDistance)) {
    refuse("max-distance", "from 0.71 to 16 voxels, or none (the samples are 0.71 voxels apart)");
  }
  check_sizes(s.sizes);
}

}  // namespace mw::engine
