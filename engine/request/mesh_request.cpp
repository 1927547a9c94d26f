// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The options of a job that meshes a volume.
#include "engine/request/mesh_request.h"

#include <algorithm>

#include "engine/codt/worker_pool.h"
#include "engine/request/finish_options.h"
#include "engine/request/shared_options.h"
#include "engine/request/values.h"
#include "engine/settings/size_text.h"
#include "engine/settings/together.h"
#include "engine/system/memory.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/labels/merged_volume.h"
#include "io/mesh/open_mesh.h"
#include "io/volume/cropped_volume.h"
#include "io/volume/open_volume.h"

namespace mw::request {
namespace {

std::chrono::milliseconds parse_delay(const std::string& text) {
  constexpr double kMaxSeconds = 1e6;
  const double seconds = parse_number(text);
  if (seconds < 0 || seconds > kMaxSeconds) {
    io::fail_usage("expected seconds from 0 to 1000000");
  }
  return std::chrono::milliseconds(static_cast<std::int64_t>(1000 * seconds));
}

Certify parse_certify(const std::string& text) {
  if (text == "auto") return Certify::kAuto;
  return text == "on" ? Certify::kOn : Certify::kOff;
}

/// The older name of --size @FILE, which may be given beside --size.
void add_size_file_option(OptionSet& options, MeshRequest& request) {
  options.add(
      {.name = "size-file", .listed = Listed::kNowhere, .assign = [&](const std::string& text) {
         engine::SizeRules& rules = request.job.settings.sizes.rules;
         const std::string before = engine::format_sizes(rules);
         rules = engine::parse_sizes((before.empty() ? "@" : before + ",@") + text);
         request.size_tables.push_back(text);
       }});
}

/// Parses "X0,Y0,Z0,X1,Y1,Z1;...".
std::vector<Box3> parse_boxes(const std::string& text) {
  std::vector<Box3> out;
  for (const std::string_view box : io::split_at(';', text)) out.push_back(parse_box(box));
  return out;
}

void add_keep_options(OptionSet& options, MeshRequest& request) {
  options.add({.name = "keep",
               .value = "FOLDER",
               .help = "keeps what --from needs after an edit",
               .group = kRunGroup,
               .assign = into(request.keep)});
  options.add({.name = "from",
               .value = "FOLDER",
               .help = "only windows that an edit reaches, to the same mesh; updates FOLDER",
               .group = kRunGroup,
               .assign = into(request.from)});
  options.add({.name = "changed",
               .value = "X0,Y0,Z0,X1,Y1,Z1",
               .help = "with --from: box changed since the last mesh, repeatable [anywhere]",
               .group = kRunGroup,
               .listed = Listed::kInHelpAll,
               .repeats = true,
               .assign = into(request.job.run.keep.changed, parse_boxes)});
  options.add({.name = "keep-bytes",
               .value = "SIZE",
               .help = "most that FOLDER takes when a run ends, as 512MiB, 4GB [any number]",
               .group = kRunGroup,
               .kind = ValueKind::kSize,
               .listed = Listed::kInHelpAll,
               .assign = into(request.job.run.keep.bytes, parse_bytes)});
  options.add({.name = "delta",
               .value = "FILE.json",
               .help = "with --from: writes what the edit did to labels, contacts and mesh",
               .group = kRunGroup,
               .face = Face::kProgram,
               .listed = Listed::kInHelpAll,
               .assign = into(request.delta)});
}

/// Adds options that say how a run can be watched.
void add_watch_options(OptionSet& options, MeshRequest& request) {
  options.add({.name = "progress",
               .help = "auto: a bar on a terminal; jsonl: lines on stderr",
               .group = kRunGroup,
               .fallback = "auto",
               .choices = {"auto", "none", "jsonl"},
               .face = Face::kProgram,
               .listed = Listed::kInHelpAll,
               .assign = into(request.progress)});
  options.add({.name = "log-level",
               .value = "LEVEL",
               .help = "debug, info, warn, error or off",
               .group = kRunGroup,
               .fallback = "warn",
               .choices = {"debug", "info", "warn", "error", "off"},
               .face = Face::kProgram,
               .listed = Listed::kInHelpAll,
               .assign = into(request.log_level)});
  options.add({.name = "trace",
               .value = "FILE.csv",
               .help = "writes when each window was worked on, and by which thread",
               .group = kRunGroup,
               .face = Face::kProgram,
               .listed = Listed::kInHelpAll,
               .assign = into(request.trace)});
}

void add_run_options(OptionSet& options, MeshRequest& request) {
  add_resource_options(options, request.job.run.threads, request.memory, "bound for the process");
  options.add(switch_of(request.job.run.store.resume,
                        {.name = "resume",
                         .help = "go on from the work of a run that was killed or interrupted",
                         .group = kRunGroup}));
  add_keep_options(options, request);
  options.add({.name = "workdir",
               .value = "DIR",
               .help = "work that memory does not hold, removed after success [OUTPUT.work]",
               .group = kRunGroup,
               .listed = Listed::kInHelpAll,
               .assign = into(request.job.run.store.workdir)});
  options.add({.name = "save-every",
               .value = "SECONDS",
               .help = "finished work is durable after that; a kill loses the rest",
               .group = kRunGroup,
               .kind = ValueKind::kNumber,
               .fallback = "10",
               .listed = Listed::kInHelpAll,
               .assign = into(request.job.run.store.group.age, parse_delay)});
  add_watch_options(options, request);
  options.add({.name = "config",
               .value = "FILE.toml",
               .help = "a key for each option, '-' as '_'; MW_NAME and flags are stronger",
               .group = kRunGroup,
               .face = Face::kProgram,
               .listed = Listed::kInHelpAll,
               .only_flag = true,
               .assign = into(request.config)});
  options.add({.name = "print-config",
               .help = "prints the effective config and exits",
               .group = kRunGroup,
               .kind = ValueKind::kSwitch,
               .face = Face::kProgram,
               .listed = Listed::kInHelpAll,
               .only_flag = true});
}

/// Adds options about what is told of a run.
void add_report_options(OptionSet& options, MeshRequest& request) {
  options.add({.name = "report",
               .value = "FILE.json",
               .help = "writes figures of the run and of the finished mesh",
               .group = kOutputGroup,
               .face = Face::kProgram,
               .assign = into(request.report)});
  options.add({.name = "html",
               .value = "FILE.html",
               .help = "writes a page to look at: figures, charts, surfaces to turn",
               .group = kOutputGroup,
               .face = Face::kProgram,
               .assign = into(request.html)});
  options.add(switch_of(request.is_measured, {.name = "measure",
                                              .help = "measures quality and shape, for a report",
                                              .group = kOutputGroup,
                                              .fallback = "true",
                                              .face = Face::kLibrary}));
}

void add_output_options(OptionSet& options, MeshRequest& request) {
  options.add({.name = "output",
               .value = "OUTPUT",
               .help = "mesh to write; its extension says the format",
               .group = kOutputGroup,
               .flags = "-o,--output",
               .face = Face::kProgram,
               .required = true,
               .assign = into(request.output)});
  options.add({.name = "element",
               .value = "NAME",
               .help = "tet4; tet10: also nodes on edges; tet10-curved: on curves",
               .group = kOutputGroup,
               .fallback = "tet4",
               .choices = {"tet4", "tet10", "tet10-curved"},
               .calls = kWriting,
               .assign = into(request.element, parse_element)});
  add_connect_options(options, request.job.connect);
  add_report_options(options, request);
  options.add(switch_of(request.write_values, {.name = "write-values",
                                               .help = "writes the values of tets into a file",
                                               .group = kOutputGroup,
                                               .fallback = "true",
                                               .face = Face::kLibrary,
                                               .calls = kWriting}));
  options.add({.name = "certify",
               .help = "checks P1 to P4 and P8, or exit code 5; auto: where cheap",
               .group = kOutputGroup,
               .fallback = "auto",
               .choices = {"auto", "on", "off"},
               .listed = Listed::kInHelpAll,
               .assign = into(request.job.certify, parse_certify)});
  add_sample_option(options, request.job.samples);
  add_format_options(options, request.extras, Listed::kInHelpAll);
  options.add(switch_of(request.force,
                        {.name = "force",
                         .help = "replaces files that are not of this program; meshes images",
                         .group = kOutputGroup,
                         .listed = Listed::kInHelpAll}));
}

void require_room_for_values(const MeshRequest& request) {
  if (request.extras.materials) {
    const auto is_it = [&](const engine::SampleImage& sample) {
      return sample.name == request.extras.materials->values;
    };
    if (std::any_of(request.job.samples.begin(), request.job.samples.end(), is_it)) return;
    io::fail_usage("--materials: no --sample is called '" + request.extras.materials->values + "'");
  }
  if (!request.job.samples.empty() && request.write_values) {
    io::require_place_for_values(request.output);
  }
}

void require_room_for_wedges(const MeshRequest& request) {
  if (!request.job.connect.cohesive.any()) return;
  io::require_place_for_wedges(request.output, request.element);
}

void check_request_together(const MeshRequest& request) {
  constexpr unsigned kAllAxes = 7;
  const engine::KeepOptions& keep = request.job.run.keep;
  const io::Deck deck = request.extras.deck;
  engine::check_together(
      {.update = !request.from.empty(),
       .changed = !keep.changed.empty(),
       .delta = !request.delta.empty(),
       .periodic = request.job.settings.periodic != 0,
       .whole_cell = request.job.settings.periodic == kAllAxes,
       .object = !request.volume.open.object.empty(),
       .curves = request.element == io::Element::kCurvedTet10,
       .doubles = request.job.connect.double_vertices(),
       .pairs = !request.extras.pairs.empty(),
       .cell_job = deck == io::Deck::kPeriodic || deck == io::Deck::kConduction});
}

/// Settles what is done with the folder: --from updates what an earlier run left there, --resume
/// goes on with what a killed run left, and without either the folder is begun.
void settle_keep(MeshRequest& request) {
  engine::KeepOptions& keep = request.job.run.keep;
  const bool updates = !request.from.empty();
  if (updates && !request.keep.empty() && request.keep != request.from) {
    io::fail_usage("--keep: --from updates the folder that it names, give one of the two");
  }
  request.job.delta = request.delta.empty() ? engine::Delta::kNo : engine::Delta::kOn;
  keep.folder = updates ? request.from : request.keep;
  keep.use = updates                        ? engine::KeepUse::kUpdate
             : request.job.run.store.resume ? engine::KeepUse::kGoOn
                                            : engine::KeepUse::kBegin;
}

/// Fills in what follows from other values.
void settle_job(MeshRequest& request) {
  engine::MeshJob& job = request.job;
  engine::StoreOptions& store = job.run.store;
  store.memory = request.memory ? *request.memory : engine::default_memory_budget();
  request.volume.open.cache_bytes = cache_bytes(store.memory);
  job.steps = request.volume.steps;
  job.ends_around_object = !request.volume.open.object.empty();
  const bool has_choice = job.choice.labels || job.choice.background;
  if (job.ends_around_object && !has_choice) {
    job.choice.labels = io::merged_labels(request.volume.open.object, job.steps.merge);
    job.choice.labels_option = "--object";
  }
  job.takes_images = request.force;
  job.is_curved = request.element == io::Element::kCurvedTet10;
}

/// Opens an image beside the labels, by the form that --use-form chooses where it has that.
std::unique_ptr<io::LabelVolume> open_image(const std::filesystem::path& file, io::FormChoice form,
                                            io::OpenOptions options) {
  options.form = form;
  try {
    return io::open_volume(file, options);
  } catch (const Error& error) {
    if (form == io::FormChoice::kFile || error.kind() != ErrorKind::kUsage) throw;
  }
  options.form = io::FormChoice::kFile;
  return io::open_volume(file, options);
}

/// Returns null if there is no image of sizes.
std::unique_ptr<io::LabelVolume> open_sizes(const MeshRequest& request) {
  const std::string& image = request.job.settings.sizes.rules.image;
  if (image.empty()) return nullptr;
  const io::OpenOptions labels = open_options(request.volume);
  return open_image(image, labels.form, {.spacing = labels.spacing, .origin = labels.origin});
}

/// Opens the images that tets get values from.
void open_samples(const MeshRequest& request, std::vector<engine::SampleImage>& samples) {
  for (engine::SampleImage& sample : samples) {
    sample.image = open_image(sample.file, request.volume.open.form,
                              {.dataset = sample.dataset,
                               .trust_paths = request.volume.open.trust_paths,
                               .cache_bytes = request.volume.open.cache_bytes / samples.size()});
    if (sample.image->info().is_placed && request.volume.open.frame == io::FrameChoice::kVoxel) {
      io::fail_usage("--frame voxel: " + sample.file +
                     " lies in the world, which the mesh then is not in");
    }
  }
}

}  // namespace

void add_mesh_options(OptionSet& options, MeshRequest& request) {
  add_input_option(options, request.volume.path);
  add_volume_options(options, request.volume);
  add_choice_options(options, request.job.choice);
  add_step_options(options, request.volume);
  add_setting_options(options, request.job.settings);
  add_size_file_option(options, request);
  add_run_options(options, request);
  add_output_options(options, request);
}

void settle_mesh_request(MeshRequest& request) {
  settle_job(request);
  settle_keep(request);
  check_request_together(request);
  (void)open_options(request.volume);
  engine::check_choice(request.job.choice);
}

void check_mesh_request(const MeshRequest& request) {
  if (!request.output.empty()) {
    require_room_for_values(request);
    require_room_for_wedges(request);
  }
  engine::check(request.job.settings);
  if (request.job.settings.optimizer == engine::Optimizer::kTetgen)
    (void)engine::codt::find_worker();
}

void settle_changed(MeshRequest& request, const io::VolumeInfo& volume) {
  const Index3 first = io::first_number(volume);
  const Box3 all{first, first + volume.shape};
  for (Box3& box : request.job.run.keep.changed) {
    if (!request.volume.open.crop && !is_empty(box) && is_empty(intersection(box, all))) {
      io::fail_usage("--changed: the box ", io::box_text(box),
                     " is outside of the volume, which has the voxels ", io::box_text(all));
    }
    box = {box.lo - first, box.hi - first};
  }
}

void open_images(const MeshRequest& request, engine::MeshJob& job) {
  job.size_image = open_sizes(request);
  open_samples(request, job.samples);
}

}  // namespace mw::request
