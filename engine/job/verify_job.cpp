// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From volume and mesh to a verdict.
#include "engine/job/verify_job.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "engine/labels/label_scan.h"
#include "engine/labels/reading_tiles.h"
#include "engine/report/mesh_facts.h"
#include "engine/settings/promises.h"
#include "engine/system/crew.h"
#include "engine/verify/verify_mesh.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/labels/label_table.h"
#include "io/mesh/grouped/plain_names.h"
#include "io/mesh/merged_vertices.h"
#include "io/remote/wait_stop.h"
#include "io/volume/volume_readers.h"
#include "kernels/core/lattice.h"

namespace mw::engine {
namespace {

/// The labels that a mesh is to hold and, in words, what is left out by what its file says.
struct ChosenLabels {
  audit::KeptLabels labels;
  std::string told;
};

audit::KeptLabels empty_if_all(audit::KeptLabels kept) {
  const bool leaves_out = std::find(kept.begin(), kept.end(), false) != kept.end();
  return leaves_out ? std::move(kept) : audit::KeptLabels{};
}

/// Returns "2, 3, 4 and 95 more".
std::string list_of(const std::vector<RawLabel>& labels, bool is_signed) {
  constexpr std::size_t kMostNamed = 8;
  std::string out;
  for (std::size_t i = 0; i < std::min(labels.size(), kMostNamed); ++i) {
    out += (i == 0 ? "" : ", ") + io::label_text(labels[i], is_signed);
  }
  if (labels.size() <= kMostNamed) return out;
  return out + " and " + std::to_string(labels.size() - kMostNamed) + " more";
}

/// Returns the labels that the run has not left out, by its record.
ChosenLabels recorded_labels(const io::MeshRecord& record, const io::LabelTable& table) {
  const bool are_left_out = record.only_labels.empty();
  const auto& named = are_left_out ? record.without_labels : record.only_labels;
  if (named.empty()) return {};
  const io::LabelTable found(named, table.is_signed());
  audit::KeptLabels kept;
  for (Label l = 0; l < table.size(); ++l) {
    kept.push_back(found.contains(table.raw(l)) != are_left_out);
  }
  return {empty_if_all(std::move(kept)),
          (are_left_out ? "without label " : "only label ") + list_of(named, table.is_signed())};
}

/// Returns the labels in the mesh, since a file that tells of no run is to hold just these.
ChosenLabels found_labels(const audit::KeptLabels& in_mesh, const io::LabelTable& table) {
  std::vector<RawLabel> missing;
  for (Label l = 0; l < table.size(); ++l) {
    if (!in_mesh[l]) missing.push_back(table.raw(l));
  }
  if (missing.empty()) return {};
  return {in_mesh, "without label " + list_of(missing, table.is_signed()) +
                       ", which the file does not have"};
}

ChosenLabels kept_labels(const LabelChoice& choice, const io::MeshRecord& record,
                         const MeshTiles& mesh, const io::LabelTable& table) {
  if (choice.labels || choice.background) return {kept_labels(choice, table), ""};
  if (record.promises) return recorded_labels(record, table);
  return found_labels(mesh.labels(), table);
}

void add_words(std::string& text, const std::string& words) {
  text += (text.empty() ? "" : ", ") + words;
}

/// Returns which of the kept labels are there in part, and drops those that are gone from `kept`.
audit::KeptLabels leave_parts_out(const io::MeshRecord& record, const audit::KeptLabels& in_mesh,
                                  const io::LabelTable& table, ChosenLabels& kept) {
  if (record.partial_labels.empty()) return {};
  const io::LabelTable named(record.partial_labels, table.is_signed());
  audit::KeptLabels partial(table.size());
  if (kept.labels.empty()) kept.labels.assign(table.size(), true);
  for (Label l = 0; l < table.size(); ++l) {
    if (!kept.labels[l] || !named.contains(table.raw(l))) continue;
    partial[l] = in_mesh[l];
    kept.labels[l] = in_mesh[l];
  }
  add_words(kept.told,
            "without parts of label " + list_of(record.partial_labels, table.is_signed()));
  return partial;
}

void tell_doubles(const io::MeshRecord& record, std::uint64_t merged, ChosenLabels& kept) {
  if (!record.has_doubles) return;
  add_words(kept.told, std::to_string(merged) + " doubled vertices are merged by position here");
}

/// Returns whether a file has a name as it is, or as the formats of Gmsh spell it: without quotes
/// or in plain letters, and with the label behind it where another label has the same name.
bool is_name_in_file(std::string_view found, std::string name, const std::string& label) {
  if (found == name) return true;
  const std::string plain = io::plain_name(name);
  if (!plain.empty() && (found == plain || found == plain + "_" + label)) return true;
  std::replace(name.begin(), name.end(), '"', '\'');
  const std::string behind = " (" + label + ")";
  while (found.size() > name.size() && found.ends_with(behind)) {
    found.remove_suffix(behind.size());
  }
  return found == name;
}

/// Returns the check "names": labels that the mesh names have these names in the volume.  Nothing
/// where one of them has none.
std::optional<audit::Check> names_check(const MeshTiles& mesh, const io::LabelTable& table,
                                        const io::LabelNames& wanted) {
  audit::Offenders others("labels under another name");
  std::uint64_t named = 0;
  bool is_known = false;
  for (Label l = 0; l < table.size(); ++l) {
    const std::string label = io::label_text(table.raw(l), table.is_signed());
    const std::string &name = wanted.name(table.raw(l)),
                      &found = mesh.header().names.name(table.raw(l));
    is_known = is_known || !name.empty();
    if (!mesh.labels()[l] || found.empty()) continue;
    ++named;
    if (is_name_in_file(found, name, label)) continue;
    others.add([&] {
      return label + " is \"" + found + "\", " + (name.empty() ? "nothing" : "\"" + name + "\"") +
             " in the volume";
    });
  }
  if (!is_known || named == 0) return std::nullopt;
  std::string detail = std::to_string(named) + " labels with a name; " + others.text();
  if (others.count() > 0) detail += "; give verify the --names of the run";
  return audit::Check{"names", others.count() == 0, detail};
}

report::Bounds bounds_of(const AskedBounds& asked, const io::MeshRecord& record,
                         const ChosenLabels& kept) {
  report::Bounds out{.promises = record.promises.value_or(report::kOtherPromises),
                     .of_run = record.promises.has_value()};
  io::MeshPromises& bounds = out.promises;
  if (out.of_run) check_promises(bounds);
  if (asked.interfaces.value_or(false) && !kept.labels.empty()) {
    io::fail_usage("--topology interfaces: is for meshes of all labels, and this one is " +
                   (kept.told.empty() ? "of some" : kept.told));
  }
  if (asked.max_distance) bounds.max_distance = *asked.max_distance;
  bounds.quality_floor = asked.quality_floor.value_or(floor_of(bounds));
  bounds.halvings = 0;
  bounds.interfaces = asked.interfaces.value_or(bounds.interfaces && kept.labels.empty());
  if (!out.of_run) {
    out.told = kept.told;
    return out;
  }
  // A bound that was asked for is no promise that the file weakens.
  io::MeshPromises recorded = bounds;
  const io::MeshPromises usual = promises_of({});
  if (asked.max_distance) recorded.max_distance = usual.max_distance;
  if (asked.quality_floor) recorded.quality_floor = usual.quality_floor;
  out.told = less_than_default(recorded);
  const auto add = [&out](const std::string& words) {
    out.told += (out.told.empty() || words.empty() ? "" : ", ") + words;
  };
  const bool has_volumes = why_no_volumes(*record.promises).empty();
  if (!has_volumes && !asked.max_volume_error) add("no volumes");
  add(kept.told);
  return out;
}

}  // namespace

report::Verdict verify(const VerifyJob& job, const std::function<void(io::MeshSink&)>& deliver) {
  const io::WaitStop waits(&job.between);
  io::check_unpacking(job.volume, {.memory = job.memory, .shares = 2});
  const io::SpeckLimits limits = io::SpeckLimits::of_budget(job.memory);
  SharedReads shared(job.volume, job.memory - limits.memory);
  const io::PreparedInput input(shared, job.steps, limits);
  shared.end();
  const io::LabelVolume& volume = input.volume();
  const io::VolumeInfo& info = volume.info();
  report::Verdict verdict{
      .specks = input.specks(),
      .slices = input.slices(),
      .welds = input.welds(),
      .table = collect_labels(volume, scanner_count(volume, job.threads, job.memory)),
      .names = info.names};
  MeshTiles mesh(info, verdict.table, {job.folder, job.memory / 8});
  io::MergedVertices merged(mesh, job.folder, job.between);
  deliver(merged);
  const io::MeshRecord& record = mesh.header().record;
  ChosenLabels kept = kept_labels(job.choice, record, mesh, verdict.table);
  const audit::KeptLabels partial = leave_parts_out(record, mesh.labels(), verdict.table, kept);
  tell_doubles(record, merged.merged(), kept);
  verdict.bounds = bounds_of(job.asked, record, kept);
  const int threads = thread_count(job.threads);
  VerifyTask task{.options = audit_options(verdict.bounds.promises, info),
                  .threads = threads,
                  .readers = readers_of_thread(threads, reader_bytes(volume), job.memory / 8),
                  .memory_bytes = job.memory / 2,
                  .folder = job.folder,
                  .between = job.between};
  const bool has_scores = volume.scores() != nullptr;
  if (has_scores || (record.promises && !why_no_volumes(*record.promises).empty())) {
    task.options.max_volume_error.reset();
  }
  if (has_scores && !job.asked.max_volume_error) {
    add_words(verdict.bounds.told, "volumes are those of the values, not of voxels");
  }
  if (job.asked.max_volume_error) task.options.max_volume_error = *job.asked.max_volume_error;
  verdict.bounds.max_volume_error = task.options.max_volume_error;
  task.options.halvings.reset();
  if (record.promises) task.options.halvings = record.promises->halvings;
  task.options.kept = kept.labels;
  task.options.partial = partial;
  task.options.label_text = report::label_texts(verdict.table, verdict.names);
  verdict.layers = task.options.layers;
  verdict.audit = verify_mesh(io::DenseVolume(volume, verdict.table), mesh, task);
  const auto names = names_check(mesh, verdict.table, verdict.names);
  if (names) verdict.audit.checks.push_back(*names);
  return verdict;
}

audit::KeptLabels kept_labels(const LabelChoice& choice, const io::LabelTable& table) {
  const engine::WantedLabel wanted = wanted_labels(choice, table);
  audit::KeptLabels kept;
  for (Label label = 0; wanted && label < table.size(); ++label) {
    kept.push_back(wanted(table.raw(label)));
  }
  return empty_if_all(std::move(kept));
}

audit::AuditOptions audit_options(const io::MeshPromises& promises, const io::VolumeInfo& volume) {
  audit::AuditOptions options;
  options.radius_ratio_floor = floor_of(promises);
  options.count_junctions = promises.interfaces;
  options.max_distance = promises.max_distance;
  options.periodic = promises.periodic;
  options.halvings = promises.halvings;
  options.layers = layers_of(volume.space.spacing, volume.shape, promises.periodic);
  return options;
}

}  // namespace mw::engine
