// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Trial meshes of the volume or of cubes of it, and the search for a factor.
#include "engine/job/count_pilot.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/labels/label_regions.h"
#include "engine/labels/prepared_labels.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/output/label_selection.h"
#include "engine/system/crew.h"
#include "engine/window/window_visitor.h"
#include "io/mesh/mesh_sink.h"
#include "io/volume/cropped_volume.h"
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
constexpr std::int64_t kCube = 64;
constexpr std::int64_t kHalo = 16;
constexpr std::int64_t kLeastCubes = 4;
constexpr std::int64_t kMostCubes = 16;
/// Voxels weigh as this many faces, since a cube of one label has some tets, too.
constexpr double kFacesPerVoxel = 0.01;
/// The size, in voxels, beyond which no limit on edges matters.
constexpr double kLargestSize = 64.0;

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

/// A part of the volume that is meshed, and what of it counts.
struct Cube {
  Box3 voxels;  ///< of the volume, with the halo
  Box3 within;  ///< what counts, in the lattice of these voxels
  double weight = 0.0;
};

/// Passes on what is below, so that a view can own it.
class Whole : public io::VolumeView {
 public:
  explicit Whole(const io::LabelVolume& volume) : VolumeView(volume) {}
  void read(const Box3& box, std::span<RawLabel> out) const override { below().read(box, out); }
};

/// Draws the cubes that are meshed, with chances in proportion to their weights: along the sum of
/// all weights, each odd multiple of half a step draws the cube that it lies in.
class Sample {
 public:
  Sample(const PilotTask& task, const VoxelLattice& lattice, const PreparedLabels& labels)
      : task_(task), lattice_(lattice), labels_(labels) {
    const Index3 shape = lattice.info().shape;
    cubes_ = cells_of({{0, 0, 0}, shape}, cube_edges());
    for_each_index(cubes_, [&](Index3 c) { weights_.push_back(weight_of(box_of(c))); });
    for (const double weight : weights_) total_ += weight;
  }

  [[nodiscard]] std::vector<Cube> drawn() const {
    const std::int64_t voxels = lattice_.info().shape.product();
    const std::int64_t edge = kCube + 2 * kHalo;
    const std::int64_t wanted =
        std::clamp(voxels / (4 * edge * edge * edge), kLeastCubes, kMostCubes);
    const double step = total_ / static_cast<double>(wanted);
    std::vector<Cube> out;
    double before = 0;
    std::size_t i = 0;
    for_each_index(cubes_, [&](Index3 c) {
      const double weight = weights_[i++];
      const double draws =
          std::floor((before + weight) / step + 0.5) - std::floor(before / step + 0.5);
      before += weight;
      if (draws > 0 && weight > 0) out.push_back(cube_at(c, draws * step / weight));
    });
    return out;
  }

 private:
  /// Returns multiples of the layers, so that a cube is of whole voxels.
  [[nodiscard]] Index3 cube_edges() const {
    const Index3 layers = lattice_.layers();
    const auto rounded = [](std::int64_t n) { return std::max<std::int64_t>(1, kCube / n) * n; };
    return {rounded(layers.x), rounded(layers.y), rounded(layers.z)};
  }
  [[nodiscard]] Box3 box_of(Index3 c) const {
    const Index3 e = cube_edges();
    const Index3 lo{c.x * e.x, c.y * e.y, c.z * e.z};
    return intersection({lo, lo + e}, {{0, 0, 0}, lattice_.info().shape});
  }

  /// Returns a weight for the faces between labels, and for the voxels, of labels that are written.
  [[nodiscard]] double weight_of(const Box3& box) const {
    const LabelSelection kept(wanted_labels(task_.job.choice, lattice_.volume().table()),
                              lattice_.volume().table());
    const LabelBox labels = labels_.original({box.lo, box.hi + Index3{1, 1, 1}});
    std::int64_t faces = 0, voxels = 0;
    for_each_index(box, [&](Index3 v) {
      const Label own = labels.at(v);
      const bool is_written = kept.keeps(own);
      voxels += is_written ? 1 : 0;
      for (unsigned axis = 0; axis < 3; ++axis) {
        const Label next = labels.at(v + axis_vector(axis));
        if (next == own || next == kExterior) continue;
        faces += is_written || kept.keeps(next) ? 1 : 0;
      }
    });
    return static_cast<double>(faces) + kFacesPerVoxel * static_cast<double>(voxels);
  }

  [[nodiscard]] Cube cube_at(Index3 c, double weight) const {
    const Index3 layers = lattice_.layers(), shape = lattice_.info().shape;
    const Box3 counted = box_of(c);
    const Box3 around = intersection(grown(counted, kHalo), {{0, 0, 0}, shape});
    const Box3 voxels{
        {around.lo.x / layers.x, around.lo.y / layers.y, around.lo.z / layers.z},
        {(around.hi.x + layers.x - 1) / layers.x, (around.hi.y + layers.y - 1) / layers.y,
         (around.hi.z + layers.z - 1) / layers.z}};
    const Index3 first{voxels.lo.x * layers.x, voxels.lo.y * layers.y, voxels.lo.z * layers.z};
    return {voxels, {counted.lo - first, counted.hi - first}, weight};
  }

  const PilotTask& task_;
  const VoxelLattice& lattice_;
  const PreparedLabels& labels_;
  Box3 cubes_;
  std::vector<double> weights_;
  double total_ = 0;
};

