// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The options of `mwmesh mesh`.
#include "engine/cli/mesh_request.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "engine/cli/machine_memory.h"
#include "engine/cli/mesh_paths.h"
#include "engine/cli/values.h"
#include "engine/codt/worker_pool.h"
#include "io/mesh/open_mesh.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

constexpr const char* kNone = "none";
constexpr int kMaxThreads = 1024;
constexpr const char* kLabelsKept = "labels";
constexpr const char* kInterfacesKept = "interfaces";

std::optional<double> parse_bound(const std::string& text) {
  if (text == kNone) return std::nullopt;
  const double bound = parse_number(text);
  if (bound > 0) return bound;
  throw Error(ErrorKind::kUsage, "must be positive, or none");
}

std::string bound_text(const std::optional<double>& bound) {
  return bound ? format_number(*bound) : kNone;
}

int parse_count(const std::string& text) {
  const std::int64_t count = parse_integer(text);
  if (count > 0 && count <= std::numeric_limits<int>::max()) return static_cast<int>(count);
  throw Error(ErrorKind::kUsage, "out of range");
}

constexpr std::array<std::pair<const char*, engine::StartMesh>, 3> kStartMeshes{
    {{"coarse", engine::StartMesh::kCoarse},
     {"octree", engine::StartMesh::kOctree},
     {"dense", engine::StartMesh::kDense}}};

constexpr std::array<std::pair<const char*, engine::Optimizer>, 3> kOptimizers{
    {{"local", engine::Optimizer::kLocal},
     {"tetgen", engine::Optimizer::kTetgen},
     {kNone, engine::Optimizer::kNone}}};

constexpr std::array<std::pair<const char*, engine::Surface>, 2> kSurfaces{
    {{"smooth", engine::Surface::kSmooth}, {"voxel", engine::Surface::kVoxel}}};

/// REQUIRES: one of the names.
template <typename Names>
auto parse_name(const Names& names, const std::string& text) {
  return std::find_if(names.begin(), names.end(), [&](const auto& n) { return text == n.first; })
      ->second;
}

template <typename Names, typename Value>
std::string text_of(const Names& names, Value value) {
  return std::find_if(names.begin(), names.end(), [&](const auto& n) { return value == n.second; })
      ->first;
}

void add_output_option(OptionSet& options, MeshRequest& request) {
  options.add({.name = "output",
               .value = "OUTPUT",
               .help = "mesh to write: " + io::mesh_extensions(),
               .flags = "-o,--output",
               .assign = [&](const std::string& text) { request.output = text; }});
  options.add({.name = "element",
               .value = "ELEMENT",
               .help = "nodes of a tet in OUTPUT: tet4; tet10, with the middles of its edges",
               .fallback = "tet4",
               .choices = {"tet4", "tet10"},
               .assign = [&](const std::string& text) { request.element = parse_element(text); }});
}

/// Options of the engine; each is checked as soon as it is set, so that errors name its place.
void add_setting(OptionSet& options, MeshRequest& request, Option option,
                 std::function<void(engine::MeshSettings&, const std::string&)> set) {
  option.assign = [&request, set = std::move(set)](const std::string& text) {
    set(request.settings, text);
    engine::check(request.settings);
  };
  options.add(std::move(option));
}

void add_march_options(OptionSet& options, MeshRequest& request) {
  add_setting(options, request,
              {.name = "window",
               .value = "N",
               .help = "window edge in voxels of the lattice (see --surface), even",
               .kind = ValueKind::kInteger,
               .fallback = std::to_string(engine::MeshSettings{}.window)},
              [](engine::MeshSettings& s, const std::string& t) { s.window = parse_count(t); });
  add_setting(options, request,
              {.name = "marches",
               .value = "N",
               .help = "marches over the volume, each with windows twice as large",
               .kind = ValueKind::kInteger,
               .fallback = std::to_string(engine::MeshSettings{}.marches)},
              [](engine::MeshSettings& s, const std::string& t) { s.marches = parse_count(t); });
}

void add_bound_options(OptionSet& options, MeshRequest& request) {
  const engine::MeshSettings defaults;
  add_setting(
      options, request,
      {.name = "edge-variance",
       .value = "T|none",
       .help = "bound on the variance of edge lengths, Eq (3)",
       .kind = ValueKind::kNumberOrNone,
       .fallback = bound_text(defaults.edge_variance)},
      [](engine::MeshSettings& s, const std::string& t) { s.edge_variance = parse_bound(t); });
  add_setting(
      options, request,
      {.name = "quality-floor",
       .value = "R",
       .help = "no tet below this radius ratio, refused where spacing does not allow it; 0: no "
               "demand on shapes, as in the paper",
       .kind = ValueKind::kNumber,
       .fallback = format_number(defaults.quality_floor)},
      [](engine::MeshSettings& s, const std::string& t) { s.quality_floor = parse_number(t); });
  add_setting(
      options, request,
      {.name = "max-distance",
       .value = "D|none",
       .help = "bound in voxels of the lattice, two-sided, between input and output interfaces",
       .kind = ValueKind::kNumberOrNone,
       .fallback = bound_text(defaults.max_distance)},
      [](engine::MeshSettings& s, const std::string& t) { s.max_distance = parse_bound(t); });
}

