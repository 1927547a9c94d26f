// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The settings one by one: what each is called, what it may be, and its text.
#include "engine/settings/setting_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "engine/settings/number_text.h"
#include "engine/settings/size_text.h"
#include "io/file/errors.h"
#include "kernels/distance/distance_guard.h"

namespace mw::engine {
namespace {

using Settings = MeshSettings;
using Text = std::string;

constexpr int kMaxMarches = 4;
constexpr double kMaxQualityFloor = 0.5;
constexpr double kMaxInnerQuality = 0.8;
constexpr double kMaxDistance = 16.0;
constexpr int kMaxOdtIterations = 1000;
constexpr double kMaxGradation = 10.0;
constexpr std::int64_t kMaxCount = 1'000'000'000'000;
constexpr int kMaxAcross = 16;
constexpr const char* kNone = "none";
constexpr const char* kAuto = "auto";

/// The names of an enum's values.
template <class T, std::size_t N>
using Names = std::array<std::pair<const char*, T>, N>;

constexpr Names<Order, 2> kOrders{{{"raster", Order::kRaster}, {"colour", Order::kColour}}};
constexpr Names<KeptTopology, 2> kTopologies{
    {{"labels", KeptTopology::kLabels}, {"interfaces", KeptTopology::kInterfaces}}};
constexpr Names<Surface, 2> kSurfaces{{{"smooth", Surface::kSmooth}, {"voxel", Surface::kVoxel}}};
constexpr Names<Optimizer, 3> kOptimizers{
    {{"local", Optimizer::kLocal}, {"tetgen", Optimizer::kTetgen}, {kNone, Optimizer::kNone}}};
constexpr Names<StartMesh, 3> kStarts{
    {{"coarse", StartMesh::kCoarse}, {"octree", StartMesh::kOctree}, {"dense", StartMesh::kDense}}};

constexpr Names<PeriodicAxes, 8> kPeriodic{
    {{kNone, 0}, {"x", 1}, {"y", 2}, {"z", 4}, {"xy", 3}, {"xz", 5}, {"yz", 6}, {"xyz", 7}}};

template <class T, std::size_t N>
std::vector<Text> words(const Names<T, N>& names) {
  std::vector<Text> out;
  for (const auto& [name, value] : names) out.emplace_back(name);
  return out;
}

template <class T, std::size_t N>
Text name_of(const Names<T, N>& names, T value) {
  return std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.second == value; })
      ->first;
}

template <class T, std::size_t N>
T value_of(const Names<T, N>& names, const Text& text) {
  Text expected = "one of";
  for (const auto& [name, value] : names) {
    if (text == name) return value;
    expected += (name == names.front().first ? " " : ", ") + Text(name);
  }
  fail_expected(expected, text);
}

/// Parses an integer; one that no int holds becomes the nearest int, which no setting allows.
int parse_int(const Text& text) {
  using Limits = std::numeric_limits<int>;
  return static_cast<int>(
      std::clamp<std::int64_t>(parse_integer(text), Limits::min(), Limits::max()));
}

std::optional<double> parse_bound(const Text& text, const char* no_bound = kNone) {
  return text == no_bound ? std::nullopt : std::optional(parse_number(text));
}

Text bound_text(const std::optional<double>& bound, const char* no_bound = kNone) {
  return bound ? format_number(*bound) : no_bound;
}

Text range_text(double min, double max) {
  return "from " + format_number(min) + " to " + format_number(max);
}

/// Returns false if the value is not a number.
bool is_within(double value, double min, double max) {
  return value >= min && value <= max;
}

/// Returns whether sizes are positive, and ascending, so that each place has one.
bool are_sizes(const SizeRules& rules) {
  const auto is_size = [](double size) { return size > 0.0 && std::isfinite(size); };
  const auto has_size = [&](const auto& s) { return is_size(s.edge); };
  const auto by_label = [](const LabelSize& s) { return s.label; };
  const auto by_pair = [](const InterfaceSize& s) { return std::pair(s.low, s.high); };
  return is_size(rules.others.value_or(1.0)) && std::ranges::all_of(rules.labels, has_size) &&
         std::ranges::all_of(rules.interfaces, has_size) &&
         std::ranges::adjacent_find(rules.labels, std::ranges::greater_equal{}, by_label) ==
             rules.labels.end() &&
         std::ranges::adjacent_find(rules.interfaces, std::ranges::greater_equal{}, by_pair) ==
             rules.interfaces.end();
}

