// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Trial meshes of the volume or of parts of it, and the search for a factor.
#include "engine/job/count_pilot.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "engine/job/pilot_sample.h"
#include "engine/labels/label_regions.h"
#include "engine/labels/prepared_labels.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/output/label_selection.h"
#include "engine/run/processes.h"
#include "engine/system/crew.h"
#include "engine/window/window_visitor.h"
#include "io/mesh/mesh_sink.h"
#include "io/volume/cropped_volume.h"
#include "kernels/core/elementary.h"
#include "kernels/core/index.h"
#include "kernels/start/cells/cell.h"

namespace mw::engine {
namespace {

constexpr int kMaxTrials = 6;
/// A trial with this error is near enough: counts that are asked for are met within 10 %.
constexpr double kNearEnough = 0.05;
/// From a trial with this error the next factor is near enough without a mesh: from the first one,
/// whose slope is taken to be the usual one, and from later ones.
constexpr double kNearForOne = 0.16, kNearForMore = 0.3;
/// The size, in voxels, beyond which no limit on edges matters.
constexpr double kLargestSize = 64.0;
/// Exponents between two meshes of the whole, where cells of the start mesh may have grown.
constexpr double kSteepestAtJump = -8, kFlattestOfWhole = -0.5;

/// Returns the sizes that the factor is meant for.
SizeRules base_rules(const SizeRules& rules) {
  SizeRules out = rules;
  if (!out.any()) out.others = 1.0;
  return out;
}

/// Returns how many cubes of its size the labels that are written have, as if each were filled with
/// them; 0 where no label has a size.
double cubes_of_size(const PilotTask& task, const SizeRules& rules) {
  const io::LabelTable& table = task.labels.table();
  const LabelSelection kept(wanted_labels(task.job.choice, table), table);
  const auto& spacing = task.labels.info().space.spacing;
  double out = 0;
  for (const LabelRegion& region :
       label_regions(task.labels.raw(), thread_count(task.job.run.threads))) {
    const std::optional<double> size = rules.of_label(region.label);
    if (!size || !kept.keeps(table.dense(region.label))) continue;
    out += static_cast<double>(region.voxels) * spacing[0] * spacing[1] * spacing[2] /
           (*size * *size * *size);
  }
  return out;
}

/// Returns whether each label that is written has a size.
bool have_all_sizes(const PilotTask& task, const SizeRules& rules) {
  const io::LabelTable& table = task.labels.table();
  const LabelSelection kept(wanted_labels(task.job.choice, table), table);
  bool all = true;
  for (Label label = 0; label < table.size(); ++label) {
    all = all && (!kept.keeps(label) || rules.of_label(table.raw(label)).has_value());
  }
  return all;
}

/// Returns the ends of what factors may be, as logarithms.
std::array<double, 2> logarithms_of_scales(const io::DenseVolume& labels,
                                           const MeshSettings& settings) {
  const VoxelLattice lattice(labels);
  const auto& spacing = lattice.info().space.spacing;
  const double voxel = *std::min_element(spacing.begin(), spacing.end());
  const double diagonal = std::hypot(spacing[0], spacing[1], spacing[2]);
  const SizeRules rules = base_rules(settings.sizes.rules);
  const double least = std::isfinite(rules.least()) ? rules.least() : voxel;
  constexpr double kRoundedUp = 1.0 + 1e-9;
  const auto logarithm_of = [](double factor) {
    return logarithm(std::min(factor, std::numeric_limits<double>::max()));
  };
  return {logarithm_of(kRoundedUp * diagonal / SizeRules::kContracted / least),
          logarithm_of(kLargestSize * voxel / least)};
}

/// Passes on what is below, so that a view can own it.
class Whole : public io::VolumeView {
 public:
  explicit Whole(const io::LabelVolume& volume) : VolumeView(volume) {}
  void read(const Box3& box, std::span<RawLabel> out) const override { below().read(box, out); }
};

constexpr const char* kFolderEnding = ".pilot";
constexpr GroupCommit kNeverDurable{.windows = 1 << 30, .age = std::chrono::hours(1 << 16)};

/// Meshes the volume, or a part of it that `labels` are of, and writes nothing.
RunReport trial_mesh(const PilotTask& task, const io::DenseVolume& labels,
                     const MeshSettings& settings, double scale,
                     const std::optional<PilotPart>& part) {
  const MeshJob& job = task.job;
  RunHooks hooks{.threads = job.run.threads};
  hooks.progress = [&](const RunProgress& /*at*/) { job.stop(); };
  hooks.output.wanted = wanted_labels(job.choice, labels.table());
  if (part) hooks.output.within = part->within;
  hooks.store.memory = task.memory;
  hooks.store.memory_beside = task.memory_beside;
  hooks.owns_process = job.run.owns_process;
  hooks.store.is_scratch = true;
  // Several processes, which all do the same, would meet in one folder.
  if (is_alone(job.run.processes) && !job.run.store.workdir.empty()) {
    hooks.store.workdir = job.run.store.workdir.string() + kFolderEnding;
    hooks.store.group = kNeverDurable;
  }
  std::optional<SizeImage> image;
  if (task.image != nullptr) {
    const SizeImage sizes = task.image->scaled(scale);
    image.emplace(part ? sizes.part(part->voxels) : sizes);
  }
  hooks.sizes = image ? &*image : nullptr;
  io::NoSink sink;
  return mesh_volume(labels, settings, sink, hooks);
}

/// Returns the settings of a mesh at this factor.
MeshSettings trial_settings(const PilotTask& task, double scale) {
  MeshSettings out = with_scale(task.job.settings, scale);
  out.sizes.count = 0;
  return out;
}

/// Makes one trial after the other, each at a logarithm of the factor.
class Pilot {
 public:
  explicit Pilot(const PilotTask& task) : task_(task) {
    const MeshSettings& settings = task.job.settings;
    const VoxelLattice lattice(task.labels);
    const auto& spacing = lattice.info().space.spacing;
    const double voxel = *std::min_element(spacing.begin(), spacing.end());
    const SizeRules rules = base_rules(settings.sizes.rules);
    // Sizes of an image alone are taken to be about those of its voxels.
    const double least = std::isfinite(rules.least()) ? rules.least() : voxel;
    range_ = logarithms_of_scales(task.labels, settings);
    const double volume =
        static_cast<double>(lattice.info().shape.product()) * spacing[0] * spacing[1] * spacing[2];
    const double cubes = cubes_of_size(task, rules);
    // Where no label has a size the whole counts as if regular tets of the least size filled it.
    look_at_labels(lattice, cubes > 0 ? cubes : volume / (least * least * least),
                   cubes > 0 ? SizeRules::kTetsACube : 1 / kTetVolume);
    all_have_sizes_ = have_all_sizes(task, rules);
  }

