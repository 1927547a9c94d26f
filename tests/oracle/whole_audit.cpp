// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One check after the other.
#include "tests/oracle/whole_audit.h"

#include "kernels/audit/regions/regions.h"
#include "kernels/audit/shape/volumes.h"
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

}  // namespace

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
  const Box3 all{{0, 0, 0}, volume.shape};
  found.place =
      judge_places(places_of_voxels(all, volume.labels, label_count, volume.shape),
                   places_of_mesh({.mesh = mesh}, label_count, frame, volume.shape), volume.shape);
  found.quality = measure_quality(mesh);
  if (options.measure_distance || options.max_distance) {
    found.distance = measure_in_lattice(volume, label_count, mesh, frame, options);
  }
  found.volumes = measure_volumes(volume, label_count, mesh, frame, options.layers);
  found.shape = measure_shape(mesh);
  return judge(std::move(found), options);
}

}  // namespace mw::audit::test
