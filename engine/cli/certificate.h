// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether a run checks its own mesh before it delivers it, and what it found.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/cli/mesh_request.h"
#include "engine/verify/certified_sink.h"
#include "kernels/audit/audit.h"

namespace mw::cli {

/// What a certificate takes of a run's budget: a quarter at most.
struct CertificatePlan {
  std::string why_not;  ///< empty: it is made
  int threads = 0;
  std::uint64_t memory_bytes = 0;
};

/// ERRORS: mw::Error(kUsage) when it is asked for and cannot be had.
[[nodiscard]] CertificatePlan plan_certificate(const MeshRequest& request);

/// Checks a mesh on its way into a sink: P1 to P4, as the run promises them.
class Certifier {
 public:
  /// volume and sink outlive it.  REQUIRES: plan.why_not is empty.
  Certifier(const CertificatePlan& plan, const MeshRequest& request, const io::DenseVolume& volume,
            io::MeshSink& sink);

  /// Where the mesh goes.  Its finish() throws mw::Error(kCheckFailed), naming what fails.
  [[nodiscard]] io::MeshSink& sink() { return sink_; }
  /// REQUIRES: the sink is finished.
  [[nodiscard]] const audit::AuditReport& report() const { return *report_; }

 private:
  void certify(const CertificatePlan& plan);

  const io::DenseVolume& volume_;
  std::filesystem::path folder_;
  audit::KeptLabels kept_;
  engine::MeshTiles tiles_;
  engine::CertifiedSink sink_;
  std::optional<audit::AuditReport> report_;
};

}  // namespace mw::cli
