// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh held against its volume.
#pragma once

#include <filesystem>
#include <functional>

#include "engine/output/label_choice.h"
#include "engine/report/verify_report.h"
#include "io/labels/prepared_input.h"
#include "io/mesh/mesh_sink.h"

namespace mw::engine {

struct VerifyJob {
  const io::LabelVolume& volume;  ///< as opened
  io::InputSteps steps;
  LabelChoice choice;  ///< that the mesh was made with
  /// What is asked, given what the mesh tells of the run that made it.
  std::function<report::Bounds(const io::MeshRecord& record)> bounds;
  audit::AuditOptions checks = {};        ///< bounds that no run promises; the rest is overruled
  int threads = 0;                        ///< 0: all cores
  std::uint64_t memory = 0;               ///< bytes
  std::filesystem::path folder;           ///< of temporary files
  std::function<void()> between = [] {};  ///< called after each tile; may throw
};

/// P1 to P4 and P8 of the mesh that deliver() writes into a sink, begin to finish.
/// ERRORS: those of the volume, of its steps, of deliver() and of verify_mesh().
[[nodiscard]] report::Verdict verify(const VerifyJob& job,
                                     const std::function<void(io::MeshSink&)>& deliver);

/// The labels that a mesh is to hold; empty when all are.
[[nodiscard]] audit::KeptLabels kept_labels(const LabelChoice& choice, const io::LabelTable& table);

/// `others` with what was promised in it.
[[nodiscard]] audit::AuditOptions audit_options(const io::MeshPromises& promises,
                                                const io::VolumeSpace& space,
                                                const audit::AuditOptions& others = {});

}  // namespace mw::engine