void add_method_options(OptionSet& options, MeshRequest& request) {
  const engine::MeshSettings defaults;
  add_setting(
      options, request,
      {.name = "target-reduction",
       .value = "F|none",
       .help = "each window stops collapsing at this fraction of the lattice's voxel corners",
       .kind = ValueKind::kNumberOrNone,
       .fallback = bound_text(defaults.target_reduction)},
      [](engine::MeshSettings& s, const std::string& t) { s.target_reduction = parse_bound(t); });
  add_setting(options, request,
              {.name = "topology",
               .help = "what is kept: labels, or interfaces as well",
               .fallback = kLabelsKept,
               .choices = {kLabelsKept, kInterfacesKept}},
              [](engine::MeshSettings& s, const std::string& t) {
                s.topology =
                    t == kInterfacesKept ? KeptTopology::kInterfaces : KeptTopology::kLabels;
              });
  add_setting(
      options, request,
      {.name = "surface",
       .help =
           "what interfaces are: smooth, with the labels' volumes kept, on a lattice where slices "
           "much thicker than the smallest spacing are cut into layers; voxel, as the paper's "
           "quadrics leave them, on the voxels as they are",
       .fallback = text_of(kSurfaces, defaults.surface),
       .choices = {"smooth", "voxel"}},
      [](engine::MeshSettings& s, const std::string& t) { s.surface = parse_name(kSurfaces, t); });
  add_setting(options, request,
              {.name = "optimizer",
               .help = "what improves tets after collapse: local, none, or tetgen (local, and "
                       "the paper's constrained ODT in the last march)",
               .fallback = text_of(kOptimizers, defaults.optimizer),
               .choices = {"local", "tetgen", kNone}},
              [](engine::MeshSettings& s, const std::string& t) {
                s.optimizer = parse_name(kOptimizers, t);
              });
  add_setting(
      options, request,
      {.name = "odt-iterations",
       .value = "N",
       .help = "iterations of --optimizer tetgen in a window, at most",
       .kind = ValueKind::kInteger,
       .fallback = std::to_string(defaults.odt_iterations)},
      [](engine::MeshSettings& s, const std::string& t) { s.odt_iterations = parse_count(t); });
  add_setting(
      options, request,
      {.name = "start",
       .help = "start mesh: coarse (labels coarsened first, larger cells inside them), octree "
               "(larger cells only), dense (the paper's)",
       .fallback = text_of(kStartMeshes, defaults.start),
       .choices = {"coarse", "octree", "dense"}},
      [](engine::MeshSettings& s, const std::string& t) { s.start = parse_name(kStartMeshes, t); });
}

std::chrono::milliseconds parse_delay(const std::string& text) {
  constexpr double kMostSeconds = 1e6;
  const double seconds = parse_number(text);
  if (seconds < 0 || seconds > kMostSeconds) {
    throw Error(ErrorKind::kUsage, "expected seconds from 0 to 1000000");
  }
  return std::chrono::milliseconds(static_cast<std::int64_t>(1000 * seconds));
}

int parse_threads(const std::string& text) {
  const std::int64_t threads = parse_integer(text);
  if (threads >= 0 && threads <= kMaxThreads) return static_cast<int>(threads);
  throw Error(ErrorKind::kUsage,
              "must be from 1 to " + std::to_string(kMaxThreads) + ", or 0 for all cores");
}

