// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh mesh: a labelled volume to a mesh.
#include <iostream>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/log.h"
#include "engine/cli/mesh/mesh_paths.h"
#include "engine/cli/mesh/mesh_warnings.h"
#include "engine/cli/mesh/progress.h"
#include "engine/cli/mesh/run_processes.h"
#include "engine/cli/page/run_page.h"
#include "engine/cli/requests.h"
#include "engine/report/run_report.h"
#include "engine/report/summary.h"
#include "engine/settings/promises.h"
#include "engine/settings/setting_table.h"
#include "engine/settings/size_text.h"
#include "engine/store/journal/run_folder.h"
#include "engine/system/crew.h"
#include "engine/system/memory.h"
#include "io/file/errors.h"
#include "io/mesh/digest.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/open_mesh.h"
#include "io/remote/wait_stop.h"
#include "io/volume/cropped_volume.h"
#include "io/volume/open_volume.h"

namespace mw::cli {
namespace {

/// Returns the memory that the digest may sort in, a small part of the budget.
std::size_t digest_memory(std::uint64_t budget) {
  constexpr std::uint64_t kMin = 1 << 18;
  return std::clamp<std::uint64_t>(budget / 64, kMin, io::DigestSink::kMemoryBytes);
}

/// Returns null where this process leaves the mesh to another one.
std::unique_ptr<io::MeshSink> open_sink(const MeshRequest& request) {
  if (!run_processes().speaks()) return nullptr;
  io::MeshExtras extras = request.extras;
  extras.wedges = request.job.connect.cohesive.any();
  return io::open_mesh_sink(request.output, request.element, extras);
}

/// The files of a run, created before any work so that a bad path fails at once.
struct MeshFiles {
  explicit MeshFiles(const MeshRequest& request) : sink(open_sink(request)) {
    if (!request.trace.empty()) trace.emplace(request.trace);
    if (!request.html.empty()) html.emplace(request.html);
    if (!request.report.empty()) report.emplace(request.report);
    if (!request.delta.empty()) delta.emplace(request.delta);
    if (sink == nullptr || !request.job.is_measured) return;
    digest.emplace(request.output.parent_path(), digest_memory(request.job.run.store.memory));
    if (html) grouped.emplace(request.output.parent_path(), nullptr);
  }

  /// Returns where the mesh goes; the file with its name comes last.
  [[nodiscard]] std::vector<io::MeshSink*> all() {
    std::vector<io::MeshSink*> out;
    if (digest) out.push_back(&*digest);
    if (grouped) out.push_back(&*grouped);
    if (sink != nullptr) out.push_back(sink.get());
    return out;
  }

