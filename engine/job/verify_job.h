// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh held against its volume.
#pragma once

#include <filesystem>
#include <functional>

#include "engine/output/label_selection.h"
#include "engine/report/verify_report.h"
#include "io/labels/prepared_input.h"
#include "io/mesh/mesh_sink.h"

namespace mw::engine {

/// What is asked instead of what the mesh's file says; what is empty is as the file says.
struct AskedBounds {
  std::optional<bool> interfaces;
  std::optional<bool> smooth;
  std::optional<double> quality_floor;
  std::optional<std::optional<double>> max_distance;
  std::optional<std::optional<double>> max_volume_error;
};

struct VerifyJob {
  const io::LabelVolume& volume;  ///< as opened
  io::InputSteps steps;
  LabelChoice choice;  ///< that the mesh was made with; with neither: what its file says
  AskedBounds asked = {};
  int threads = 0;                        ///< 0: all cores
  std::uint64_t memory = 0;               ///< bytes
  std::filesystem::path folder;           ///< of temporary files
  std::function<void()> between = [] {};  ///< called after each tile; may throw
};

/// P1 to P4 and P8 of the mesh that deliver() writes into a sink, begin to finish: what its run
/// promised, where its file tells, else kOtherPromises, of the labels that the file holds.
/// ERRORS: those of the volume, of its steps, of deliver() and of verify_mesh(); kInput for a file
/// that tells of promises that no run makes; kUsage when interfaces are asked for and labels were
/// left out.
[[nodiscard]] report::Verdict verify(const VerifyJob& job,
                                     const std::function<void(io::MeshSink&)>& deliver);

/// The labels that a mesh is to hold; empty when all are.
[[nodiscard]] audit::KeptLabels kept_labels(const LabelChoice& choice, const io::LabelTable& table);

/// What to check of a mesh of which this was promised.
[[nodiscard]] audit::AuditOptions audit_options(const io::MeshPromises& promises,
                                                const io::VolumeSpace& space);

}  // namespace mw::engine
