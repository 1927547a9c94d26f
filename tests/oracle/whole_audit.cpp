// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One check after the other.
#include "tests/oracle/whole_audit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kernels/audit/distance/mesh.h"
#include "kernels/audit/distance/tile.h"
#include "kernels/audit/partition/centres.h"
#include "kernels/audit/partition/overlap.h"
#include "kernels/audit/regions/regions.h"
#include "kernels/audit/topology/parts_union.h"
#include "kernels/core/error.h"
#include "tests/oracle/whole_junctions.h"

namespace mw::audit::test {
namespace {

/// In voxels of the lattice that the options ask for.
DistanceReport measure_in_lattice(const VoxelLabels& volume, std::size_t label_count,
                                  const AuditMesh& mesh, const Frame& frame,
                                  const AuditOptions& options) {
  const Index3 layers = options.layers;
  const double limit = distance_limit(options.max_distance);
  if (layers == Index3{1, 1, 1}) {
    return measure_distance(volume, label_count, mesh, frame, options.kept, limit);
  }
  const LayeredLabels lattice = layered_labels(volume, layers);
  return measure_distance(lattice.view(), label_count, mesh, layered_frame(frame, layers),
                          options.kept, limit);
}

/// Returns nothing when the input is no mesh; the check tells why.
std::optional<MeshStars> check_input(const AuditMesh& mesh, Check& check) {
  check.name = "P2 input";
  std::optional<MeshStars> stars;
  try {
    stars.emplace(mesh);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    check.detail = error.what();
    return std::nullopt;
  }
  Offenders endless("vertices that are not finite");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Position& p = mesh.vertices[v];
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
    endless.add([v] { return std::to_string(v); });
  }
  check = input_check(mesh.vertices.size(), mesh.tets.size(), endless);
  return check.passed ? std::move(stars) : std::nullopt;
}

/// Whole numbers of voxels by pairs of labels, instead of sorts.
Check check_places(const VoxelLabels& volume, std::size_t label_count, const AuditMesh& mesh,
                   const Frame& frame, const AuditOptions& options) {
  const Box3 all{{0, 0, 0}, volume.shape};
  const auto centres =
      centre_labels(centre_runs({.mesh = mesh}, label_count, frame, volume.shape, options.layers),
                    all, volume.shape);
  const WantedCentres wanted = wanted_centres(label_count, options.kept, options.partial);
  PlaceSamples samples(volume.shape);
  samples.put(all, volume.labels, centres, wanted);
  ExchangedLabels exchanged(options.label_text);
  const auto voxels = [&](Label l) {
    return std::count(volume.labels.begin(), volume.labels.end(), l);
  };
  for (Label a = 0; a < label_count; ++a) {
    for (Label b = a + 1; b < label_count; ++b) {
      std::uint64_t swapped = 0;
      for (std::size_t i = 0; i < centres.size(); ++i) {
        const Label l = volume.labels[i], m = centres[i];
        if (wanted[l] == l && ((l == a && m == b) || (l == b && m == a))) ++swapped;
      }
      exchanged.add(a, b, static_cast<std::uint64_t>(voxels(a) + voxels(b)), swapped);
    }
  }
  return judge_places(tally_places(volume.labels, centres, wanted), samples, exchanged);
}

Check check_overlap(const MeshStars& stars, const Frame& frame, Index3 shape) {
  std::vector<LineCrossing> crossings = line_crossings(stars, frame, shape);
  std::sort(crossings.begin(), crossings.end());
  OverlapCheck check(shape);
  for (const LineCrossing& crossing : crossings) check.add(crossing);
  return check.verdict();
}

ValidityTask task_of(const VoxelLabels& volume, const Frame& frame, std::size_t label_count,
                     const KeptLabels& kept) {
  ValidityTask task{frame, volume.shape, std::vector<bool>(label_count), !kept.empty()};
  for (const Label l : volume.labels) {
    if (l < label_count && keeps(kept, l)) task.wanted[l] = true;
  }
  return task;
}

}  // namespace

std::vector<RegionBetti> voxel_betti(const VoxelLabels& volume, std::size_t label_count) {
  PartsUnion parts(label_count);
  parts.add(voxel_parts(whole(volume), label_count).piece);
  return parts.betti_of_volume();
}

