// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Gather, simplify, optimise, scatter.
#include "engine/window/window_visitor.h"

#include <algorithm>
#include <array>
#include <limits>

#include "engine/labels/periodic_labels.h"
#include "engine/system/stopwatch.h"
#include "kernels/inner/inner_vertices.h"
#include "kernels/start/carrier_faces.h"

namespace mw::engine {
namespace {

/// Without a quality floor there is no bound on shapes, around inner vertices neither.
SimplifyOptions simplify_options(const MeshSettings& settings) {
  SimplifyOptions options{.quality_floor = settings.quality_floor,
                          .inner_quality = settings.inner_quality.value_or(kInnerQuality),
                          .edge_variance = settings.edge_variance,
                          .topology = settings.topology,
                          .keep_smooth = settings.surface == Surface::kSmooth};
  if (settings.quality_floor == 0.0) options.inner_quality = 0.0;
  return options;
}

/// The least radius ratio around new inner vertices where the quality floor is lower.
constexpr double kMinInnerRatio = 0.1;

/// The curvature of threads one voxel thick (bench/parameters.md, "Constants").
constexpr double kMaxCurvatureOfSource = 4.0;

/// Where edges have sizes, the weights of lines of three labels, of planes and of the fit beside
/// those (bench/parameters.md, "Constants").  Longer edges would cut the corners of lines.
constexpr double kLineOfSizes = 10.0, kLinePlanesOfSizes = 10.0, kJunctionFitOfSizes = 5.0;

/// The weight of the fit to crossings, whose places are known and not estimated, and those of area
/// and bends beside it (bench/parameters.md, "Constants").
constexpr double kFitOfCrossings = 20.0, kAreaOfCrossings = 0.05, kBendOfCrossings = 4.7;

std::optional<SurfaceWeights> surface_weights(const MeshSettings& settings,
                                              const PreparedLabels& labels) {
  if (settings.surface == Surface::kVoxel) return std::nullopt;
  SurfaceWeights weights;
  const double near = settings.max_distance.value_or(kMaxCoarseDistance);
  weights.keep_thin = near < *MeshSettings{}.max_distance && !labels.has_crossings();
  // Edges that follow a source surface have no steps, and threads of a voxel would be pulled tight.
  if (!labels.has_source()) return weights;
  weights.max_curvature = kMaxCurvatureOfSource;
  if (settings.sizes.rules.any()) weights.line = kLineOfSizes;
  if (!labels.has_crossings()) {
    weights.junction_fit = kJunctionFitOfSizes;
    if (settings.sizes.rules.any()) weights.line_planes = kLinePlanesOfSizes;
    return weights;
  }
  weights.fit = kFitOfCrossings;
  weights.junction_fit = 0.5 * kFitOfCrossings;
  weights.area = kAreaOfCrossings;
  weights.bend = kBendOfCrossings;
  return weights;
}

/// How far from the planes where a volume that repeats itself ends the last march works once more,
/// in voxels (bench/parameters.md, "Constants").
constexpr std::int64_t kNearPlane = 4;

/// Returns the largest level of cells that blocks of the grid are made of.
int largest_level(const WindowGrid& grid, const MeshSettings& settings) {
  MeshSettings of_grid = settings;
  of_grid.window = std::min(settings.window, static_cast<int>(2 * grid.block_edge()));
  return periodic_level(grid.volume(), settings, largest_cell_level(of_grid));
}

std::int32_t units(std::int64_t voxels) {
  return static_cast<std::int32_t>(voxels * kUnitsPerVoxel);
}

Box3 moved(const Box3& box, Index3 by) {
  return {box.lo + by, box.hi + by};
}

}  // namespace

// More than five parameters: each is an object of another room, which the visitor refers to.
WindowVisitor::WindowVisitor(const PreparedLabels& labels, const Metric& metric,
                             const MeshSettings& settings, const WindowGrid& grid,
                             BlockStore& store, VisitPlan plan)
    : labels_(labels),
      grid_(grid),
      store_(store),
      metric_(metric),
      inner_(inner_planes(settings)),
      start_{.max_level = largest_level(grid, settings),
             .coarse = labels.is_coarse(),
             .with_samples = settings.max_distance.has_value(),
             .max_distance = settings.max_distance.value_or(kMaxCoarseDistance),
             .weights = {},
             .metric = metric,
             .quality_floor = settings.quality_floor,
             .sizes = labels.start_sizes()},
      templates_(metric, settings.quality_floor),
      simplify_(simplify_options(settings)),
      optimise_{.sweeps = settings.optimizer == Optimizer::kNone ? 0 : 1,
                .quality_floor = settings.quality_floor,
                .surface = surface_weights(settings, labels),
                .moves_fitted = false,
                .demands = {.sizes = labels.sizes()}},
      codt_{.iterations = settings.odt_iterations, .quality_floor = settings.quality_floor},
      before_(plan.before),
      turn_(plan.turn),
      turns_(plan.turns),
      triangulate_(std::move(plan.triangulate)),
      max_distance_(settings.max_distance),
      target_reduction_(settings.target_reduction) {
  simplify_.demands = optimise_.demands;
  if (plan.seeding) simplify_.seeding = std::move(plan.seeding);
  if (plan.last) polish(*plan.last);
  if (triangulate_ && codt_.quality_floor == 0.0) optimise_.sweeps = 0;
}

void WindowVisitor::polish(const WindowOrder& order) {
  // What no later window sees gets more sweeps, and flips of tets that are not bad, too
  // (bench/parameters.md, "Constants").
  constexpr int kSweeps = 3, kSmoothSweeps = 5;
  constexpr double kFlipBelow = 0.7;
  optimise_.sweeps *= optimise_.surface ? kSmoothSweeps : kSweeps;
  optimise_.flip_below = kFlipBelow;
  optimise_.moves_fitted = true;
  if (optimise_.surface) order_ = order;
  simplify_.demands.inner = optimise_.demands.inner = labels_.inner();
}

VisitStats& VisitStats::operator+=(const VisitStats& other) {
  windows += other.windows;
  simplify += other.simplify;
  optimise += other.optimise;
  codt += other.codt;
  inner_vertices += other.inner_vertices;
  start_seconds += other.start_seconds;
  simplify_seconds += other.simplify_seconds;
  optimise_seconds += other.optimise_seconds;
  codt_seconds += other.codt_seconds;
  exchange_seconds += other.exchange_seconds;
  return *this;
}

/// Returns whether a march that heals what the one before left has work in a window: whether a grid
/// or the volume begins within it, along an axis where volumes repeat themselves.
bool WindowVisitor::has_rest(Index3 window) const {
  const Index3 upper = grid_.in_volume(window + Index3{1, 1, 1});
  const auto is_within = [&](unsigned axis) {
    const std::int64_t first = along(before_->first(), axis), block = along(upper, axis);
    return first > 0 && (block == first || block == 0);
  };
  return is_within(0) || is_within(1) || is_within(2);
}

/// A star that does not reach through a plane where the grid before begins was in one of its
/// windows as a whole.  In this grid, which begins later in the volume, one such plane an axis lies
/// inside.
///
/// The planes where the volume ends have been inside of windows only once by then, and what is near
/// them is not yet as coarse and as smooth as the rest.
std::vector<LatticeBox> WindowVisitor::finished_boxes() const {
  if (!before_) return {};
  using Limits = std::numeric_limits<std::int32_t>;
  using Interval = std::array<std::int32_t, 2>;
  const auto intervals = [&](unsigned axis) -> std::vector<Interval> {
    const std::int64_t first = along(before_->first(), axis), end = along(grid_.volume(), axis);
    if (first == 0) return {{Limits::min(), Limits::max()}};
    const std::int32_t begin = units(end + first * before_->block_edge());
    return {{Limits::min(), units(end - kNearPlane)},
            {units(end + kNearPlane), begin},
            {begin, Limits::max()}};
  };
  std::vector<LatticeBox> out;
  for (const Interval z : intervals(2)) {
    for (const Interval y : intervals(1)) {
      for (const Interval x : intervals(0)) {
        out.push_back({{x[0], y[0], z[0]}, {x[1], y[1], z[1]}});
      }
    }
  }
  return out;
}

VisitStats WindowVisitor::visit(Index3 window) const {
  VisitStats stats{.windows = 1};
  Stopwatch watch;
  const std::vector<Index3> blocks = grid_.blocks_of(window);
  std::vector<std::optional<BlockMesh>> stored = store_.take(window);
  std::vector<BlockMesh> content;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    content.push_back(stored[i] ? std::move(*stored[i]) : start(blocks[i]));
  }
  watch.lap(stats.start_seconds);
  if (before_ && !has_rest(window)) {
    store_.commit(window, std::move(content));
    return stats;
  }
  WindowContent window_content = gather(std::move(content), grid_.volume(), inner_);
  watch.lap(stats.exchange_seconds);
  work_on(window, window_content, stats);
  watch.restart();
  store_.commit(window, scatter(window_content, grid_, window));
  watch.lap(stats.exchange_seconds);
  return stats;
}

