// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Checks a mesh against its volume.
#pragma once

#include <filesystem>
#include <functional>

#include "engine/output/label_selection.h"
#include "engine/report/verify_report.h"
#include "io/labels/prepared_input.h"
#include "io/mesh/mesh_sink.h"

namespace mw::engine {

/// Bounds to check instead of those in the mesh's file; where one is empty, the file's counts.
struct AskedBounds {
  std::optional<bool> interfaces;
  std::optional<double> quality_floor;
  std::optional<std::optional<double>> max_distance;
  std::optional<std::optional<double>> max_volume_error;
};

struct VerifyJob {
  const io::LabelVolume& volume;  ///< as opened
  io::InputSteps steps;
  LabelChoice choice;  ///< of the run that made the mesh; if empty, its file tells
  AskedBounds asked = {};
  int threads = 0;                        ///< 0: all cores
  std::uint64_t memory = 0;               ///< bytes
  std::filesystem::path folder;           ///< of temporary files
  std::function<void()> between = [] {};  ///< called often, by any thread; may throw
};

/// Checks P1 to P4 and P8 of the mesh that deliver() writes into a sink, from begin to finish, for
/// the labels that the file holds: with the promises in the file if any, else kOtherPromises.
/// ERRORS: those of the volume, of its steps, of deliver() and of verify_mesh(); kInput for a file
/// that tells of promises that no run makes; kUsage when interfaces are asked for and labels were
/// left out.
[[nodiscard]] report::Verdict verify(const VerifyJob& job,
                                     const std::function<void(io::MeshSink&)>& deliver);

/// Returns the labels that a mesh is to hold; empty when it is to hold all.
[[nodiscard]] audit::KeptLabels kept_labels(const LabelChoice& choice, const io::LabelTable& table);

/// Returns what to check of a mesh that was made with these promises.
[[nodiscard]] audit::AuditOptions audit_options(const io::MeshPromises& promises,
                                                const io::VolumeInfo& volume);

}  // namespace mw::engine