ValidityReport check_validity(const AuditMesh& mesh, const VoxelLabels& volume, const Frame& frame,
                              std::size_t label_count, const KeptLabels& kept) {
  Check input;
  const std::optional<MeshStars> stars = check_input(mesh, input);
  ValidityReport report;
  if (stars) {
    const ValidityTask task = task_of(volume, frame, label_count, kept);
    report = judge_validity(tally_validity(*stars, task), task);
    if (task.has_gaps) report.checks.push_back(check_overlap(*stars, frame, volume.shape));
  }
  report.checks.insert(report.checks.begin(), std::move(input));
  return report;
}

QualityReport measure_quality(const AuditMesh& mesh) {
  return tally_quality({.mesh = mesh}).report();
}

DistanceReport measure_distance(const VoxelLabels& volume, std::size_t label_count,
                                const AuditMesh& mesh, const Frame& frame, const KeptLabels& kept,
                                double limit) {
  const auto triangles =
      interface_triangles(MeshStars(mesh), label_count, frame, volume.shape, !kept.empty());
  PieceEstimates estimates{};
  for (const InterfaceTriangle& t : triangles) add_estimates(t.corners, estimates);
  const double max = piece_radius(estimates);
  std::vector<InterfaceTriangle> pieces;
  for (const InterfaceTriangle& t : triangles) {
    for_each_piece(t.corners, max, [&](const VoxelTriangle& piece) {
      pieces.push_back({piece, t.labels});
    });
  }
  const auto rows = measure_distances({.voxels = whole(volume),
                                       .pieces = pieces,
                                       .label_count = label_count,
                                       .kept = kept,
                                       .samples = {{0, 0, 0}, volume.shape},
                                       .limit = limit});
  return conclude_distances(rows, limit, std::numeric_limits<double>::infinity());
}

VolumeReport measure_volumes(const VoxelLabels& volume, std::size_t label_count,
                             const AuditMesh& mesh, const Frame& frame, Index3 layers) {
  const Box3 all{{0, 0, 0}, volume.shape};
  return compare_volumes(count_voxels(volume, all, all, label_count, layers),
                         tally_volumes({.mesh = mesh}, label_count, layered_frame(frame, layers)),
                         layers.product());
}

ShapeReport measure_shape(const AuditMesh& mesh) {
  return audit::measure_shape(MeshStars(mesh)).report();
}

AuditReport audit(const VoxelLabels& volume, std::size_t label_count, const AuditMesh& mesh,
                  const Frame& frame, const AuditOptions& options) {
  AuditFindings found{.voxels = voxel_betti(volume, label_count),
                      .validity = check_validity(mesh, volume, frame, label_count, options.kept)};
  if (!found.validity.checks.front().passed) return judge(std::move(found), options);
  found.mesh =
      options.kept.empty() ? mesh_betti(mesh, label_count) : region_betti(mesh, label_count);
  if (options.count_junctions) {
    found.junctions = compare_junctions(junctions_of_volume(volume, label_count),
                                        junctions_of_mesh(mesh, label_count));
  }
  const auto in_voxels = voxel_parts(whole(volume), label_count).pinches;
  const auto in_mesh = mesh_pinches(MeshStars(mesh), label_count);
  for (std::size_t label = 0; label < label_count; ++label) {
    found.pinches.push_back({in_voxels[label].in_layers(options.layers), in_mesh[label]});
  }
  found.place = check_places(volume, label_count, mesh, frame, options);
  found.quality = measure_quality(mesh);
  if (options.measure_distance || options.max_distance) {
    found.distance = measure_in_lattice(volume, label_count, mesh, frame, options);
  }
  found.volumes = measure_volumes(volume, label_count, mesh, frame, options.layers);
  found.shape = measure_shape(mesh);
  return judge(std::move(found), options);
}

std::vector<std::string> failures(const AuditReport& report) {
  std::vector<std::string> names;
  for (const Check& c : report.checks) {
    if (!c.passed) names.push_back(c.name);
  }
  return names;
}

}  // namespace mw::audit::test