  report::CountFacts search() {
    double at = std::clamp(first_, range_[0], range_[1]);
    bool is_told = false;  // by trials elsewhere
    for (int i = 0; i < kMaxTrials && !is_told; ++i) {
      trials_.push_back({at, tets_at(exponential(at))});
      const double error = std::abs(error_of(trials_.back()));
      if (error <= kNearEnough || is_at_end(trials_.back())) break;
      at = std::clamp(next(), range_[0], range_[1]);
      is_told = error <= (i == 0 ? kNearForOne : kNearForMore) && answers_as_usual();
    }
    const Trial best =
        is_told ? Trial{at, asked()}
                : *std::min_element(trials_.begin(), trials_.end(),
                                    [&](const Trial& a, const Trial& b) {
                                      return std::abs(error_of(a)) < std::abs(error_of(b));
                                    });
    return {.asked = static_cast<std::uint64_t>(task_.job.settings.sizes.count),
            .scale = exponential(best.at),
            .expected = static_cast<std::uint64_t>(best.tets + 0.5),
            .is_least = is_at_end(trials_.back()) && best.tets > asked(),
            .is_most = is_at_end(trials_.back()) && best.tets < asked(),
            .may_be_off = !parts_.empty(),
            .trials = static_cast<int>(trials_.size()),
            .voxels = voxels_};
  }

