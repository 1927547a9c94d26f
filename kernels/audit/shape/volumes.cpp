// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes in whole numbers where vertices are on the lattice, in double elsewhere.
#include "kernels/audit/shape/volumes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kernels/core/error.h"
#include "kernels/core/index.h"
#include "kernels/core/lattice.h"
#include "kernels/core/vector3.h"

namespace mw::audit {
namespace {

/// A point in lattice units.  Differences of two fit 33 bits, so a determinant fits 102.
using LatticePoint = std::array<std::int64_t, 3>;

/// The coordinate in lattice units when it is what a multiple of the unit rounds to.
std::optional<std::int64_t> lattice_coordinate(double x, double origin, double spacing) {
  constexpr double kMax = std::numeric_limits<std::int32_t>::max();
  // The product, the sum and a text read back each round by half a unit in the last place.
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  const double units = std::nearbyint((x - origin) / spacing * kUnitsPerVoxel);
  if (!(std::abs(units) <= kMax)) return std::nullopt;
  const double back = origin + spacing * (units / kUnitsPerVoxel);
  if (std::abs(back - x) > kRounding * (std::abs(origin) + std::abs(x))) return std::nullopt;
  return static_cast<std::int64_t>(units);
}

/// Returns all vertices in lattice units, or nothing when one is not on the lattice.
std::optional<std::vector<LatticePoint>> lattice_points(const AuditMesh& mesh, const Frame& frame) {
  std::vector<LatticePoint> out;
  out.reserve(mesh.vertices.size());
  for (const Position& p : mesh.vertices) {
    LatticePoint& q = out.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto units = lattice_coordinate(p[k], frame.origin[k], frame.spacing[k]);
      if (!units) return std::nullopt;
      q[k] = *units;
    }
  }
  return out;
}

Int128 size6(const std::vector<LatticePoint>& points, const TetRow& t) {
  std::array<std::array<Int128, 3>, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) e[i][k] = points[t[i + 1]][k] - points[t[0]][k];
  }
  const Int128 det = determinant(e[0], e[1], e[2]);
  return det < 0 ? -det : det;
}

void check_shape(Index3 shape) {
  constexpr std::int64_t kMaxVoxels = std::int64_t{1} << 20;
  const std::int64_t longest = std::max({shape.x, shape.y, shape.z});
  if (longest <= kMaxVoxels) return;
  throw Error(ErrorKind::kResource, "distances: thick slices would be cut into " +
                                        std::to_string(longest) + " layers along an axis, above " +
                                        std::to_string(kMaxVoxels));
}

}  // namespace

double volume_bound(const VolumeRow& row, double bound) {
  constexpr double kRoughness = 2.5;
  return bound * std::max(1.0, kRoughness * row.faces_a_voxel);
}

std::vector<VoxelCount> count_voxels(const VoxelLabels& voxels, const Box3& loaded, const Box3& box,
                                     std::size_t label_count, Index3 layers) {
  std::vector<VoxelCount> out(label_count);
  const Index3 steps[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::int64_t faces[] = {layers.y * layers.z, layers.x * layers.z, layers.x * layers.y};
  const auto at = [&](Index3 v) {
    return voxels.labels[static_cast<std::size_t>(loaded.offset(v))];
  };
  for_each_index(box, [&](Index3 v) {
    const Label label = at(v);
    ++out[label].voxels;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Index3 before = v - steps[axis];
      if (!loaded.contains(before) || at(before) == label) continue;
      out[label].faces += static_cast<std::uint64_t>(faces[axis]);
      out[at(before)].faces += static_cast<std::uint64_t>(faces[axis]);
    }
  });
  return out;
}

VolumeRow volume_row(Label label, std::uint64_t voxels, Int128 volume6, std::int64_t parts) {
  const Int128 of_voxel = Int128{kVoxelVolume6} * parts;
  const Int128 expected = of_voxel * voxels;
  return {.label = label,
          .voxels = voxels,
          .volume_voxels = static_cast<double>(volume6) / static_cast<double>(of_voxel),
          .error = static_cast<double>(volume6 - expected) / static_cast<double>(expected)};
}