LabelBox WindowVisitor::labels_around(const TetMesh& mesh) const {
  const Box3 around = voxels_around(mesh, LabelReach::search_reach(*max_distance_));
  const Index3 first = grid_.first();
  const std::array<bool, 3> repeats{first.x > 0, first.y > 0, first.z > 0};
  LabelBox out = repeated_labels(around, grid_.volume(), repeats,
                                 [this](const Box3& box) { return labels_.original(box); });
  if (inner_ != 0) give_sides(out, grid_.volume());
  return out;
}

void WindowVisitor::work_on(Index3 window, WindowContent& content, VisitStats& stats) const {
  LabelBox labels;
  SourceSurface source;
  std::optional<DistanceGuard> guard;
  if (max_distance_ && !content.one_label) {
    labels = labels_around(content.mesh);
    guard.emplace(labels, *max_distance_, content.samples);
    if (labels_.has_source()) {
      source = labels_.source(labels.box);
      guard->aim_at(source);
    }
  }
  DistanceGuard* const keep_distance = guard ? &*guard : nullptr;
  Stopwatch watch;
  SimplifyOptions options = simplify_;
  if (target_reduction_) {
    const auto voxels = static_cast<double>(grid_.window_box(window).voxels());
    options.enough_vertices = static_cast<std::size_t>(*target_reduction_ * voxels);
  }
  options.finished = finished_boxes();
  OptimiseOptions polish = optimise_;
  polish.finished = options.finished;
  polish.earlier = earlier_boxes(window);
  polish.later = later_boxes(window);
  if (optimise_.sweeps > 0) {
    stats.optimise.moves += fit_interfaces(content.mesh, metric_, polish, keep_distance);
  }
  watch.lap(stats.optimise_seconds);
  stats.simplify += simplify(content.mesh, metric_, options, keep_distance);
  watch.lap(stats.simplify_seconds);
  stats.optimise += optimise(content.mesh, metric_, polish, keep_distance);
  watch.lap(stats.optimise_seconds);
  if (!triangulate_ && optimise_.demands.inner == nullptr) return;
  if (triangulate_) reconnect(window, content, stats);
  watch.lap(stats.codt_seconds);
  if (optimise_.demands.inner != nullptr) add_inner(window, content, stats);
  OptimiseOptions light = optimise_;
  light.finished = polish.finished;
  light.sweeps = std::min(light.sweeps, 1);
  stats.optimise += optimise(content.mesh, metric_, light, keep_distance);
  watch.lap(stats.optimise_seconds);
}