 private:
  /// The volume of a regular tet with edges of 1.
  static constexpr double kTetVolume = 0.1178511301977579;
  /// Tets that a square of faces between labels adds where its edges are as long as the size,
  /// about.
  static constexpr double kTetsAFace = 4;
  /// Exponents of the size in the count: the flattest, the steepest, and the usual one.
  static constexpr double kFlattest = -0.3, kSteepest = -3.5, kUsual = -2.4;
  /// The flattest one where sizes are to grow: the count hardly falls any more where other bounds
  /// keep tets, and the end of the range, where that is known for sure, may be far.
  static constexpr double kFlattestToFewer = -0.05;

  struct Trial {
    double at = 0;  ///< logarithm of the factor
    double tets = 0;
  };

  [[nodiscard]] double asked() const { return static_cast<double>(task_.job.settings.sizes.count); }
  /// Returns the error of the count, as a logarithm.
  [[nodiscard]] double error_of(const Trial& t) const {
    return logarithm(std::max(t.tets, 1.0) / asked());
  }
  [[nodiscard]] bool is_at_end(const Trial& t) const {
    return (t.at == range_[0] && error_of(t) < 0) || (t.at == range_[1] && error_of(t) > 0);
  }

  /// Returns whether the count follows sizes as it does where all labels have one, so that next()
  /// may be trusted: by the last two trials, or, of one, because all labels have one.
  [[nodiscard]] bool answers_as_usual() const {
    if (trials_.size() == 1) return all_have_sizes_;
    const Trial &a = trials_[trials_.size() - 2], &b = trials_.back();
    return (error_of(b) - error_of(a)) / (b.at - a.at) <= kFlattest;
  }

  /// Returns where a line has the count: through the nearest trials on both sides of it, else
  /// through the last two.
  [[nodiscard]] double next() const {
    std::optional<Trial> more, fewer;
    for (const Trial& t : trials_) {
      std::optional<Trial>& side = error_of(t) > 0 ? more : fewer;
      if (!side || std::abs(error_of(t)) < std::abs(error_of(*side))) side = t;
    }
    const Trial& last = trials_.back();
    if (more && fewer) {
      const double part = error_of(*more) / (error_of(*more) - error_of(*fewer));
      return more->at + std::clamp(part, 0.05, 0.95) * (fewer->at - more->at);
    }
    double slope = kUsual;
    if (trials_.size() > 1) {
      const Trial& other = trials_[trials_.size() - 2];
      slope = std::clamp((error_of(last) - error_of(other)) / (last.at - other.at), kSteepest,
                         error_of(last) > 0 ? kFlattestToFewer : kFlattest);
    }
    return last.at - error_of(last) / slope;
  }

  /// Guesses the first factor, from `cubes` of the sizes with `tets` each and from the faces
  /// between labels, and chooses the parts that stand for the whole.
  void look_at_labels(const VoxelLattice& lattice, double cubes, double tets) {
    MeshSettings plain = task_.job.settings;
    plain.start = StartMesh::kDense;
    plain.sizes = {};
    plain.periodic = 0;  // the lattice here is that of a volume that does not repeat itself
    const PreparedLabels labels(lattice.labels(), plain, thread_count(task_.job.run.threads),
                                io::scratch_folder());
    inner_quality_ = inner_quality_for(labels.counts().faces);
    const io::LabelTable& table = task_.labels.table();
    const LabelSelection kept(wanted_labels(task_.job.choice, table), table);
    const PilotSample sample(lattice, labels, kept, task_.max_one_part);
    const auto voxels = static_cast<double>(std::max<std::int64_t>(1, sample.content().voxels));
    const double a_voxel = tets * cubes / voxels;  // tets in one at a factor of 1
    const double a_face = kTetsAFace * power(cubes / voxels, 2.0 / 3);
    first_ = first_guess(a_voxel * voxels, a_face * static_cast<double>(sample.content().faces));
    // One part does not stand for a small volume whose sizes differ from place to place.
    const bool is_small = lattice.info().shape.product() <= task_.max_one_part;
    if (task_.image != nullptr && is_small) return;
    parts_ = sample.parts(a_voxel / (a_face * exponential(first_)));
  }