void add_resource_options(OptionSet& options, MeshRequest& request) {
  options.add({.name = "threads",
               .value = "N",
               .help = "worker threads; 0: all cores",
               .kind = ValueKind::kInteger,
               .fallback = "0",
               .assign = [&](const std::string& text) { request.threads = parse_threads(text); }});
  options.add({.name = "memory",
               .value = "SIZE",
               .help =
                   "hard budget for the process, e.g. 512M, 1.5G or 4GiB; K M G T, also with iB, "
                   "are powers of "
                   "1024, KB MB GB TB of 1000, in any case [half of the memory that is available]",
               .kind = ValueKind::kSize,
               .assign = [&](const std::string& text) {
                 if (!text.empty()) request.memory = parse_size(text);
               }});
  options.add({.name = "workdir",
               .value = "DIR",
               .help = "folder of the block store and journal, removed after success [OUTPUT.work]",
               .assign = [&](const std::string& text) { request.workdir = text; }});
  options.add({.name = "resume",
               .help = "go on from the work that a run left when it was killed or interrupted",
               .kind = ValueKind::kSwitch,
               .fallback = "false",
               .assign = [&](const std::string& text) { request.resume = parse_switch(text); }});
  options.add({.name = "save-every",
               .value = "SECONDS",
               .help = "how often finished work becomes durable; a kill loses at most so much",
               .kind = ValueKind::kNumber,
               .fallback = "10",
               .assign = [&](const std::string& text) { request.save_every = parse_delay(text); }});
  add_setting(options, request,
              {.name = "order",
               .help = "march order: raster, the paper's; colour, far wider on small volumes",
               .fallback = "raster",
               .choices = {"raster", "colour"}},
              [](engine::MeshSettings& s, const std::string& t) {
                s.order = t == "colour" ? engine::Order::kColour : engine::Order::kRaster;
              });
}

void add_output_options(OptionSet& options, MeshRequest& request) {
  options.add({.name = "ascii",
               .help = "a .msh as text instead of binary",
               .kind = ValueKind::kSwitch,
               .fallback = "false",
               .assign = [&](const std::string& text) { request.ascii = parse_switch(text); }});
  options.add({.name = "report",
               .value = "FILE.json",
               .help = "writes a report of the run, read back from the finished mesh",
               .assign = [&](const std::string& text) { request.report = text; }});
  options.add({.name = "html",
               .value = "REPORT.html",
               .help = "writes one page to look at: figures, charts, pictures, surfaces to turn",
               .assign = [&](const std::string& text) { request.html = text; }});
  options.add({.name = "trace",
               .value = "FILE.csv",
               .help = "writes when each window was worked on, and by which thread",
               .assign = [&](const std::string& text) { request.trace = text; }});
  options.add(
      {.name = "progress",
       .help = "auto (a bar on a terminal), none, jsonl (lines on stderr, with the seconds left)",
       .fallback = "auto",
       .choices = {"auto", "none", "jsonl"},
       .assign = [&](const std::string& text) { request.progress = parse_progress(text); }});
  options.add({.name = "log-level",
               .help = "debug, info, warn, error, off",
               .fallback = "warn",
               .choices = {"debug", "info", "warn", "error", "off"},
               .assign = [&](const std::string& text) { request.log_level = text; }});
}

/// What a chunked volume may keep of its file while labels are read: nothing else needs much then.
std::uint64_t cache_bytes(std::uint64_t memory) {
  constexpr std::uint64_t kMost = 1ULL << 30U;
  return std::min(memory / 4, kMost);
}

/// The page is drawn when the mesh is written, in what it leaves of the budget.
void require_memory_for_page(const MeshRequest& request) {
  constexpr std::uint64_t kLeast = 192 << 20;
  if (request.html.empty() || *request.memory >= kLeast) return;
  throw Error(ErrorKind::kUsage, "--html: needs --memory 192MiB or more");
}

void settle_sizes(MeshRequest& request) {
  engine::MeshSettings& settings = request.settings;
  settings.sizes = size_settings(request.sizes);
  engine::check(settings);
  const bool sized = !settings.sizes.labels.empty() || settings.sizes.inner_vertices;
  if (!sized || settings.optimizer != engine::Optimizer::kTetgen) return;
  throw Error(ErrorKind::kUsage,
              "--optimizer tetgen keeps no sizes or inner vertices: leave out --size and "
              "--inner-vertices, or set --optimizer local");
}

}  // namespace

void add_mesh_options(OptionSet& options, MeshRequest& request) {
  add_input_option(options, request.volume.path);
  add_output_option(options, request);
  add_volume_options(options, request.volume);
  add_march_options(options, request);
  add_bound_options(options, request);
  add_method_options(options, request);
  add_size_options(options, request.sizes);
  add_resource_options(options, request);
  add_choice_options(options, request.choice);
  add_output_options(options, request);
}

void check_mesh_request(MeshRequest& request) {
  require_path(request.output, "-o OUTPUT");
  if (request.workdir.empty()) request.workdir = request.output.string() + ".work";
  if (!request.memory) request.memory = default_memory_budget();
  request.volume.cache_bytes = cache_bytes(*request.memory);
  (void)open_options(request.volume);
  check_choice(request.choice);
  require_paths_apart(request);
  require_memory_for_page(request);
  settle_sizes(request);
  if (request.settings.optimizer == engine::Optimizer::kTetgen) (void)engine::codt::find_worker();
}

}  // namespace mw::cli
