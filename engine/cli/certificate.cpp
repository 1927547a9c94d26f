// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A verification with what the run promised.
#include "engine/cli/certificate.h"

#include "engine/cli/interrupt.h"
#include "engine/cli/values.h"
#include "engine/cli/verdict.h"
#include "engine/march/march.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

// Buffers and lists; a tile with what is around it, on each thread.
constexpr std::uint64_t kShared = std::uint64_t{48} << 20U;
constexpr std::uint64_t kPerThread = std::uint64_t{40} << 20U;

/// "P2 faces: 3 triangles ..., P3 ...".
std::string failures(const audit::AuditReport& report) {
  std::string out;
  for (const audit::Check& check : report.checks) {
    if (!check.passed) out += (out.empty() ? "" : "; ") + check.name + ": " + check.detail;
  }
  return out;
}

std::string obstacle(const MeshRequest& request) {
  if (*request.memory / 4 < kShared + kPerThread) {
    return "needs --memory " + format_bytes(4 * (kShared + kPerThread)) + " or more";
  }
  return "";
}

}  // namespace

CertificatePlan plan_certificate(const MeshRequest& request) {
  if (request.certify == Certify::kOff) return {.why_not = "not asked for"};
  const std::string why_not = obstacle(request);
  if (!why_not.empty() && request.certify == Certify::kOn) {
    throw Error(ErrorKind::kUsage, "--certify on: " + why_not);
  }
  if (!why_not.empty()) return {.why_not = why_not};
  const std::uint64_t most = (*request.memory / 4 - kShared) / kPerThread;
  const auto threads = std::min<std::uint64_t>(
      most, static_cast<std::uint64_t>(engine::thread_count(request.threads)));
  return {.threads = static_cast<int>(threads), .memory_bytes = kShared + threads * kPerThread};
}

Certifier::Certifier(const CertificatePlan& plan, const MeshRequest& request,
                     const io::DenseVolume& volume, io::MeshSink& sink)
    : volume_(volume),
      folder_(request.output.parent_path().empty() ? "." : request.output.parent_path()),
      kept_(kept_labels(request.choice, volume.table())),
      tiles_(volume.info(), volume.table(), {folder_, kShared / 4}),
      sink_(sink, tiles_, plan.memory_bytes, [this, plan] { certify(plan); }) {}

void Certifier::certify(const CertificatePlan& plan) {
  const io::MeshPromises promises = tiles_.header().record.promises.value();
  engine::VerifyTask task{.options = audit_options(promises, volume_.info().space),
                          .threads = plan.threads,
                          .memory_bytes = kShared / 2,
                          .folder = folder_,
                          .between = [] { stop_if_interrupted(); }};
  task.options.max_volume_error.reset();
  task.options.kept = kept_;
  task.options.count_places = task.options.count_places && kept_.empty();
  report_ = engine::verify_mesh(volume_, tiles_, task);
  if (report_->passed()) return;
  throw Error(ErrorKind::kCheckFailed,
              "the mesh does not pass its own check and is not delivered (please report this, with "
              "the volume and the settings): " +
                  failures(*report_));
}

}  // namespace mw::cli