/// Makes one trial after the other, each at a logarithm of the factor.
class Pilot {
 public:
  explicit Pilot(const PilotTask& task) : task_(task) {
    const MeshSettings& settings = task.job.settings;
    const VoxelLattice lattice(task.labels);
    const auto& spacing = lattice.info().space.spacing;
    const double voxel = *std::min_element(spacing.begin(), spacing.end());
    const double diagonal = std::hypot(spacing[0], spacing[1], spacing[2]);
    const SizeRules rules = base_rules(settings.sizes.rules);
    // Sizes of an image alone are taken to be about those of its voxels.
    const double least = std::isfinite(rules.least()) ? rules.least() : voxel;
    constexpr double kRoundedUp = 1.0 + 1e-9;
    range_ = {std::log(kRoundedUp * diagonal / SizeRules::kContracted / least),
              std::log(kLargestSize * voxel / least)};
    const Index3 shape = lattice.info().shape;
    const double cubes = cubes_of_size(task, rules);
    first_ = cubes > 0 ? std::log(std::cbrt(SizeRules::kTetsACube * cubes / asked()))
                       : std::log(std::cbrt(static_cast<double>(shape.product()) * spacing[0] *
                                            spacing[1] * spacing[2] / (kTetVolume * asked())) /
                                  least);
    all_have_sizes_ = have_all_sizes(task, rules);
    cubes_ = find_cubes(lattice);
  }

  report::CountFacts search() {
    double at = std::clamp(first_, range_[0], range_[1]);
    bool is_told = false;  // by trials elsewhere
    for (int i = 0; i < kMaxTrials && !is_told; ++i) {
      trials_.push_back({at, tets_at(std::exp(at))});
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
            .scale = std::exp(best.at),
            .expected = static_cast<std::uint64_t>(best.tets + 0.5),
            .is_least = is_at_end(trials_.back()) && best.tets > asked(),
            .is_most = is_at_end(trials_.back()) && best.tets < asked(),
            .trials = static_cast<int>(trials_.size()),
            .voxels = voxels_};
  }

 private:
  /// The volume of a regular tet with edges of 1.
  static constexpr double kTetVolume = 0.1178511301977579;
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
    return std::log(std::max(t.tets, 1.0) / asked());
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

  [[nodiscard]] std::vector<Cube> find_cubes(const VoxelLattice& lattice) {
    if (lattice.info().shape.product() <= task_.max_whole) return {};
    MeshSettings plain = task_.job.settings;
    plain.start = StartMesh::kDense;
    plain.sizes = {};
    const PreparedLabels labels(lattice.labels(), plain, thread_count(task_.job.run.threads),
                                io::scratch_folder());
    inner_quality_ = inner_quality_for(labels.counts().faces);
    return Sample(task_, lattice, labels).drawn();
  }

  double tets_at(double scale) {
    MeshSettings settings = with_scale(task_.job.settings, scale);
    settings.sizes.count = 0;
    if (cubes_.empty()) {
      const Index3 shape = task_.labels.info().shape;
      return static_cast<double>(mesh(task_.labels, settings, scale, std::nullopt, shape).tets);
    }
    settings.periodic = 0;  // a part of a cell does not repeat itself
    if (!settings.inner_quality) settings.inner_quality = inner_quality_;
    double sum = 0;
    for (const Cube& cube : cubes_) {
      const io::CroppedVolume part(std::make_unique<Whole>(task_.labels.raw()), cube.voxels, true);
      const RunReport report = mesh(io::DenseVolume(part, task_.labels.table()), settings, scale,
                                    cube.within, cube.voxels.shape());
      sum += cube.weight * static_cast<double>(report.tets_within);
    }
    return sum;
  }

  RunReport mesh(const io::DenseVolume& labels, const MeshSettings& settings, double scale,
                 const std::optional<Box3>& within, Index3 shape) {
    const MeshJob& job = task_.job;
    RunHooks hooks{.threads = job.run.threads};
    hooks.progress = [&](const RunProgress& /*at*/) { job.stop(); };
    hooks.output.wanted = wanted_labels(job.choice, labels.table());
    hooks.output.within = within;
    hooks.store.memory = task_.memory;
    hooks.store.memory_beside = task_.memory_beside;
    hooks.owns_process = job.run.owns_process;
    hooks.store.is_scratch = true;
    // Several processes, which all do the same, would meet in one folder.
    const bool is_alone = job.run.processes == nullptr || job.run.processes->count() == 1;
    if (is_alone && !job.run.store.workdir.empty()) {
      hooks.store.workdir = job.run.store.workdir.string() + kFolderEnding;
      hooks.store.group = kNeverDurable;
    }
    std::optional<SizeImage> image;
    if (task_.image != nullptr) image.emplace(task_.image->scaled(scale));
    hooks.sizes = image ? &*image : nullptr;
    io::NoSink sink;
    voxels_ += shape.product();
    return mesh_volume(labels, settings, sink, hooks);
  }

  static constexpr const char* kFolderEnding = ".pilot";
  static constexpr GroupCommit kNeverDurable{.windows = 1 << 30,
                                             .age = std::chrono::hours(1 << 16)};

  const PilotTask& task_;
  std::array<double, 2> range_{};  ///< of the logarithm of the factor
  double first_ = 0;
  bool all_have_sizes_ = false;
  std::vector<Cube> cubes_;  ///< empty: the volume is meshed whole
  double inner_quality_ = 0;
  std::vector<Trial> trials_;
  std::int64_t voxels_ = 0;  ///< how many were meshed in all
};

}  // namespace

MeshSettings with_scale(const MeshSettings& settings, double scale) {
  MeshSettings out = settings;
  out.sizes.rules = base_rules(settings.sizes.rules).scaled(scale);
  return out;
}

report::CountFacts scale_for_count(const PilotTask& task) {
  return Pilot(task).search();
}

}  // namespace mw::engine
