// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The settings one by one: what each is called, what it may be, and its text.
#include "engine/settings/setting_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "engine/settings/number_text.h"
#include "engine/settings/size_text.h"
#include "io/file/errors.h"
#include "kernels/distance/distance_guard.h"

namespace mw::engine {
namespace {

using Settings = MeshSettings;
using Text = std::string;

constexpr double kAboveZero = std::numeric_limits<double>::denorm_min();
constexpr double kBelowOne = 1 - std::numeric_limits<double>::epsilon() / 2;
constexpr double kMaxDistance = 16;
constexpr double kMaxCount = 1e12;
constexpr double kMaxAcross = 16;
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

Text range_text(double min, double max) {
  return "from " + format_number(min) + " to " + format_number(max);
}

// A field of the settings, or of the sizes among them.

template <class S, class T>
auto& at(S& settings, T Settings::*field) {
  return settings.*field;
}
template <class S, class T>
auto& at(S& settings, T SizeSettings::*field) {
  return settings.sizes.*field;
}

// Numbers to text and back; `word` stands for none.

Text text_of(std::integral auto value, const char* /*word*/) {
  return std::to_string(value);
}
Text text_of(const std::optional<double>& value, const char* word) {
  return value ? format_number(*value) : word;
}

/// An integer that T does not hold becomes the nearest that it holds, which no setting allows.
template <std::integral T>
void read_into(T& value, const Text& text, const char* /*word*/) {
  using Limits = std::numeric_limits<T>;
  value =
      static_cast<T>(std::clamp<std::int64_t>(parse_integer(text), Limits::min(), Limits::max()));
}
void read_into(double& value, const Text& text, const char* /*word*/) {
  value = parse_number(text);
}
void read_into(std::optional<double>& value, const Text& text, const char* word) {
  value = text == word ? std::nullopt : std::optional(parse_number(text));
}

/// Returns false if the value is not a number.
bool is_within(const Setting& row, const std::optional<double>& value) {
  return !value || (*value >= row.least && *value <= row.most);
}
bool is_within(const Setting& row, std::integral auto value) {
  return is_within(row, std::optional(static_cast<double>(value))) && value % row.step == 0;
}

// What completes a row: its functions, and what follows from the type of its field.

template <class T, class Group>
Setting number(T Group::*field, Setting row) {
  constexpr bool kMayLack = !std::is_arithmetic_v<T>;
  if (row.kind == ValueKind::kText) {
    row.kind = std::is_integral_v<T> ? ValueKind::kInteger
               : kMayLack            ? ValueKind::kNumberOrNone
                                     : ValueKind::kNumber;
  }
  const char* const word = row.kind == ValueKind::kNumberOrAuto ? kAuto : kNone;
  if (row.allowed.empty()) {
    row.allowed = range_text(row.least, row.most) + (kMayLack ? Text(", or ") + word : "");
  }
  row.text = [=](const Settings& s) { return text_of(at(s, field), word); };
  row.read = [=](Settings& s, const Text& t) { read_into(at(s, field), t, word); };
  row.is_allowed = [=](const Settings& s) { return is_within(row, at(s, field)); };
  return row;
}

template <class T, std::size_t N>
Setting choice(T Settings::*field, const Names<T, N>& names, Setting row) {
  Text expected = "one of";
  for (const auto& [name, value] : names) {
    row.choices.emplace_back(name);
    expected += (row.choices.size() == 1 ? " " : ", ") + row.choices.back();
  }
  row.text = [field, &names](const Settings& s) -> Text {
    return std::ranges::find(names, s.*field, [](const auto& n) { return n.second; })->first;
  };
  row.read = [field, &names, expected](Settings& s, const Text& t) {
    const auto found = std::ranges::find(names, t, [](const auto& n) { return Text(n.first); });
    if (found == names.end()) fail_expected(expected, t);
    s.*field = found->second;
  };
  return row;
}

template <class Group>
Setting yes_or_no(bool Group::*field, Setting row) {
  row.kind = ValueKind::kSwitch;
  row.text = [=](const Settings& s) -> Text { return at(s, field) ? "true" : "false"; };
  row.read = [=](Settings& s, const Text& t) { at(s, field) = parse_switch(t); };
  return row;
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
      number(&Settings::window, {.name = "window",
                                 .value = "N",
                                 .help = "edge of windows in voxels of the lattice, even",
                                 .expert = true,
                                 .least = 4,
                                 .most = kMaxWindow,
                                 .step = 2,
                                 .allowed = "an even number " + range_text(4, kMaxWindow)}),
      number(&Settings::marches,
             {.name = "marches",
              .value = "N",
              .help = "marches over the volume, each with windows twice as large",
              .expert = true,
              .least = 1,
              .most = 4}),
      choice(&Settings::order, kOrders,
             {.name = "order",
              .help = "raster: the paper's, another mesh, narrow on small volumes",
              .expert = true}),
      choice(&Settings::start, kStarts,
             {.name = "start",
              .help = "labels coarsened; larger cells inside them; the paper's",
              .expert = true}),
  };
}

std::vector<Setting> bound_settings() {
  return {
      number(&Settings::edge_variance, {.name = "edge-variance",
                                        .value = "T|none",
                                        .help = "bound on the variance of edge lengths, Eq (3)",
                                        .expert = true,
                                        .least = kAboveZero,
                                        .allowed = "positive, or none"}),
      number(&Settings::quality_floor,
             {.name = "quality-floor",
              .value = "R",
              .help = "no tet below this radius ratio; 0: nothing is asked of shapes",
              .expert = true,
              .least = 0,
              .most = 0.5}),
      number(&Settings::inner_quality,
             {.name = "inner-quality",
              .value = "R|auto",
              .help = "the same for contractions inside labels; less is fewer tets",
              .kind = ValueKind::kNumberOrAuto,
              .expert = true,
              .least = 0,
              .most = 0.8}),
      number(&Settings::max_distance,
             {.name = "max-distance",
              .value = "D|none",
              .help = "voxels at most between interfaces of input and mesh",
              .least = DistanceGuard::min_distance(),
              .most = kMaxDistance,
              .allowed = range_text(0.71, kMaxDistance) +
                         " voxels, or none (the samples are 0.71 voxels apart)"}),
      number(&Settings::target_reduction,
             {.name = "target-reduction",
              .value = "F|none",
              .help = "the paper's: a window stops at that share of voxel corners",
              .expert = true,
              .least = kAboveZero,
              .most = kBelowOne,
              .allowed = "between 0 and 1, or none"}),
  };
}

std::vector<Setting> method_settings() {
  return {
      choice(&Settings::topology, kTopologies,
             {.name = "topology",
              .help = "what is kept: topology of labels, or of interfaces, too",
              .expert = true}),
      choice(&Settings::surface, kSurfaces,
             {.name = "surface",
              .help = "smooth ones that keep volumes, or the paper's",
              .expert = true}),
      choice(&Settings::periodic, kPeriodic,
             {.name = "periodic",
              .value = "AXES",
              .help = "axes along which the volume repeats itself: x to xyz",
              .expert = true}),
      choice(&Settings::optimizer, kOptimizers,
             {.name = "optimizer",
              .help = "what improves tets; tetgen: the paper's, at the end",
              .expert = true}),
      number(&Settings::odt_iterations,
             {.name = "odt-iterations",
              .value = "N",
              .help = "iterations of --optimizer tetgen in a window, at most",
              .expert = true,
              .least = 1,
              .most = 1000}),
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
      number(&SizeSettings::gradation,
             {.name = "gradation",
              .value = "G",
              .help = "around, sizes grow by G times the distance, 0 to 10",
              .expert = true,
              .least = 0,
              .most = 10}),
      yes_or_no(&SizeSettings::inner_vertices,
                {.name = "inner-vertices",
                 .help = "vertices in tets without one inside their label (see --size)",
                 .expert = true}),
      number(&SizeSettings::count, {.name = "count",
                                    .value = "N",
                                    .help = "about N tets: sizes are scaled, after a pilot; 0: any",
                                    .least = 0,
                                    .most = kMaxCount,
                                    .allowed = "from 1 to 1000000000000, or 0 for any"}),
      number(&SizeSettings::across,
             {.name = "across",
              .value = "N",
              .help = "edges across thin parts, at least, if voxels allow; 0: any",
              .expert = true,
              .least = 0,
              .most = kMaxAcross,
              .allowed = range_text(1, kMaxAcross) + ", or 0 for any"}),
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
  io::fail_usage("must be " + setting.allowed);
}

void set(const Setting& setting, MeshSettings& settings, const std::string& text) {
  setting.read(settings, text);
  check(setting, settings);
}

}  // namespace mw::engine