std::vector<LatticeBox> WindowVisitor::boxes_of(const std::vector<Index3>& windows) const {
  std::vector<LatticeBox> out;
  for (const Index3 window : windows) {
    const Box3 box = grid_.window_box(window);
    out.push_back({lattice_corner(box.lo), lattice_corner(box.hi)});
  }
  return out;
}

std::vector<LatticeBox> WindowVisitor::earlier_boxes(Index3 window) const {
  if (!order_) return {};
  return boxes_of(order_->earlier_neighbours(window));
}

std::vector<LatticeBox> WindowVisitor::later_boxes(Index3 window) const {
  if (!order_) return {};
  return boxes_of(order_->later_neighbours(window));
}

SteinerIds WindowVisitor::ids_of(Index3 window) const {
  return steiner_ids(raster(window, grid_.windows()) * turns_ + turn_,
                     static_cast<std::uint64_t>(grid_.windows().product()) * turns_);
}

void WindowVisitor::add_inner(Index3 window, WindowContent& content, VisitStats& stats) const {
  const InnerOptions options{
      .limits = {.min_ratio = std::max(optimise_.quality_floor, kMinInnerRatio),
                 .sizes = labels_.sizes()},
      .later = later_boxes(window),
      .ids = ids_of(window)};
  stats.inner_vertices +=
      add_inner_vertices(content.mesh, content.samples, lattice_corner(grid_.volume()), metric_,
                         *optimise_.demands.inner, options);
}

void WindowVisitor::reconnect(Index3 window, WindowContent& content, VisitStats& stats) const {
  CodtOptions options = codt_;
  options.ids = ids_of(window);
  stats.codt += codt(content.mesh, content.samples, lattice_corner(grid_.volume()), metric_,
                     options, triangulate_);
}

template <typename Use>
auto WindowVisitor::with_labels(Index3 block, Use use) const {
  const Box3 box = grid_.block_box(block), wide = grown(box, kStartHalo);
  const Box3 place = moved(box, labels_.margin());
  LabelBox original = labels_.original(wide);
  original.box = moved(wide, labels_.margin());
  if (!start_.coarse) return use(StartLabels{.shape = original, .original = original}, place);
  LabelBox shape = labels_.shape(wide);
  shape.box = original.box;
  return use(StartLabels{.shape = shape, .original = original}, place);
}

/// Returns the volume that start meshes are made in: the grid's volume with its margin.
Index3 WindowVisitor::start_volume() const {
  return grid_.volume() + labels_.margin() + labels_.margin();
}

StartOptions WindowVisitor::start_options() const {
  StartOptions out = start_;
  out.templates = &templates_.local();
  return out;
}

StartSize WindowVisitor::start_size(Index3 block) const {
  return with_labels(block, [&](const StartLabels& labels, const Box3& box) {
    return graded_start_size(labels, labels_.levels(), box, start_volume(), start_options());
  });
}

BlockMesh WindowVisitor::start(Index3 block) const {
  BlockMesh mesh = with_labels(block, [&](const StartLabels& labels, const Box3& box) {
    return graded_start(labels, labels_.levels(), box, start_volume(), start_options());
  });
  mesh = without_margin(std::move(mesh), grid_.volume(), labels_.margin());
  mesh.vertices.shrink_to_fit();
  mesh.tets.shrink_to_fit();
  mesh.samples.shrink_to_fit();
  return mesh;
}

}  // namespace mw::engine