std::vector<Setting> march_settings() {
  return {
      {.name = "window",
       .value = "N",
       .help = "edge of windows in voxels of the lattice, even",
       .kind = ValueKind::kInteger,
       .expert = true,
       .allowed = "an even number from 4 to " + std::to_string(kMaxWindow),
       .text = [](const Settings& s) { return std::to_string(s.window); },
       .read = [](Settings& s, const Text& t) { s.window = parse_int(t); },
       .is_allowed =
           [](const Settings& s) {
             return is_within(s.window, 4, kMaxWindow) && s.window % 2 == 0;
           }},
      {.name = "marches",
       .value = "N",
       .help = "marches over the volume, each with windows twice as large",
       .kind = ValueKind::kInteger,
       .expert = true,
       .allowed = range_text(1, kMaxMarches),
       .text = [](const Settings& s) { return std::to_string(s.marches); },
       .read = [](Settings& s, const Text& t) { s.marches = parse_int(t); },
       .is_allowed = [](const Settings& s) { return is_within(s.marches, 1, kMaxMarches); }},
      {.name = "order",
       .help = "raster: the paper's, another mesh, narrow on small volumes",
       .choices = words(kOrders),
       .expert = true,
       .text = [](const Settings& s) { return name_of(kOrders, s.order); },
       .read = [](Settings& s, const Text& t) { s.order = value_of(kOrders, t); }},
      {.name = "start",
       .help = "labels coarsened; larger cells inside them; the paper's",
       .choices = words(kStarts),
       .expert = true,
       .text = [](const Settings& s) { return name_of(kStarts, s.start); },
       .read = [](Settings& s, const Text& t) { s.start = value_of(kStarts, t); }},
  };
}

std::vector<Setting> bound_settings() {
  return {
      {.name = "edge-variance",
       .value = "T|none",
       .help = "bound on the variance of edge lengths, Eq (3)",
       .kind = ValueKind::kNumberOrNone,
       .expert = true,
       .allowed = "positive, or none",
       .text = [](const Settings& s) { return bound_text(s.edge_variance); },
       .read = [](Settings& s, const Text& t) { s.edge_variance = parse_bound(t); },
       .is_allowed = [](const Settings& s) { return !s.edge_variance || *s.edge_variance > 0.0; }},
      {.name = "quality-floor",
       .value = "R",
       .help = "no tet below this radius ratio; 0: nothing is asked of shapes",
       .kind = ValueKind::kNumber,
       .expert = true,
       .allowed = range_text(0, kMaxQualityFloor),
       .text = [](const Settings& s) { return format_number(s.quality_floor); },
       .read = [](Settings& s, const Text& t) { s.quality_floor = parse_number(t); },
       .is_allowed =
           [](const Settings& s) { return is_within(s.quality_floor, 0, kMaxQualityFloor); }},
      {.name = "inner-quality",
       .value = "R|auto",
       .help = "the same for contractions inside labels; less is fewer tets",
       .kind = ValueKind::kNumberOrAuto,
       .expert = true,
       .allowed = range_text(0, kMaxInnerQuality) + ", or auto",
       .text = [](const Settings& s) { return bound_text(s.inner_quality, kAuto); },
       .read = [](Settings& s, const Text& t) { s.inner_quality = parse_bound(t, kAuto); },
       .is_allowed =
           [](const Settings& s) {
             return !s.inner_quality || is_within(*s.inner_quality, 0, kMaxInnerQuality);
           }},
      {.name = "max-distance",
       .value = "D|none",
       .help = "voxels at most between interfaces of input and mesh",
       .kind = ValueKind::kNumberOrNone,
       .allowed =
           range_text(0.71, kMaxDistance) + " voxels, or none (the samples are 0.71 voxels apart)",
       .text = [](const Settings& s) { return bound_text(s.max_distance); },
       .read = [](Settings& s, const Text& t) { s.max_distance = parse_bound(t); },
       .is_allowed =
           [](const Settings& s) {
             return !s.max_distance ||
                    is_within(*s.max_distance, DistanceGuard::min_distance(), kMaxDistance);
           }},
      {.name = "target-reduction",
       .value = "F|none",
       .help = "the paper's: a window stops at that share of voxel corners",
       .kind = ValueKind::kNumberOrNone,
       .expert = true,
       .allowed = "between 0 and 1, or none",
       .text = [](const Settings& s) { return bound_text(s.target_reduction); },
       .read = [](Settings& s, const Text& t) { s.target_reduction = parse_bound(t); },
       .is_allowed =
           [](const Settings& s) {
             return !s.target_reduction || (*s.target_reduction > 0.0 && *s.target_reduction < 1.0);
           }},
  };
}