  std::unique_ptr<io::MeshSink> sink;  ///< null where the process that speaks has it
  std::optional<io::AtomicFile> report;
  std::optional<io::AtomicFile> html;
  std::optional<io::AtomicFile> delta;
  std::optional<io::DigestSink> digest;    ///< for report and page; it waits beside the output
  std::optional<io::GroupedSink> grouped;  ///< for the page; it waits there, too
  std::optional<TraceFile> trace;
};

/// Returns what is there when a run ends while it finds out what changed, and how to go on.
std::string way_to_delta(const MeshRequest& request) {
  const std::string folder = request.job.run.keep.folder.string();
  return io::text(request.output.string(), " is complete, ", request.delta.string(),
                  " is not written; mesh again with --from ", folder, " and --delta, for which ",
                  folder, " still has the labels before");
}

/// Meshes the volume, and says where the work is when a run that ends early leaves some.
report::FinishedRun mesh_into(const MeshRequest& request, const io::LabelVolume& volume,
                              MeshFiles& files) {
  Progress progress(parse_progress(request.progress));
  std::string work;
  engine::MeshJob job = request.job;
  job.stop = stop_if_interrupted;
  if (!run_processes().speaks()) job.samples.clear();
  open_images(request, job);
  job.warn = log_warning;
  job.labels_known = [](std::size_t labels) { log_info(io::text("meshing ", labels, " labels")); };
  engine::RunHooks& run = job.run;
  run.keep.say = [](const std::string& line) { log_warning(line); };
  run.stop_after_save = is_save_requested;
  run.progress = [&](const engine::RunProgress& at) { progress.show(at); };
  if (files.trace) run.trace = [&](const engine::TraceEvent& e) { files.trace->add(e); };
  run.store.kept = [&] { work = engine::way_on(run); };
  bool is_delivered = false;
  job.delivered = [&] {
    is_delivered = job.delta == engine::Delta::kOn;
    if (is_delivered) work = way_to_delta(request);
  };
  job.tell = [&](const io::Json& delta) {
    files.delta.value().append(delta.dump_indented() + "\n");
    files.delta->commit();
    is_delivered = false;
  };
  try {
    return engine::mesh(volume, job, files.all());
  } catch (const Error& error) {
    // Where labels, or what was kept of them, cannot be read, the same command fails again.
    if (!is_delivered || error.kind() == ErrorKind::kInput) throw;
    throw Error(error.kind(), error.what() + ("; " + work));
  } catch (const Interrupted&) {
    throw Interrupted{work};
  } catch (const engine::StoppedAfterSave&) {
    throw Interrupted{work};
  }
}

/// Logs who did what, also where no report is written.
void log_processes(const engine::RunReport& run) {
  for (std::size_t rank = 0; rank < run.processes.size(); ++rank) {
    const engine::ProcessFacts& facts = run.processes[rank];
    const auto output = static_cast<std::size_t>(engine::Purpose::kOutput);
    log_info(io::text("rank ", rank, ": ", facts.windows, " windows, ", facts.blocks_sent,
                      " blocks sent, at most ", format_bytes(facts.peak_accounted_bytes),
                      " accounted, ", format_bytes(facts.peak_bytes_by_purpose[output]),
                      " to write"));
  }
}

void tell_resume(const MeshRequest& request, const engine::StoreFacts& facts) {
  if (!request.job.run.store.resume || !request.job.run.keep.folder.empty()) return;
  if (facts.resumed_windows == 0) {
    log_warning(io::text(request.job.run.store.workdir.string(),
                         ": no saved work to resume, started from the beginning"));
  } else {
    log_info(io::text(facts.resumed_windows, " windows were done before"));
  }
}

void tell_keep(const engine::KeepFacts& keep) {
  std::uint64_t visited = 0, skipped = 0;
  for (const engine::KeepFacts::March& march : keep.marches) {
    visited += march.visited;
    skipped += march.skipped;
  }
  std::cout << "windows     " << visited << " visited, " << skipped << " as they were\n";
}

/// Returns how many of the threads asked for the system gives, and warns when they are fewer.
int threads_at_hand(int asked) {
  engine::save_address_space();
  const int wanted = engine::thread_count(asked);
  const int given = engine::Crew(wanted).size();
  if (given < wanted) {
    log_warning(io::text("the system gives ", given, " of ", wanted,
                         " threads; the mesh is the same, later. Raise the limit of processes "
                         "(ulimit -u) or of address space (ulimit -v), or give --threads ",
                         given));
  }
  return given;
}

/// Writes what follows once the mesh is complete; each file adds its name to `complete`.
void write_side_files(const MeshRequest& request, report::FinishedRun& run, MeshFiles& files,
                      const OptionSet& options, std::vector<std::string>& complete) {
  if (files.trace) {
    files.trace->finish();
    complete.push_back(request.trace.string());
  }
  if (files.digest) {
    engine::return_free_memory_above(0);  // the blocks are gone; the digest sorts in their place
    const engine::ResourceMeter meter;
    run.digest = files.digest->digest();
    run.resources.peak_rss_bytes = meter.read().peak_rss_bytes;
  }
  if (files.report) {
    report::write_run_report(*files.report, run, request.output, options.json());
    complete.push_back(request.report.string());
  }
  if (!files.html) return;
  write_run_page(*files.html, run, files.grouped->mesh(),
                 report::run_report(run, request.output, options.json()));
  std::cout << "page        " << request.html.string() << std::endl;
}

/// Writes the other files.  An error about one says, too, which are there, and how to get the rest.
void deliver_rest(const MeshRequest& request, report::FinishedRun& run, MeshFiles& files,
                  const OptionSet& options) {
  std::vector<std::string> complete{request.output.string()};
  if (files.delta) complete.push_back(request.delta.string());
  try {
    write_side_files(request, run, files, options, complete);
  } catch (const Error& error) {
    const std::string there = joined(complete, ", ") + (complete.size() == 1 ? " is" : " are");
    const std::string way_out =
        run.engine.work != nullptr ? "; add --resume to write the rest without meshing again" : "";
    throw Error(error.kind(), error.what() + ("; " + there + " complete") + way_out);
  }
  if (run.engine.work != nullptr) run.engine.work->discard();
}

/// Says what the user should know of how the volume is read.
void tell_volume(const MeshRequest& request, const io::VolumeInfo& volume) {
  if (volume.is_far && !request.volume.open.cache) {
    log_warning(
        "chunks that memory no longer holds are fetched anew in each pass over the volume, two or "
        "three times in all; with --cache DIR each is fetched once, for later runs, too");
  }
  if (!run_processes().speaks()) return;
  if (!request.volume.open.crop || volume.offset == Index3{}) return;
  std::cout << "crop        " << io::box_text(*request.volume.open.crop)
            << " as the data set counts voxels, "
            << io::box_text({volume.first, volume.first + volume.shape}) << " in its array"
            << std::endl;
}

/// Names what a preset sets, without what something stronger has set otherwise.
void tell_preset(const OptionSet& options) {
  const engine::Preset* const preset = engine::find_preset(options.text("preset"));
  if (preset == nullptr || preset->values.empty() || !run_processes().speaks()) return;
  std::string set;
  for (const auto& [name, value] : preset->values) {
    if (options.text(name) == value) set += " --" + name + " " + value;
  }
  std::cout << "preset      " << preset->name << " sets"
            << (set.empty() ? " nothing that is not set otherwise" : set) << std::endl;
}

/// Returns what the user gave that has the effect of a flag, such as "--preset draft" for
/// "--surface voxel"; the flag itself where nothing implies it.
std::string giver_of(const std::string& flag, const OptionSet& options) {
  for (const OptionSet::Entry& entry : options.entries()) {
    const Option& option = entry.option;
    const bool is_implied = !entry.is_given && entry.where != option.name;
    if (is_implied && "--" + option.name + " " + entry.text == flag) return entry.where;
  }
  return flag;
}

/// What words of the summary mean.
constexpr const char* kWords =
    "Summary: the radius ratio of a regular tetrahedron is 1, of a flat one 0; a part is what "
    "faces\n"
    "join; ras, lps: axes to right or left, to front or back, up.  README.md has P1 to P8.\n";

/// Says how the mesh becomes a job where its format has jobs and none was asked.
void tell_deck(const MeshRequest& request) {
  if (request.extras.deck != io::Deck::kNone || !io::takes_static_deck(request.output)) return;
  std::cout << "note        " << request.output.string()
            << " is a mesh alone: --deck static makes it a job that runs, with placeholders for "
               "materials, supports and a load\n";
}

int mesh(MeshRequest& request, const OptionSet& options) {
  watch_interrupts();
  const io::WaitStop::Stop stop = stop_if_interrupted;
  const io::WaitStop waits(&stop);
  if (runs_are_divided()) watch_save_requests();
  // A certificate that cannot be made is refused before any file is opened.
  static_cast<void>(engine::plan_certificate(request.job));
  const std::string why = engine::why_no_volumes(engine::promises_of(request.job.settings));
  if (!why.empty()) {
    log_warning(giver_of(why, options) + ": the volumes of labels are not promised (P8)");
  }
  tell_preset(options);
  const engine::ResourceMeter meter;
  MeshFiles files(request);
  log_info("reading " + request.volume.path.string());
  const std::unique_ptr<io::LabelVolume> volume = open(request.volume, log_warning);
  tell_volume(request, volume->info());
  settle_changed(request, volume->info());
  if (volume->scores() != nullptr) {
    log_warning(std::string(engine::kVolumesOfScores) + "; volumes are not promised (P8)");
  }
  report::FinishedRun run = mesh_into(request, *volume, files);
  if (!run_processes().speaks()) return kExitDone;
  tell_resume(request, run.engine.store);
  if (run.engine.keep) tell_keep(*run.engine.keep);
  run.resources = meter.read();
  const io::Json facts = report::run_report(run, request.output, {});
  std::cout << report::summary_text(facts) << std::flush;
  log_processes(run.engine);
  deliver_rest(request, run, files, options);
  print_warnings(run);
  tell_deck(request);
  std::cout << report::attention_text(facts);
  if (!std::cout.flush()) {
    throw Error(ErrorKind::kResource, "cannot write the summary to standard output; " +
                                          request.output.string() +
                                          " is complete, and so is every other file of the run");
  }
  return kExitDone;
}

/// Throws for --workdir as a flag where nothing is written there.  A variable or a config file may
/// name the folder for whatever runs need one.
void refuse_idle_workdir(const MeshRequest& request, const OptionSet& options) {
  if (!options.is_flag("workdir") || (request.keep.empty() && request.from.empty())) return;
  io::fail_usage("--workdir: is not used beside ", request.from.empty() ? "--keep" : "--from",
                 ", whose folder has all that memory does not hold; leave it out");
}

int run_mesh(MeshRequest& request, const OptionSet& options) {
  refuse_idle_workdir(request, options);
  refuse_idle_cache(options, request.volume);
  for (std::string& file : engine::size_tables(options.text("size"))) {
    request.size_tables.push_back(std::move(file));
  }
  settle(request);
  start_log(run_processes().speaks() ? request.log_level : "off");
  take_part(request);
  int& threads = request.job.run.threads;
  threads = threads_at_hand(threads);
  return mesh(request, options);
}

}  // namespace

Command mesh_command() {
  const auto request = std::make_shared<MeshRequest>();
  Command command{
      .name = "mesh",
      .about = "meshes a labelled volume",
      .options = {},
      .run = [request](const OptionSet& options) { return run_mesh(*request, options); },
      .note = volume_note() + "OUTPUT: " + io::mesh_extensions() + ".\n" + kWords,
      .names = [request] { return names_of(request->volume); }};
  add_mesh_options(command.options, *request);
  return command;
}

}  // namespace mw::cli
