// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A verification with what the run promised.
#include "engine/job/certificate.h"

#include <algorithm>
#include <limits>

#include "engine/job/verify_job.h"
#include "engine/march/march.h"
#include "engine/report/figures.h"
#include "engine/report/mesh_facts.h"
#include "engine/settings/promises.h"
#include "engine/verify/verify_mesh.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

// Memory for buffers and lists, and on each thread for a tile with what is around it.
constexpr std::uint64_t kShared = std::uint64_t{48} << 20U;
constexpr std::uint64_t kPerThread = std::uint64_t{40} << 20U;

std::uint64_t certificate_bytes(int threads, int readers, std::uint64_t reader_bytes) {
  const auto n = static_cast<std::uint64_t>(threads);
  const std::uint64_t reading =
      readers > 1 ? static_cast<std::uint64_t>(readers) * reader_bytes : 0;
  return kShared + n * (kPerThread + reading);
}

/// Returns the plan with most threads, and with all of their readers, that takes no more than
/// `memory` bytes; with one thread there may be fewer readers.  It is the least there is where even
/// that takes more.
CertificatePlan largest_plan(int threads, std::uint64_t reader_bytes, std::uint64_t memory) {
  const auto fits = [&](int n, int readers) {
    return certificate_bytes(n, readers, reader_bytes) <= memory;
  };
  constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();
  int readers = readers_of_thread(threads, reader_bytes, kAll);
  while (threads > 1 && !fits(threads, readers)) {
    readers = readers_of_thread(--threads, reader_bytes, kAll);
  }
  while (readers > 1 && !fits(threads, readers)) --readers;
  return {.why_not = {},
          .threads = threads,
          .readers = readers,
          .reader_bytes = reader_bytes,
          .memory_bytes = certificate_bytes(threads, readers, reader_bytes)};
}

/// Returns "P2 faces: 3 triangles ..., P3 ...".
std::string failures(const audit::AuditReport& report) {
  std::string out;
  for (const audit::Check& check : report.checks) {
    if (!check.passed) out += (out.empty() ? "" : "; ") + check.name + ": " + check.detail;
  }
  return out;
}

std::string obstacle(const MeshJob& job) {
  if (job.certify == Certify::kAuto && job.run.processes != nullptr &&
      job.run.processes->count() > 1) {
    return "of several processes one alone would make it, while the others wait: give --certify "
           "on, "
           "or verify the file";
  }
  if (job.certify == Certify::kAuto && job.run.keep.use == KeepUse::kUpdate) {
    return io::text(
        "the mesh is, byte for byte, that of a run that begins afresh",
        job.run.keep.changed.empty() ? "" : ", if nothing outside of --changed has changed",
        ": give --certify on, or verify the file");
  }
  if (job.run.store.memory / 4 < kShared + kPerThread) {
    return "needs --memory " + io::mebibytes(4 * (kShared + kPerThread)) + " or more";
  }
  return "";
}

}  // namespace

CertificatePlan plan_certificate(const MeshJob& job, std::uint64_t reader_bytes) {
  if (job.certify == Certify::kOff) return {.why_not = "not asked for"};
  const std::string why_not = obstacle(job);
  if (!why_not.empty() && job.certify == Certify::kOn) {
    io::fail_usage("--certify on: " + why_not);
  }
  if (!why_not.empty()) return {.why_not = why_not};
  return largest_plan(thread_count(job.run.threads), reader_bytes, job.run.store.memory / 4);
}

CertificatePlan beside_others(const CertificatePlan& plan, const MeshJob& job,
                              std::uint64_t others) {
  if (!plan.why_not.empty()) return plan;
  const std::uint64_t memory = job.run.store.memory;
  const std::uint64_t least = kShared + kPerThread;
  const std::uint64_t room = memory - std::min(others, memory);
  if (job.certify == Certify::kOn || others + least <= memory) {
    return plan.memory_bytes <= room ? plan : largest_plan(plan.threads, plan.reader_bytes, room);
  }
  return {.why_not = "needs --memory " + io::mebibytes(others + least) + " or more here"};
}

Certifier::Certifier(const CertificatePlan& plan, const MeshJob& job, const io::DenseVolume& volume,
                     io::MeshSink& sink, std::function<void()> stop)
    : volume_(volume),
      folder_(job.folder.empty() ? "." : job.folder),
      stop_(std::move(stop)),
      kept_(kept_labels(job.choice, volume.table())),
      tiles_(volume.info(), volume.table(), {folder_, kShared / 4}),
      sink_(sink, tiles_, plan.memory_bytes, [this, plan] { certify(plan); }) {}

void Certifier::certify(const CertificatePlan& plan) {
  const io::MeshPromises promises = tiles_.header().record.promises.value();
  VerifyTask task{.options = audit_options(promises, volume_.info().space),
                  .threads = plan.threads,
                  .readers = plan.readers,
                  .memory_bytes = kShared / 2,
                  .folder = folder_,
                  .between = stop_};
  const bool has_scores = volume_.raw().scores() != nullptr;
  if (has_scores || !why_no_volumes(promises).empty()) task.options.max_volume_error.reset();
  task.options.kept = kept_;
  task.options.label_text = report::label_texts(volume_.table(), volume_.info().names);
  task.options.count_junctions = task.options.count_junctions && kept_.empty();
  report_ = verify_mesh(volume_, tiles_, task);
  if (report_->passed()) return;
  throw Error(ErrorKind::kCheckFailed,
              "the mesh does not pass its own check and is not delivered (please report this, with "
              "the volume and the settings): " +
                  failures(*report_));
}

}  // namespace mw::engine
