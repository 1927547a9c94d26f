// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bodies whose shape is known, in voxels, and their meshes.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernels/audit/shape/volumes.h"
#include "tests/engine/figures_of.h"
#include "tests/engine/memory_run.h"

namespace mw::engine::test {

/// Voxels take the label at their centres.
template <typename LabelAt>
SmallVolume body(std::int64_t edge, std::size_t labels, LabelAt label_at) {
  SmallVolume out{{edge, edge, edge}, labels, {}};
  for_each_index(out.shape, [&](Index3 v) {
    const auto centre = [](std::int64_t i) { return static_cast<double>(i) + 0.5; };
    out.labels.push_back(label_at(Vec3(centre(v.x), centre(v.y), centre(v.z))));
  });
  return out;
}

/// What a run made of a volume, and what is measured of it.
struct Result {
  RunReport report;
  FiguresAndVolumes figures;
  SmallMesh mesh;

  /// The largest share by which a label's volume is off.
  [[nodiscard]] double volume_error() const {
    double max = 0.0;
    for (std::size_t l = 0; l < report.label_voxels.size(); ++l) {
      const auto row = audit::volume_row(static_cast<Label>(l), report.label_voxels[l],
                                         figures.label_volumes6[l]);
      max = std::max(max, std::abs(row.error));
    }
    return max;
  }
};

inline Result run(const SmallVolume& voxels, const MeshSettings& settings = {}) {
  const MemoryVolume volume(voxels, {});
  const io::LabelTable table = io::collect_labels(volume);
  RunHooks hooks;
  MemorySink sink;
  Result out;
  const io::DenseVolume labels(volume, table);
  out.report = mesh_volume(labels, settings, sink, hooks);
  out.figures = figures_of(sink.mesh(), labels);
  out.mesh = small_mesh(sink.mesh());
  EXPECT_GE(out.figures.quality.radius_ratio_min, 0.2 - 1e-9);
  return out;
}

inline SmallVolume ball(double radius, const Vec3& centre, std::int64_t edge) {
  return body(edge, 2, [&](const Vec3& p) { return (p - centre).norm() < radius ? 1U : 0U; });
}

}  // namespace mw::engine::test
