// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A function for each thing that a user may have to look at; all of them are in a table.
#include "engine/report/attention.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "engine/labels/voxel_lattice.h"
#include "engine/report/connect_report.h"
#include "engine/report/figures.h"
#include "engine/report/volumes_off.h"
#include "io/file/errors.h"
#include "io/labels/interpolated_volume.h"
#include "kernels/audit/shape/volumes.h"
#include "kernels/core/elementary.h"

namespace mw::report {
namespace {

using io::Json;

/// Returns "1 of 3 labels has", "2 of 3 labels have".
std::string labels_have(std::uint64_t some, std::uint64_t all) {
  return io::text(with_commas(some), " of ", with_commas(all), all == 1 ? " label" : " labels",
                  some == 1 ? " has" : " have");
}

std::string lone_label_text(const FinishedRun& run) {
  if (run.labels.size() != 1) return "";
  return "the volume has one label alone, so the mesh is a filled box";
}

/// Tells of label 0 if nobody chose labels and it has the most tets: it is then the background.
std::string background_text(const FinishedRun& run) {
  if (run.choice.any() || !run.amounts || run.labels.size() < 2 || !run.labels.contains(0))
    return "";
  const std::vector<std::uint64_t>& tets = run.amounts->tets;
  const std::uint64_t zero = tets[run.labels.dense(0)];
  if (zero < *std::max_element(tets.begin(), tets.end())) return "";
  const auto all = std::accumulate(tets.begin(), tets.end(), std::uint64_t{0});
  const double share = static_cast<double>(zero) / static_cast<double>(all);
  return "label 0, maybe the background, is meshed, too, and has " + format_percent(share, 0) +
         " of the tets: --background 0 leaves it out";
}

std::string slices_text(const FinishedRun& run) {
  const io::SliceFacts slices = io::slices_of(run.volume);
  const bool is_refused = run.has_scores || run.settings.periodic != 0;
  if (run.slices || slices.layers < 2 || slices.slices < 2 || is_refused) return "";
  return io::text("slices along ", "xyz"[slices.axis], " are ", slices.layers,
                  " times as thick as voxels are wide, so surfaces have steps: "
                  "--interpolate-slices makes labels between them");
}

std::string hanging_text(const FinishedRun& run) {
  if (!run.connected || run.connected->hanging == 0) return "";
  const std::uint64_t hanging = run.connected->hanging;
  return io::text(
      with_commas(hanging), " of ", with_commas(run.connected->parts), " parts ",
      hanging == 1 ? "hangs" : "hang",
      " on the others by a vertex or an edge alone, which no solver holds: --weld joins "
      "them, --open-hinges parts them, --parts largest leaves them out");
}

std::string stiff_text(const FinishedRun& run) {
  if (!run.connected || run.connected->stiff_labels == 0 || run.settings.sizes.inner_vertices) {
    return "";
  }
  return labels_have(run.connected->stiff_labels, run.connected->labels) +
         " no vertex inside, so linear tets are too stiff there when they bend: --inner-vertices "
         "gives them some, --across 2 more";
}

std::string few_voxels_text(const FinishedRun& run) {
  if (!run.amounts) return "";
  std::uint64_t few = 0, all = 0;
  for_each_volume(run, [&](const audit::VolumeRow& row) {
    ++all;
    few += row.voxels < kFewVoxels ? 1 : 0;
  });
  if (few == 0) return "";
  return labels_have(few, all) + " fewer than " + std::to_string(kFewVoxels) +
         " voxels and may lose much of their volume: info MESH VOLUME tells how much, "
         "--max-distance 1 keeps more of it";
}

/// Says what keeps the volumes of thin labels, as measured (bench/parameters.md, "Thin labels").
std::string volumes_mend_text(const FinishedRun& run) {
  constexpr double kNear = 1.0;
  if (!run.why_no_volumes.empty()) return ": " + run.why_no_volumes + " is why";
  if (run.settings.max_distance.value_or(kNear) <= kNear) return "";
  return ": --max-distance 1 keeps thin labels better";
}

/// Names large labels whose volumes are off, and the option that mends most of that.
std::string volumes_text(const FinishedRun& run) {
  const std::string off = volumes_off_text(run);
  return off.empty() ? "" : off + volumes_mend_text(run);
}

using Look = std::string (*)(const FinishedRun&);
constexpr std::array<Look, 8> kLooks{lone_label_text, background_text, spacing_text,
                                     slices_text,     hanging_text,    stiff_text,
                                     volumes_text,    few_voxels_text};

/// Returns the largest of 1, 1.5, 2, 2.5, 3, 4, 5, 6 and 8 times a power of ten that is not above a
/// length.
double round_length_below(double length) {
  constexpr std::array kSteps{1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0};
  const double unit = power_of_ten_below(length);
  double out = unit;
  for (const double step : kSteps) {
    if (step * unit <= length) out = step * unit;
  }
  return out;
}

/// Returns the volume of the labels that are written, in physical units.
double volume_of(const FinishedRun& run) {
  double voxels = 0;
  for_each_volume(run, [&](const audit::VolumeRow& row) { voxels += row.volume_voxels; });
  const auto& spacing = run.volume.space.spacing;
  return voxels * spacing[0] * spacing[1] * spacing[2];
}

}  // namespace

std::string spacing_text(const FinishedRun& run) {
  if (run.volume.space.is_sized) return "";
  return "a spacing of 1 is taken, as the file does not say how large voxels are: --spacing says "
         "it";
}

std::vector<std::string> attention(const FinishedRun& run) {
  std::vector<std::string> out;
  for (const Look look : kLooks) {
    if (std::string line = look(run); !line.empty()) out.push_back(std::move(line));
  }
  return out;
}

Json suggestion(const FinishedRun& run) {
  const engine::SizeSettings& sizes = run.settings.sizes;
  const bool is_asked = sizes.limits_edges() || sizes.count > 0;
  const bool has_sizes = run.settings.periodic == 0 && !run.has_scores;
  if (is_asked || !has_sizes || !run.figures || !run.amounts) return nullptr;
  // The sizes that are worth a hint: shorter than edges are, and not cutting tets.
  constexpr double kShorter = 0.6, kLeastVoxels = 1.5, kMore = 1.5;
  const double size = round_length_below(kShorter * run.figures->quality.edge_median);
  if (size < kLeastVoxels * engine::voxel_edge(run.volume)) return nullptr;
  const double tets = engine::SizeRules::kTetsACube * volume_of(run) / (size * size * size);
  if (tets < kMore * static_cast<double>(run.engine.tets) || tets > 1e8) return nullptr;
  const double digit = power_of_ten_below(tets);
  return {{"size", size}, {"tets", static_cast<std::uint64_t>(std::round(tets / digit) * digit)}};
}

}  // namespace mw::report
