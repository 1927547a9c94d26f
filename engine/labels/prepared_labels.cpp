// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Passes over bricks: read, find sizes and source surface, coarsen, find large cells.
#include "engine/labels/prepared_labels.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "engine/labels/periodic_labels.h"
#include "engine/labels/reading_tiles.h"
#include "engine/labels/score_crossings.h"
#include "engine/system/crew.h"
#include "kernels/core/index.h"
#include "kernels/size/thickness.h"
#include "kernels/source/crossing.h"
#include "kernels/source/face_graph.h"
#include "kernels/start/carrier_faces.h"
#include "kernels/start/cells/cell.h"
#include "kernels/start/coarsen/coarsen.h"

namespace mw::engine {
namespace {

/// Bricks along an axis of a tile that is coarsened at once; the halo is one brick.
constexpr std::int64_t kBricksPerTile = 4;
/// The most faces of a tile whose source surface is found at once.
constexpr std::size_t kMostSourceFaces = 500'000;
/// The most faces of a tile whose crossings are found at once; each takes some 120 bytes.
constexpr std::size_t kMostCrossings = 200'000;
/// The bricks of a tile whose thin parts are found at once, and how many bricks its halo reaches.
constexpr Index3 kTile{kBricksPerTile, kBricksPerTile, kBricksPerTile};
constexpr std::int64_t kBricksInReach = (kThinHalo + kBrick - 1) / kBrick;

Box3 clipped(const Box3& box, Index3 shape) {
  return intersection(box, {{0, 0, 0}, shape});
}

Index3 scaled(Index3 v, std::int64_t by) {
  return {v.x * by, v.y * by, v.z * by};
}

/// Returns how many tiles along each axis hold these bricks.
Index3 tiles_of(Index3 bricks) {
  const auto along = [](std::int64_t n) { return (n + kBricksPerTile - 1) / kBricksPerTile; };
  return {along(bricks.x), along(bricks.y), along(bricks.z)};
}

bool is_within(const Box3& part, const Box3& whole) {
  return intersection(part, whole) == part;
}

/// Returns these labels in a larger box, whose other voxels are outside the volume: kExterior.
LabelBox padded(const LabelBox& inside, const Box3& box) {
  if (inside.box == box) return inside;
  LabelBox out{box, std::vector<Label>(static_cast<std::size_t>(box.voxels()), kExterior)};
  copy_box<Label>(inside.box, inside.box, inside.labels, box, out.labels);
  return out;
}

/// True when each of the bricks has one label; their labels may differ.
bool all_uniform(const io::BrickVolume& volume, const Box3& bricks) {
  bool uniform = true;
  for_each_index(clipped(bricks, volume.bricks()),
                 [&](Index3 b) { uniform = uniform && volume.uniform_label(b).has_value(); });
  return uniform;
}

bool has_one_label(const io::BrickVolume& volume, const Box3& bricks) {
  const Box3 inside = clipped(bricks, volume.bricks());
  const std::optional<Label> first = volume.uniform_label(inside.lo);
  bool one = first.has_value();
  for_each_index(inside, [&](Index3 b) { one = one && volume.uniform_label(b) == first; });
  return one;
}

/// True when all of the bricks have the same label, and none of them is at the end of the volume.
bool all_one_label(const io::BrickVolume& volume, const Box3& bricks) {
  return is_within(bricks, {{0, 0, 0}, volume.bricks()}) && has_one_label(volume, bricks);
}

/// Returns the longest edge that contraction makes for this size, in lengths of the metric.
double limit_of(double size, const io::DenseVolume& volume) {
  const auto& spacing = volume.info().space.spacing;
  return SizeRules::kContracted / *std::min_element(spacing.begin(), spacing.end()) * size;
}

/// Rounds a limit down to a rung, but not below `least`; a size may be as small as a number can be.
double rung_from(double least, double limit) {
  return std::max(SizeField::rung_below(std::max(limit, least)), least);
}

/// Returns the limits that settings put on edges, in lengths of the metric.
SizeField size_field(const io::DenseVolume& volume, const SizeSettings& sizes) {
  if (!sizes.limits_edges()) return {};
  std::vector<double> limits(volume.table().size(), SizeField::kNoLimit);
  for (Label label = 0; label < limits.size(); ++label) {
    const std::optional<double> size = sizes.rules.of_label(volume.table().raw(label));
    if (size) limits[label] = limit_of(*size, volume);
  }
  return {volume.info().shape, Metric(volume.info().space.spacing), std::move(limits),
          SizeRules::kContracted * sizes.gradation, !sizes.rules.image.empty()};
}

/// Returns by dense label which labels have sizes; all of them if none is listed.
std::vector<bool> labels_with_sizes(const io::LabelTable& table, const SizeRules& rules) {
  std::vector<bool> out(table.size(), rules.labels.empty() || rules.others);
  for (const LabelSize& s : rules.labels) out[table.dense(s.label)] = true;
  return out;
}

std::optional<InnerDemand> inner_demand(const io::LabelTable& table, const SizeSettings& sizes) {
  if (!sizes.inner_vertices) return std::nullopt;
  return InnerDemand(labels_with_sizes(table, sizes.rules));
}

}  // namespace

PreparedLabels::PreparedLabels(const io::DenseVolume& volume, const MeshSettings& settings,
                               int threads, const std::filesystem::path& folder,
                               const SizeImage* image)
    : PreparedLabels(volume, settings, bricks_of(volume.info().shape),
                     LabelCounts(volume.info().shape, volume.table().size()), threads, folder,
                     image) {}

// More than five parameters: each is an object of another room, and no other function takes them.
PreparedLabels::PreparedLabels(const io::DenseVolume& volume, const MeshSettings& settings,
                               const LabelNeed& need, int threads,
                               const std::filesystem::path& folder, const SizeImage* image)
    : PreparedLabels(volume, settings, bricks_of(need, volume.info().shape, settings), std::nullopt,
                     threads, folder, image) {}

// More than five parameters: see above, and what the two constructors have found out.
PreparedLabels::PreparedLabels(const io::DenseVolume& volume, const MeshSettings& settings,
                               const NeededBricks& bricks, std::optional<LabelCounts> counts,
                               int threads, const std::filesystem::path& folder,
                               const SizeImage* image)
    : volume_(volume),
      margin_(periodic_margin(settings)),
      needed_(bricks),
      counts_(std::move(counts)),
      original_(volume.info().shape, volume.table().size(), folder, bricks.original),
      sizes_(size_field(volume, settings.sizes)),
      inner_(inner_demand(volume.table(), settings.sizes)) {
  read_bricks(volume, threads);
  volume.raw().drop_buffers();  // it is read again only if a visit looks beyond needed bricks
  if (sizes_.limits()) find_sizes(settings.sizes, image, threads);
  const bool has_scores = volume.raw().scores() != nullptr;
  if (wants_source(settings, has_scores)) {
    source_.emplace(original_.bricks(), folder,
                    has_scores ? crossing_form(score_layers(volume)) : kFilteredForm);
    find_source(threads);
    volume.raw().drop_buffers();
  }
  if (is_coarsened(settings)) {
    coarse_.emplace(original_.shape(), volume.table().size(), folder, bricks.shapes);
    coarsen_cell(folder, settings.max_distance.value_or(kMaxCoarseDistance), threads);
  }
  if (settings.start != StartMesh::kDense) find_levels(bricks.levels, threads);
}

/// Adds the limits that do not come from labels, then spreads all limits.
void PreparedLabels::find_sizes(const SizeSettings& sizes, const SizeImage* image, int threads) {
  if (!sizes.rules.interfaces.empty()) limit_interfaces(sizes.rules, threads);
  if (image != nullptr) limit_by_image(*image, threads);
  if (sizes.across > 0) {
    limit_thin_parts(sizes, threads);
    sizes_.allow_no_stretch();
  }
  if (margin_ != Index3{}) sizes_.repeat_cell(cell(), margin_);
  sizes_.spread();
  if (margin_ != Index3{}) around_cell_ = sizes_.around_cell(cell(), margin_);
}

/// Limits the voxels on both sides of the interfaces' faces.
void PreparedLabels::limit_interfaces(const SizeRules& rules, int threads) {
  const io::LabelTable& table = volume_.table();
  tbb_for_each_index(threads, original_.bricks(), [&](Index3 brick) {
    const Box3 box = original_.box_of(brick);
    const LabelBox labels = read_labels(original_, grown(box, 1));
    for_each_index(box, [&](Index3 v) {
      const Label label = labels.at(v);
      for (unsigned side = 0; side < 6; ++side) {
        const Index3 step = axis_vector(side / 2);
        const Label beside = labels.at(side % 2 == 0 ? v + step : v - step);
        if (beside == label || beside == kExterior) continue;
        const std::optional<double> size = rules.of_interface(table.raw(label), table.raw(beside));
        if (size) sizes_.limit_voxel(v, limit_of(*size, volume_));
      }
    });
  });
}

/// A limit below what the voxels allow is raised to that.
void PreparedLabels::limit_by_image(const SizeImage& image, int threads) {
  const Metric metric(volume_.info().space.spacing);
  const double least = metric.voxel().norm();
  tbb_for_each_index(threads, original_.bricks(), [&](Index3 brick) {
    const Box3 box = intersection(original_.box_of(brick), {margin_, margin_ + cell()});
    if (is_empty(box)) return;
    const std::vector<double> sizes = image.read({box.lo - margin_, box.hi - margin_}, cell());
    std::size_t i = 0;
    for_each_index(box, [&](Index3 v) {
      const double limit = limit_of(sizes[i++], volume_);
      if (limit == SizeField::kNoLimit) return;
      sizes_.limit_voxel(v, std::max(limit, least));
    });
  });
}

/// No edge in the middle of a thin part is longer than its share of the thickness.
void PreparedLabels::limit_thin_parts(const SizeSettings& sizes, int threads) {
  const std::vector<bool> wanted = labels_with_sizes(volume_.table(), sizes.rules);
  const Metric metric(volume_.info().space.spacing);
  const Box3 inner{margin_, margin_ + cell()};
  const double least = metric.voxel().norm();
  const Index3 bricks = original_.bricks();
  std::mutex adding_up;
  tbb_for_each_index(threads, cells_of({{0, 0, 0}, bricks}, kTile).shape(), [&](Index3 t) {
    const Index3 lo{t.x * kTile.x, t.y * kTile.y, t.z * kTile.z};
    const Box3 tile = intersection({lo, lo + kTile}, {{0, 0, 0}, bricks});
    if (all_one_label(original_, grown(tile, kBricksInReach))) return;
    const Box3 voxels =
        clipped({scaled(tile.lo, kBrick), scaled(tile.hi, kBrick)}, original_.shape());
    const LabelBox labels = read_labels(original_, grown(voxels, kThinHalo));
    ThinParts parts;
    for_each_thin_voxel(labels, voxels, metric, [&](Index3 v, double thickness) {
      if (!wanted[labels.at(v)] || !inner.contains(v)) return;
      const double limit = thickness / sizes.across;
      parts.add(thickness, limit < least);
      sizes_.limit_voxel(v, rung_from(least, limit));
    });
    const std::lock_guard turn(adding_up);
    thin_parts_.add(parts);
  });
}

LabelBox PreparedLabels::original(const Box3& box) const {
  const Box3 place{box.lo + margin_, box.hi + margin_};
  const Box3 inside = clipped(place, original_.shape());
  const bool is_held = is_empty(inside) || is_within(bricks_over(inside), original_.held());
  LabelBox out =
      is_held ? read_labels(original_, place) : padded(read_labels(volume_, inside), place);
  out.box = box;
  return out;
}

LabelBox PreparedLabels::shape(const Box3& box) const {
  LabelBox out = read_labels(shapes(), {box.lo + margin_, box.hi + margin_});
  out.box = box;
  return out;
}

void PreparedLabels::read_bricks(const io::DenseVolume& volume, int threads) {
  const Box3 voxels =
      clipped({scaled(original_.held().lo, kBrick), scaled(original_.held().hi, kBrick)},
              original_.shape());
  if (is_empty(voxels)) return;
  const ReadingTiles tiles(volume.info());
  const Box3 over = tiles.over(voxels);
  tbb_for_each_index(threads, over.shape(), [&](Index3 i) {
    read_tile(volume, intersection(tiles.box(over.lo + i), voxels));
  });
}

void PreparedLabels::read_tile(const io::DenseVolume& volume, const Box3& tile) {
  const LabelBox labels = read_labels(volume, tile);
  for_each_brick(labels, [&](Index3 brick, const Box3& box, std::span<const Label> voxels) {
    original_.write(brick, voxels);
    if (counts_) counts_->count(brick, voxels, original_.uniform_label(brick));
    if (sizes_.limits()) sizes_.add(box, voxels);
  });
}

SourceSurface PreparedLabels::source(const Box3& box) const {
  if (margin_ == Index3{}) return source_->read(clipped(box, original_.shape()));
  return {box,
          [&](auto visit) {
            each_copy(box, cell(), repeats(), [&](const Box3& part, Index3 by) {
              const Index3 to_volume = margin_ - by;
              const Box3 here{part.lo + to_volume, part.hi + to_volume};
              SourceSurface::Part faces = source_->read(here).part(here);
              faces.box = part;
              visit(faces);
            });
          },
          source_->form()};
}

void PreparedLabels::find_source(int threads) {
  const Box3 bricks = bricks_of_cell();
  tbb_for_each_index(threads, tiles_of(bricks.shape()), [&](Index3 t) {
    const Index3 lo = bricks.lo + scaled(t, kBricksPerTile);
    find_source_in(intersection({lo, lo + scaled({1, 1, 1}, kBricksPerTile)}, bricks));
  });
}

/// Takes bricks one by one when all have too many faces for the memory that is planned.
void PreparedLabels::find_source_in(const Box3& bricks) {
  if (has_one_label(original_, grown(bricks, 1))) return;
  const bool crosses = has_crossings();
  const Box3 tile =
      clipped({scaled(bricks.lo, kBrick), scaled(bricks.hi, kBrick)}, original_.shape());
  const LabelBox labels = read_labels(original_, grown(tile, crosses ? 1 : kSourceHalo));
  const auto most = crosses ? kMostCrossings : kMostSourceFaces;
  if (bricks.voxels() > 1 && FaceGraph::count(labels) > most) {
    for_each_index(bricks, [&](Index3 b) { find_source_in({b, b + Index3{1, 1, 1}}); });
    return;
  }
  const SourceSurface surface =
      crosses ? score_crossings(volume_, labels, tile) : SourceSurface(labels, tile);
  for_each_index(bricks, [&](Index3 b) { source_->write(b, surface, original_.box_of(b)); });
}

/// Copies around a cell get the coarsened labels of the cell.
void PreparedLabels::coarsen_cell(const std::filesystem::path& folder, double max_distance,
                                  int threads) {
  if (margin_ == Index3{}) return coarsen_tiles(*coarse_, max_distance, threads);
  io::BrickVolume of_cell(cell(), volume_.table().size(), folder);
  coarsen_tiles(of_cell, max_distance, threads);
  tbb_for_each_index(threads, coarse_->bricks(), [&](Index3 brick) {
    const Box3 box = coarse_->box_of(brick);
    const LabelBox labels =
        repeated_labels({box.lo - margin_, box.hi - margin_}, cell(), repeats(),
                        [&](const Box3& part) { return read_labels(of_cell, part); });
    coarse_->write(brick, labels.labels);
  });
}

/// Returns where cubes may be coarsened: in the volume, or, of a cell, where a visit of a cube does
/// not look through a face at which the cell repeats itself.
///
/// No label of a copy decides on such a cube then, nor on any cube that is looked at before it.  So
/// coarsened labels come from the cell's by changes that are allowed in the cell alone, as one
/// whose faces end at the exterior, and in the same way on the torus: both keep the topology of
/// labels and the bound on distances.  Cubes at those faces stay as they are, and so do the lines
/// of labels in them, which the first march keeps; flat interfaces stay, so that they have no steps
/// beside these.
CoarsenRegion PreparedLabels::coarsened_part() const {
  const auto off = [](std::int64_t margin) { return margin > 0 ? kCoarsenReach : 0; };
  const Index3 kept = margin_ + Index3{off(margin_.x), off(margin_.y), off(margin_.z)};
  return {.within = {kept, original_.shape() - kept}, .keeps_flat = margin_ != Index3{}};
}

void PreparedLabels::coarsen_tiles(io::BrickVolume& shapes, double max_distance,
                                   int threads) const {
  const Box3& bricks = shapes.held();
  tbb_for_each_index(threads, tiles_of(bricks.shape()), [&](Index3 t) {
    const Index3 lo = bricks.lo + scaled(t, kBricksPerTile);
    coarsen_tile(shapes, intersection({lo, lo + scaled({1, 1, 1}, kBricksPerTile)}, bricks),
                 max_distance);
  });
}

/// The bricks are those of the volume without its margin.
void PreparedLabels::coarsen_tile(io::BrickVolume& shapes, const Box3& bricks,
                                  double max_distance) const {
  const Index3 first{margin_.x / kBrick, margin_.y / kBrick, margin_.z / kBrick};
  std::vector<Label> one;
  if (all_uniform(original_, grown({bricks.lo + first, bricks.hi + first}, 1))) {
    for_each_index(bricks, [&](Index3 b) {
      one.assign(static_cast<std::size_t>(shapes.box_of(b).voxels()),
                 original_.uniform_label(b + first).value());
      shapes.write(b, one);
    });
    return;
  }
  const auto place = [&](const Box3& box) { return Box3{box.lo + margin_, box.hi + margin_}; };
  const Box3 tile =
      place(clipped({scaled(bricks.lo, kBrick), scaled(bricks.hi, kBrick)}, shapes.shape()));
  const LabelBox before = read_labels(original_, grown(tile, kCoarsenHalo));
  LabelBox after = before;
  coarsen(before, after, tile, coarsened_part(), max_distance, start_sizes());
  for_each_index(bricks, [&](Index3 brick) {
    cut_brick(after, place(shapes.box_of(brick)), one);
    shapes.write(brick, one);
  });
}

bool PreparedLabels::may_be_large(Index3 cube) const {
  const std::optional<Label> label = shapes().uniform_label(cube);
  return label && sizes_.allows_cell(scaled(cube, kBrick), 4, *label);
}

bool PreparedLabels::all_may_be_large(const Box3& cubes) const {
  bool all = true;
  for_each_index(cubes, [&](Index3 c) { all = all && may_be_large(c); });
  return all;
}

/// Returns the cube of the cell that a cube around the cell repeats; the cube itself where it is in
/// the cell, or where copies of the cell do not consist of whole cubes with the same limits.
/// No cell of the start mesh depends on the cubes at the end of the margin, which differ from those
/// that they repeat.
Index3 PreparedLabels::first_like(Index3 cube) const {
  Index3 out = cube;
  const auto wrap = [](std::int64_t c, std::int64_t margin, std::int64_t cell) {
    const std::int64_t first = margin / kBrick, cubes = cell / kBrick;
    return first + ((c - first) % cubes + cubes) % cubes;
  };
  const Index3 size = cell();
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (!repeats()[axis]) continue;
    if (along(size, axis) % kBrick != 0 || sizes_.limits()) return cube;
    std::int64_t& place = axis == 0 ? out.x : axis == 1 ? out.y : out.z;
    place = wrap(along(cube, axis), along(margin_, axis), along(size, axis));
  }
  return out;
}