std::vector<Setting> method_settings() {
  return {
      {.name = "topology",
       .help = "what is kept: topology of labels, or of interfaces, too",
       .choices = words(kTopologies),
       .expert = true,
       .text = [](const Settings& s) { return name_of(kTopologies, s.topology); },
       .read = [](Settings& s, const Text& t) { s.topology = value_of(kTopologies, t); }},
      {.name = "surface",
       .help = "smooth ones that keep volumes, or the paper's",
       .choices = words(kSurfaces),
       .expert = true,
       .text = [](const Settings& s) { return name_of(kSurfaces, s.surface); },
       .read = [](Settings& s, const Text& t) { s.surface = value_of(kSurfaces, t); }},
      {.name = "periodic",
       .value = "AXES",
       .help = "axes along which the volume repeats itself: x to xyz",
       .choices = words(kPeriodic),
       .expert = true,
       .text = [](const Settings& s) { return name_of(kPeriodic, s.periodic); },
       .read = [](Settings& s, const Text& t) { s.periodic = value_of(kPeriodic, t); }},
      {.name = "optimizer",
       .help = "what improves tets; tetgen: the paper's, at the end",
       .choices = words(kOptimizers),
       .expert = true,
       .text = [](const Settings& s) { return name_of(kOptimizers, s.optimizer); },
       .read = [](Settings& s, const Text& t) { s.optimizer = value_of(kOptimizers, t); }},
      {.name = "odt-iterations",
       .value = "N",
       .help = "iterations of --optimizer tetgen in a window, at most",
       .kind = ValueKind::kInteger,
       .expert = true,
       .allowed = range_text(1, kMaxOdtIterations),
       .text = [](const Settings& s) { return std::to_string(s.odt_iterations); },
       .read = [](Settings& s, const Text& t) { s.odt_iterations = parse_int(t); },
       .is_allowed =
           [](const Settings& s) { return is_within(s.odt_iterations, 1, kMaxOdtIterations); }},
  };
}

