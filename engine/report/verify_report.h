// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh verify` found, in words and as JSON.
#pragma once

#include "engine/system/stopwatch.h"
#include "io/json/json.h"
#include "io/labels/prepared_input.h"
#include "io/mesh/mesh_record.h"
#include "kernels/audit/audit.h"

namespace mw::report {

/// What the checks ask.
struct Bounds {
  io::MeshPromises promises;
  bool of_run = false;  ///< the mesh's file told what its run promised
  /// What the file says that makes this less than what is asked by default; empty if nothing.
  std::string told = {};
  std::optional<double> max_volume_error = {};
};

/// What is asked of a mesh whose file tells of no run.
inline constexpr io::MeshPromises kOtherPromises{.max_distance = 1.5,
                                                 .quality_floor = audit::kSliverRadiusRatio};

struct Verdict {
  std::optional<io::SpeckFacts> specks;
  std::optional<io::SliceFacts> slices;
  std::optional<io::WeldFacts> welds;
  Bounds bounds;
  audit::AuditReport audit;
  io::LabelTable table;
  io::LabelNames names;
  Index3 layers;

  /// The first check asks whether the file holds a mesh at all.
  [[nodiscard]] bool looked_at() const { return audit.checks.front().passed; }
};

void print_verdict(const Verdict& verdict);

/// Returns name, verdict and detail of each check.
[[nodiscard]] io::Json checks_json(const audit::AuditReport& audit);

/// Adds to the row of a label its Betti numbers on both sides.  REQUIRES: both were counted.
void add_topology(Label label, const audit::AuditReport& report, io::Json& row);

/// Returns what was checked and found, without settings and performance.
[[nodiscard]] io::Json verdict_json(const Verdict& verdict);

/// Returns the whole report, with the settings of the command.
[[nodiscard]] io::Json verify_report(const io::Json& settings, const Verdict& verdict,
                                     const engine::Resources& resources);

}  // namespace mw::report
