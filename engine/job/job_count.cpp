// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/job_count.h"

#include <optional>

#include "engine/keep/keep_options.h"
#include "engine/run/processes.h"
#include "engine/settings/number_text.h"
#include "engine/store/journal/identity.h"
#include "engine/store/journal/run_folder.h"
#include "engine/system/memory.h"
#include "engine/version.h"
#include "io/file/errors.h"

namespace mw::engine {
namespace {

constexpr const char* kCountScale = "count scale";
constexpr const char* kMayBeOff = "count may be off";
constexpr const char* kEarlierScale = "count missed with scale";
constexpr const char* kEarlierTets = "count missed with tets";

/// Returns what the run found whose work the folder has, as far as the folder says it.
std::optional<report::CountFacts> saved_count(const MeshJob& job) {
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
  return count;
}

/// Returns the scale that the run found whose work this one goes on with, if there is such a run.
/// ERRORS: mw::Error(kUsage) where the work folder has other work, before the pilot makes a mesh;
/// of several processes each has a folder of its own, at which it looks later.
std::optional<report::CountFacts> found_count(const MeshJob& job, report::FinishedRun run) {
  const StoreOptions& store = job.run.store;
  run.count = store.resume ? saved_count(job) : std::nullopt;
  const MeshSettings& settings = job.settings;
  const std::string identity =
      identity_of(run) +
      identity_text(run.volume, run.count ? with_scale(settings, run.count->scale) : settings);
  if (run.count && is_identity_of(store.workdir, identity)) return run.count;
  if (is_alone(job.run.processes) && !store.workdir.empty()) {
    const Workdir is_free_or_refused(store.workdir, store.resume, identity);
  }
  return std::nullopt;
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
  const std::optional<report::CountFacts> found = found_count(task.job, run);
  report::CountFacts out = found ? *found : scale_for_count(task);
  if (!found) out.seconds = meter.read().wall_seconds;
  out.labels_without_size = labels_without_size(task.job, run.labels);
  return out;
}

}  // namespace mw::engine