void VolumeMeter::add(const VolumeRow& row) {
  if (row.voxels < kMinJudgedVoxels) return;
  const double size = std::abs(row.error);
  if (summary_.labels_measured++ == 0 || size > summary_.error_max_abs) {
    summary_.error_max_abs = size;
    summary_.worst = row;
  }
  sum_.add(size);
}

VolumeSummary VolumeMeter::summary() const {
  VolumeSummary out = summary_;
  if (out.labels_measured > 0) {
    out.error_mean_abs = sum_.value() / static_cast<double>(out.labels_measured);
  }
  return out;
}

void VolumeTally::add(const VolumeTally& other, std::span<const Label> labels) {
  for (std::size_t l = 0; l < other.exact.size(); ++l) {
    exact[labels[l]] += other.exact[l];
    rounded[labels[l]].add(other.rounded[l]);
  }
  is_exact = is_exact && other.is_exact;
}

VolumeTally tally_volumes(const MeshTile& tile, std::size_t label_count, const Frame& frame) {
  VolumeTally out{std::vector<Int128>(label_count), std::vector<CompensatedSum>(label_count)};
  const AuditMesh& mesh = tile.mesh;
  const auto exact = lattice_points(mesh, frame);
  std::vector<Position> rounded(mesh.vertices.begin(), mesh.vertices.end());
  for (Position& p : rounded) p = frame.in_voxels(p);
  out.is_exact = exact.has_value();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Label label = mesh.labels[t];
    if (label >= label_count || !tile.owns_tet(t)) continue;
    if (exact) out.exact[label] += size6(*exact, mesh.tets[t]);
    const auto& [a, b, c, d] = mesh.tets[t];
    const double size = std::abs(volume6(rounded[a], rounded[b], rounded[c], rounded[d]));
    out.rounded[label].add(size / 6);
  }
  return out;
}

VolumeReport compare_volumes(std::span<const VoxelCount> counts, const VolumeTally& mesh,
                             std::int64_t parts) {
  VolumeReport report{.summary = {}, .per_label = {}, .exact = mesh.is_exact};
  VolumeMeter meter;
  for (Label l = 0; l < counts.size(); ++l) {
    const auto [voxels, faces] = counts[l];
    if (voxels == 0) continue;
    const auto input = static_cast<double>(voxels);
    const double found = mesh.rounded[l].value() / static_cast<double>(parts);
    VolumeRow row = mesh.is_exact ? volume_row(l, voxels, mesh.exact[l], parts)
                                  : VolumeRow{l, voxels, found, (found - input) / input};
    row.faces_a_voxel = static_cast<double>(faces) / (input * static_cast<double>(parts));
    report.per_label.push_back(row);
    meter.add(row);
  }
  report.summary = meter.summary();
  return report;
}

LayeredLabels layered_labels(const VoxelLabels& volume, Index3 layers) {
  LayeredLabels out{layered_shape(volume.shape, layers), {}};
  check_shape(out.shape);
  out.labels.reserve(static_cast<std::size_t>(out.shape.product()));
  const Box3 all{{0, 0, 0}, volume.shape};
  for (std::int64_t z = 0; z < out.shape.z; ++z) {
    for (std::int64_t y = 0; y < out.shape.y; ++y) {
      const auto row = volume.labels.begin() + all.offset({0, y / layers.y, z / layers.z});
      for (std::int64_t x = 0; x < volume.shape.x; ++x) {
        out.labels.insert(out.labels.end(), static_cast<std::size_t>(layers.x), row[x]);
      }
    }
  }
  return out;
}

Frame layered_frame(const Frame& frame, Index3 layers) {
  return {.spacing = layered_spacing(frame.spacing, layers), .origin = frame.origin};
}

}  // namespace mw::audit
