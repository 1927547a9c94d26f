// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/figures.h"

#include <algorithm>
#include <array>
#include <span>

#include "engine/finish/interface_shape.h"

namespace mw::engine {
namespace {

/// How many tets are measured at once.
constexpr std::size_t kAtOnce = 64;

}  // namespace

MeshFigures measure(io::ScratchMesh& mesh, const FiguresTask& task, const TetWork& work) {
  MeshFigures out;
  audit::QualityMeter quality;
  each_tet_range<audit::QualityMeter>(
      mesh, work,
      [](const TetRange& range, io::CornerReader& corners) {
        audit::QualityMeter of_range;
        std::array<audit::NumberedTet, kAtOnce> group;
        for (std::size_t t = 0; t < range.tets.size(); t += kAtOnce) {
          const std::size_t count = std::min(kAtOnce, range.tets.size() - t);
          for (std::size_t i = 0; i < count; ++i) {
            group[i] = {range.first + t + i, corners.corners(range.tets[t + i])};
          }
          of_range.add(std::span(group).first(count));
        }
        return of_range;
      },
      [&](audit::QualityMeter&& of_range) { quality.add(of_range); });
  out.quality = quality.report();
  if (task.has_shape) out.shape = interface_shape(mesh, task.sort_bytes, work);
  out.has_shape = task.has_shape;
  return out;
}

std::uint64_t bytes_to_measure(const FiguresTask& task) {
  const std::uint64_t of_shape = task.has_shape ? task.sort_bytes + kLeastShapeBytes : 0;
  return of_shape + (std::uint64_t{1} << 20U);
}

}  // namespace mw::engine
