// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether a run checks its own mesh before it delivers it, and what it found.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/job/mesh_job.h"
#include "engine/verify/mesh_tiles.h"
#include "io/mesh/mesh_sink.h"
#include "kernels/audit/audit.h"

namespace mw::engine {

/// Passes a mesh on to a sink and to tiles.  When it is complete, certify() looks at the tiles;
/// when that throws, the sink is not finished, so that nothing appears under its name.
class CertifiedSink : public io::TeeSink {
 public:
  /// bytes is the memory that certify() takes.  REQUIRES: sink and tiles outlive it.
  CertifiedSink(io::MeshSink& sink, MeshTiles& tiles, std::uint64_t bytes,
                std::function<void()> certify)
      : TeeSink(sink, tiles),
        sink_(sink),
        tiles_(tiles),
        bytes_(bytes),
        certify_(std::move(certify)) {}

  void finish() override {
    tiles_.finish();
    certify_();
    sink_.finish();
  }
  [[nodiscard]] std::uint64_t buffer_bytes() const override {
    return sink_.buffer_bytes() + bytes_;
  }

 private:
  io::MeshSink& sink_;
  MeshTiles& tiles_;
  std::uint64_t bytes_;
  std::function<void()> certify_;
};

/// Returns the plan with as many threads as fit beside what the rest of the run takes while the
/// mesh is written.  With Certify::kAuto there is none where not even one does: more memory must
/// not make a run impossible.
[[nodiscard]] CertificatePlan beside_others(const CertificatePlan& plan, const MeshJob& job,
                                            std::uint64_t others);

/// Checks a mesh on its way into a sink: P1 to P4 and P8, as the run promises them.
class Certifier {
 public:
  /// volume and sink outlive it; stop is called between tiles and may throw.
  /// REQUIRES: plan.why_not is empty.
  Certifier(const CertificatePlan& plan, const MeshJob& job, const io::DenseVolume& volume,
            io::MeshSink& sink, std::function<void()> stop);

  /// Returns where the mesh goes.  Its finish() throws mw::Error(kCheckFailed), naming what fails.
  [[nodiscard]] io::MeshSink& sink() { return sink_; }
  /// REQUIRES: the sink is finished.
  [[nodiscard]] const audit::AuditReport& report() const { return *report_; }

 private:
  void certify(const CertificatePlan& plan);

  const io::DenseVolume& volume_;
  std::filesystem::path folder_;
  std::function<void()> stop_;
  audit::KeptLabels kept_;
  MeshTiles tiles_;
  CertifiedSink sink_;
  std::optional<audit::AuditReport> report_;
};

}  // namespace mw::engine