std::vector<Setting> size_settings() {
  return {
      {.name = "size",
       .value = "H|L=H,..|@FILE",
       .help = "edges of about H: all, or 2=3, 2|*=1 (faces), *=5vox; table, image",
       .kind = ValueKind::kNumberOrText,
       .has_labels = true,
       .allowed = "positive, given once for a label, and ascending",
       .text = [](const Settings& s) { return format_sizes(s.sizes.rules); },
       .read = [](Settings& s, const Text& t) { s.sizes.rules = parse_sizes(t); },
       .is_allowed = [](const Settings& s) { return are_sizes(s.sizes.rules); }},
      {.name = "gradation",
       .value = "G",
       .help = "around, sizes grow by G times the distance, 0 to 10",
       .kind = ValueKind::kNumber,
       .expert = true,
       .allowed = range_text(0, kMaxGradation),
       .text = [](const Settings& s) { return format_number(s.sizes.gradation); },
       .read = [](Settings& s, const Text& t) { s.sizes.gradation = parse_number(t); },
       .is_allowed =
           [](const Settings& s) { return is_within(s.sizes.gradation, 0, kMaxGradation); }},
      {.name = "inner-vertices",
       .help = "vertices in tets without one inside their label (see --size)",
       .kind = ValueKind::kSwitch,
       .expert = true,
       .text = [](const Settings& s) -> Text { return s.sizes.inner_vertices ? "true" : "false"; },
       .read = [](Settings& s, const Text& t) { s.sizes.inner_vertices = parse_switch(t); }},
      {.name = "count",
       .value = "N",
       .help = "about N tets: sizes are scaled, after a pilot; 0: any",
       .kind = ValueKind::kInteger,
       .allowed = "from 1 to " + std::to_string(kMaxCount) + ", or 0 for any",
       .text = [](const Settings& s) { return std::to_string(s.sizes.count); },
       .read = [](Settings& s, const Text& t) { s.sizes.count = parse_integer(t); },
       .is_allowed =
           [](const Settings& s) { return s.sizes.count >= 0 && s.sizes.count <= kMaxCount; }},
      {.name = "across",
       .value = "N",
       .help = "edges across thin parts, at least, if voxels allow; 0: any",
       .kind = ValueKind::kInteger,
       .expert = true,
       .allowed = range_text(1, kMaxAcross) + ", or 0 for any",
       .text = [](const Settings& s) { return std::to_string(s.sizes.across); },
       .read = [](Settings& s, const Text& t) { s.sizes.across = parse_int(t); },
       .is_allowed = [](const Settings& s) { return is_within(s.sizes.across, 0, kMaxAcross); }},
  };
}

}  // namespace

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all{
      {.name = "draft", .values = {{"surface", "voxel"}, {"max-distance", kNone}}},
      {.name = kDefaultPreset, .values = {}},
      {.name = "fine", .values = {{"size", "*|*=4.2vox"}, {"gradation", "1"}}}};
  return all;
}

const Preset* find_preset(const std::string& name) {
  for (const Preset& preset : presets()) {
    if (preset.name == name) return &preset;
  }
  return nullptr;
}

const std::vector<Setting>& setting_table() {
  static const std::vector<Setting> table = [] {
    std::vector<Setting> out;
    for (const auto& group :
         {march_settings(), bound_settings(), method_settings(), size_settings()}) {
      out.insert(out.end(), group.begin(), group.end());
    }
    return out;
  }();
  return table;
}

const std::vector<SettingRule>& setting_rules() {
  static const std::vector<SettingRule> rules{
      {.is_kept =
           [](const Settings& s) {
             const bool is_graded = s.sizes.limits_edges() || s.sizes.count > 0;
             return is_graded || s.sizes.gradation == SizeSettings{}.gradation;
           },
       .told = "--gradation: there is nothing to grade, give --size as well"},
      {.is_kept =
           [](const Settings& s) {
             const SizeSettings& sizes = s.sizes;
             const bool is_sized = sizes.limits_edges() || sizes.inner_vertices || sizes.count > 0;
             return !is_sized || s.optimizer != Optimizer::kTetgen;
           },
       .told = "--optimizer tetgen keeps no sizes or inner vertices: leave out --size, "
               "--count, --across and --inner-vertices, or set --optimizer local"}};
  return rules;
}

void check(const Setting& setting, const MeshSettings& settings) {
  if (setting.is_allowed == nullptr || setting.is_allowed(settings)) return;
  io::fail_usage(setting.name + " must be " + setting.allowed);
}

void set(const Setting& setting, MeshSettings& settings, const std::string& text) {
  setting.read(settings, text);
  check(setting, settings);
}

void check_threads(std::int64_t threads) {
  constexpr int kMax = 1024;
  if (threads >= 0 && threads <= kMax) return;
  io::fail_usage("threads must be " + range_text(1, kMax) + ", or 0 for all cores");
}

}  // namespace mw::engine
