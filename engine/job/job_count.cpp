// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/job_count.h"

#include <optional>

#include "engine/keep/keep_options.h"
#include "engine/settings/number_text.h"
#include "engine/store/journal/identity.h"
#include "engine/system/memory.h"
#include "engine/version.h"
#include "io/file/errors.h"

namespace mw::engine {
namespace {

constexpr const char* kCountScale = "count scale";
constexpr const char* kMayBeOff = "count may be off";
constexpr const char* kEarlierScale = "count missed with scale";
constexpr const char* kEarlierTets = "count missed with tets";

/// Returns the scale that the run found whose work this one goes on with, if there is such a run.
std::optional<report::CountFacts> saved_count(const MeshJob& job, report::FinishedRun run) {
  if (!job.run.store.resume) return std::nullopt;
  const std::filesystem::path& folder = job.run.store.workdir;
  const auto read = [&](const char* name, auto& number) {
    const std::optional<std::string> text = saved_value(folder, name);
    return text && read_number(*text, number);
  };
  report::CountFacts count{.asked = static_cast<std::uint64_t>(job.settings.sizes.count),
                           .may_be_off = saved_value(folder, kMayBeOff) == "yes"};
  if (!read(kCountScale, count.scale) || !(count.scale > 0)) return std::nullopt;
  const bool has_missed =
      read(kEarlierScale, count.earlier_scale) && read(kEarlierTets, count.earlier_tets);
  if (!has_missed) count.earlier_tets = 0;
  run.count = count;
  const std::string identity =
      identity_of(run) + identity_text(run.volume, with_scale(job.settings, count.scale));
  if (!is_identity_of(job.run.store.workdir, identity)) return std::nullopt;
  return run.count;
}

/// Returns how many of the labels that are written have no size, which the scale does not reach.
std::uint64_t labels_without_size(const MeshJob& job, const io::LabelTable& table) {
  const SizeRules& rules = job.settings.sizes.rules;
  if (!rules.any() || !rules.image.empty()) return 0;
  const LabelSelection kept(wanted_labels(job.choice, table), table);
  std::uint64_t out = 0;
  for (Label label = 0; label < table.size(); ++label) {
    out += kept.keeps(label) && !rules.of_label(table.raw(label)) ? 1U : 0U;
  }
  return out;
}

}  // namespace

std::string identity_of(const report::FinishedRun& run) {
  std::string out = io::text("version = ", version(), "\nresults = ", results_id(),
                             "\nlabel fingerprint = ", run.fingerprint, "\n");
  if (!run.count) return out;
  const report::CountFacts& count = *run.count;
  out += io::text(kCountScale, " = ", count.scale, "\n", kMayBeOff, " = ",
                  count.may_be_off ? "yes" : "no", "\n");
  if (count.earlier_tets > 0) {
    out += io::text(kEarlierScale, " = ", count.earlier_scale, "\n", kEarlierTets, " = ",
                    count.earlier_tets, "\n");
  }
  return out;
}

report::CountFacts count_facts(const PilotTask& task, const report::FinishedRun& run) {
  const ResourceMeter meter;
  const std::optional<report::CountFacts> saved = saved_count(task.job, run);
  report::CountFacts out = saved ? *saved : scale_for_count(task);
  if (!saved) out.seconds = meter.read().wall_seconds;
  out.labels_without_size = labels_without_size(task.job, run.labels);
  return out;
}

}  // namespace mw::engine