  /// Returns where inner / x^3 + faces / x^2 are the tets that are asked for, x being the factor.
  [[nodiscard]] double first_guess(double inner, double faces) const {
    double low = range_[0], high = range_[1];
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2, factor = exponential(middle);
      const double tets = (inner / factor + faces) / (factor * factor);
      (tets > asked() ? low : high) = middle;
    }
    return low;
  }

  double tets_at(double scale) {
    if (parts_.empty()) {
      voxels_ += task_.labels.info().shape.product();
      return static_cast<double>(count_whole(task_, scale));
    }
    MeshSettings settings = trial_settings(task_, scale);
    settings.periodic = 0;  // a part of a cell does not repeat itself
    if (!settings.inner_quality) settings.inner_quality = inner_quality_;
    double sum = 0;
    for (const PilotPart& part : parts_) {
      const io::CroppedVolume cut(std::make_unique<Whole>(task_.labels.raw()), part.voxels, true);
      const RunReport report =
          trial_mesh(task_, io::DenseVolume(cut, task_.labels.table()), settings, scale, part);
      voxels_ += part.voxels.voxels();
      sum += part.weight * static_cast<double>(report.tets_within);
    }
    return sum;
  }

  const PilotTask& task_;
  std::array<double, 2> range_{};  ///< of the logarithm of the factor
  double first_ = 0;
  bool all_have_sizes_ = false;
  std::vector<PilotPart> parts_;  ///< empty: the volume is meshed whole
  double inner_quality_ = 0;
  std::vector<Trial> trials_;
  std::int64_t voxels_ = 0;  ///< how many were meshed in all
};

/// Returns the factor for another mesh where the one with count.scale has `tets` tets.
double next_scale(const report::CountFacts& count, std::uint64_t tets,
                  const io::DenseVolume& labels, const MeshSettings& settings) {
  const auto tets_here = static_cast<double>(std::max<std::uint64_t>(1, tets));
  const double off = logarithm(tets_here / static_cast<double>(count.asked));
  // The exponent of sizes in a count is -1.7 where bounds keep many tets, -2.7 where few.
  double slope = -2.1;
  if (count.earlier_tets > 0 && count.earlier_scale != count.scale) {
    slope = logarithm(tets_here / static_cast<double>(count.earlier_tets)) /
            logarithm(count.scale / count.earlier_scale);
    slope = std::clamp(slope, kSteepestAtJump, kFlattestOfWhole);
  }
  const auto [least, most] = logarithms_of_scales(labels, settings);
  return exponential(std::clamp(logarithm(count.scale) - off / slope, least, most));
}

}  // namespace

MeshSettings with_scale(const MeshSettings& settings, double scale) {
  MeshSettings out = settings;
  out.sizes.rules = base_rules(settings.sizes.rules).scaled(scale);
  return out;
}

report::CountFacts scale_for_count(const PilotTask& task) {
  return Pilot(task).search();
}

std::uint64_t count_whole(const PilotTask& task, double scale) {
  return trial_mesh(task, task.labels, trial_settings(task, scale), scale, std::nullopt).tets;
}

bool may_be_remade(const report::CountFacts& count, const io::DenseVolume& labels) {
  return count.may_be_off && VoxelLattice(labels).info().shape.product() <= kMaxOnePart;
}

bool take_next_scale(report::CountFacts& count, std::uint64_t tets, const io::DenseVolume& labels,
                     const MeshSettings& settings) {
  constexpr double kMost = 0.09;
  const double off = static_cast<double>(tets) - static_cast<double>(count.asked);
  count.is_least = count.is_most = false;
  if (std::abs(off) <= kMost * static_cast<double>(count.asked)) return false;
  const double next = next_scale(count, tets, labels, settings);
  if (next == count.scale) {
    count.is_least = off > 0;
    count.is_most = off < 0;
    return false;
  }
  count.may_be_off = count.earlier_tets == 0;
  count.earlier_scale = count.scale;
  count.earlier_tets = tets;
  count.scale = next;
  count.expected = count.asked;
  ++count.trials;
  count.voxels += labels.info().shape.product();
  return true;
}

}  // namespace mw::engine