void PreparedLabels::find_levels(const Box3& cubes, int threads) {
  const Index3 volume = original_.shape();
  levels_ = LevelMap(volume, cubes);
  const auto is_whole = [&](Index3 cube) {
    return shapes().box_of(cube).voxels() == kBrick * kBrick * kBrick;
  };
  const auto repeats_another = [&](Index3 cube) {
    const Index3 first = first_like(cube);
    return first != cube && cubes.contains(first);
  };
  tbb_for_each_index(threads, cubes.shape(), [&](Index3 i) {
    const Index3 cube = cubes.lo + i;
    if (repeats_another(cube)) return;
    const Box3 around = clipped(grown({cube, cube + Index3{1, 1, 1}}, 1), levels_.cubes());
    if (is_whole(around.lo) && is_whole(around.hi - Index3{1, 1, 1}) && all_may_be_large(around)) {
      levels_.set_eighths(cube, 0xff);
      return;
    }
    const Box3 box{scaled(cube, kBrick), scaled(cube + Index3{1, 1, 1}, kBrick)};
    const LabelBox labels = read_labels(shapes(), grown(box, LevelMap::kHalo));
    levels_.set_eighths(cube, LevelMap::allowed_eighths(labels, volume, cube, start_sizes()));
  });
  for_each_index(cubes, [&](Index3 cube) {
    if (!repeats_another(cube)) return;
    levels_.set_eighths(cube, static_cast<std::uint8_t>(levels_.bits_of(first_like(cube))));
  });
  levels_.find_cubes([&](Index3 cube) { return is_whole(cube) && may_be_large(cube); });
}

}  // namespace mw::engine
