// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The two halves, put together.
#include "engine/verify/verify_mesh.h"

#include "engine/labels/reading_tiles.h"
#include "engine/verify/mesh_stage.h"
#include "engine/verify/volume_stage.h"
#include "kernels/audit/kept_orientation.h"
#include "kernels/core/each_index.h"

namespace mw::engine {
namespace {

/// Every label of the table is that of a voxel.
audit::ValidityTask validity_task(const io::DenseVolume& volume, const MeshTiles& mesh,
                                  const VerifyTask& task) {
  const audit::KeptLabels& kept = task.options.kept;
  return {.frame = mesh.frame(),
          .shape = volume.info().shape,
          .wanted = kept.empty() ? std::vector<bool>(volume.table().size(), true) : kept,
          .has_gaps = !kept.empty()};
}

/// All voxels, tile by tile, so that no chunk of a store is unpacked twice.
std::vector<Label> read_all(const io::DenseVolume& volume) {
  const Box3 all{{0, 0, 0}, volume.info().shape};
  std::vector<Label> out(static_cast<std::size_t>(all.voxels()));
  const ReadingTiles tiles(volume.info());
  std::vector<Label> tile;
  each_index(tiles.count(), [&](Index3 t) {
    const Box3 box = tiles.box(t);
    tile.resize(static_cast<std::size_t>(box.voxels()));
    volume.read(box, tile);
    auto row = tile.begin();
    for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
      for (v.y = box.lo.y; v.y < box.hi.y; ++v.y, row += box.shape().x) {
        std::copy_n(row, box.shape().x, out.begin() + all.offset(v));
      }
    }
  });
  return out;
}

audit::PlacesReport compare_places(const io::DenseVolume& volume, const audit::Places& mesh) {
  const std::vector<Label> voxels = read_all(volume);
  return audit::compare_places(
      audit::voxel_places({volume.info().shape, voxels}, volume.table().size()), mesh);
}

}  // namespace

audit::AuditReport verify_mesh(const io::DenseVolume& volume, const MeshTiles& mesh,
                               const VerifyTask& task) {
  const audit::Check input = mesh.input_check();
  audit::AuditFindings findings;
  findings.validity.checks.push_back(input);
  const bool with_distance = task.options.measure_distance || task.options.max_distance;
  if (!input.passed) {
    findings.voxels = look_at_volume(volume, mesh.grid(), task, nullptr).betti;
    return audit::judge(std::move(findings), task.options);
  }
  PieceBuckets pieces(task.folder, mesh.grid(), task.options.layers, task.memory_bytes / 8);
  const audit::ValidityTask validity = validity_task(volume, mesh, task);
  MeshFindings found =
      look_at_mesh(mesh, volume.table().size(), validity, task, with_distance ? &pieces : nullptr);
  pieces.make_pieces();
  VolumeFindings voxels =
      look_at_volume(volume, mesh.grid(), task, with_distance ? &pieces : nullptr);
  findings.validity = audit::judge_validity(found.validity, validity);
  findings.validity.checks.insert(findings.validity.checks.begin(), input);
  if (found.overlap) findings.validity.checks.push_back(*found.overlap);
  findings.voxels = std::move(voxels.betti);
  findings.mesh = std::move(found.betti);
  if (found.places) findings.places = compare_places(volume, *found.places);
  findings.quality = found.quality.report();
  findings.distance = std::move(voxels.distance);
  findings.volumes =
      audit::compare_volumes(voxels.voxels, found.volumes, task.options.layers.product());
  findings.shape = found.shape.report();
  audit::AuditReport report = audit::judge(std::move(findings), task.options);
  if (mesh.is_turned()) report.checks.push_back(audit::kept_orientation(found.turned));
  return report;
}

}  // namespace mw::engine
