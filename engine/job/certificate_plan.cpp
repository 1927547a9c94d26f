// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/certificate_plan.h"

#include <algorithm>
#include <limits>

#include "engine/job/verify_job.h"
#include "engine/report/figures.h"
#include "engine/report/mesh_facts.h"
#include "engine/settings/promises.h"
#include "engine/system/crew.h"
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

std::string obstacle(const MeshJob& job) {
  if (job.certify == Certify::kAuto && !is_alone(job.run.processes)) {
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

CertificateTask certificate_task(const CertificatePlan& plan, const MeshJob& job,
                                 const io::DenseVolume& volume, const io::MeshPromises& promises) {
  CertificateTask out{.volume = volume,
                      .check = {.options = audit_options(promises, volume.info()),
                                .threads = plan.threads,
                                .readers = plan.readers,
                                .memory_bytes = kShared / 2,
                                .folder = job.folder.empty() ? "." : job.folder,
                                .between = job.stop},
                      .tiles_bytes = kShared / 4,
                      .memory_bytes = plan.memory_bytes};
  audit::AuditOptions& options = out.check.options;
  const bool has_scores = volume.raw().scores() != nullptr;
  if (has_scores || !why_no_volumes(promises).empty()) options.max_volume_error.reset();
  options.kept = kept_labels(job.choice, volume.table());
  options.measure_distance = job.is_measured;
  options.label_text = report::label_texts(volume.table(), volume.info().names);
  options.count_junctions = options.count_junctions && options.kept.empty();
  return out;
}

}  // namespace mw::engine
