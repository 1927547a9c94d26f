// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Puts the two halves of a verification together.
#include "engine/verify/verify_mesh.h"

#include "engine/verify/mesh_stage.h"
#include "engine/verify/volume_stage.h"
#include "kernels/audit/partition/orientation.h"

namespace mw::engine {
namespace {

/// Returns what is asked of the mesh; every label of the table is that of a voxel.
audit::ValidityTask validity_task(const io::DenseVolume& volume, const MeshTiles& mesh,
                                  const VerifyTask& task) {
  const audit::KeptLabels& kept = task.options.kept;
  return {.frame = mesh.frame(),
          .shape = volume.info().shape,
          .wanted = kept.empty() ? std::vector<bool>(volume.table().size(), true) : kept,
          .has_gaps = !kept.empty(),
          .label_text = task.options.label_text};
}

std::vector<audit::LabelPinches> label_pinches(const MeshFindings& mesh,
                                               const VolumeFindings& volume, Index3 layers) {
  std::vector<audit::LabelPinches> out;
  for (std::size_t label = 0; label < mesh.pinches.size(); ++label) {
    out.push_back({volume.pinches[label].in_layers(layers), mesh.pinches[label]});
  }
  return out;
}

/// Returns what is asked of a mesh: curved tets are looked at in parts, each edge of which is half
/// of one of theirs.
audit::AuditOptions asked_of(const MeshTiles& mesh, audit::AuditOptions options) {
  if (mesh.curved() && options.halvings) ++*options.halvings;
  return options;
}

}  // namespace

audit::AuditReport verify_mesh(const io::DenseVolume& volume, MeshTiles& mesh,
                               const VerifyTask& task) {
  const audit::Check input = mesh.input_check();
  audit::AuditFindings findings;
  findings.validity.checks.push_back(input);
  const bool with_distance = task.options.measure_distance || task.options.max_distance;
  if (!input.passed) {
    findings.voxels = look_at_volume(volume, mesh.grid(), task, {}).betti;
    return audit::judge(std::move(findings), task.options);
  }
  PieceBuckets pieces(task.folder, mesh.grid(), task.options.layers, task.memory_bytes / 8);
  CentreBuckets centres(task.folder, mesh.grid().size(), task.memory_bytes / 16);
  std::optional<JunctionLedger> junctions;
  if (task.options.count_junctions) junctions.emplace(task.folder, task.memory_bytes / 8);
  JunctionLedger* const ledger = junctions ? &*junctions : nullptr;
  const audit::ValidityTask validity = validity_task(volume, mesh, task);
  MeshFindings found = look_at_mesh(mesh, volume.table().size(), validity, task,
                                    {&centres, with_distance ? &pieces : nullptr, ledger});
  pieces.make_pieces(task.threads);
  VolumeFindings voxels = look_at_volume(volume, mesh.grid(), task,
                                         {&centres, with_distance ? &pieces : nullptr, ledger});
  findings.validity = audit::judge_validity(found.validity, validity);
  findings.validity.checks.insert(findings.validity.checks.begin(), input);
  if (mesh.curved()) findings.validity.checks.push_back(mesh.curved()->jacobians());
  if (found.overlap) findings.validity.checks.push_back(*found.overlap);
  if (task.options.periodic != 0 && !validity.has_gaps) {
    findings.validity.checks.push_back(audit::periodic_check(found.faces, task.options.periodic));
  }
  findings.voxels = std::move(voxels.betti);
  findings.mesh = std::move(found.betti);
  findings.pinches = label_pinches(found, voxels, task.options.layers);
  if (junctions) findings.junctions = junctions->compare();
  findings.place = std::move(voxels.place);
  findings.quality = (mesh.curved() ? mesh.curved()->corners() : found.quality).report();
  findings.distance = std::move(voxels.distance);
  if (mesh.curved()) {
    found.volumes.is_exact = false;
    for (std::size_t label = 0; label < mesh.beyond_parts().size(); ++label) {
      found.volumes.rounded[label].add(mesh.beyond_parts()[label]);
    }
  }
  findings.volumes =
      audit::compare_volumes(voxels.voxels, found.volumes, task.options.layers.product());
  findings.shape = found.shape.report();
  audit::AuditReport report = audit::judge(std::move(findings), asked_of(mesh, task.options));
  if (mesh.is_turned()) report.checks.push_back(audit::kept_orientation(found.turned));
  return report;
}

}  // namespace mw::engine
