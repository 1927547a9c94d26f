// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The labels that windows work from, made once before the march.
#pragma once

#include <algorithm>

#include "engine/labels/label_counts.h"
#include "engine/labels/label_need.h"
#include "engine/labels/size_image.h"
#include "engine/labels/source_bricks.h"
#include "engine/settings/settings.h"
#include "io/labels/brick_volume.h"
#include "io/labels/label_table.h"
#include "kernels/core/label.h"
#include "kernels/inner/inner_demand.h"
#include "kernels/size/size_field.h"
#include "kernels/start/cells/cell_levels.h"
#include "kernels/start/coarsen/coarsen.h"

namespace mw::engine {

/// Voxels in the middle of thin parts; lengths are those of the metric.
struct ThinParts {
  std::uint64_t voxels = 0;
  std::uint64_t too_thin = 0;  ///< those where voxels allow fewer edges across than are asked for
  double least = 0.0;          ///< the least thickness; 0 without voxels

  void add(double thickness, bool is_too_thin) { add({1, is_too_thin ? 1U : 0U, thickness}); }
  void add(const ThinParts& more) {
    if (more.voxels == 0) return;
    least = voxels == 0 ? more.least : std::min(least, more.least);
    voxels += more.voxels;
    too_thin += more.too_thin;
  }
};

/// The input's labels, the labels that the start mesh takes its shape from, and its large cells.
/// With MeshSettings::periodic the volume has periodic_margin() around the cell that is meshed.
/// Coordinates of boxes then begin at the cell's corner, and boxes may reach into the margin;
/// levels() and counts are those of the volume with its margin.
/// A pure function of the volume and the settings.  Where only some windows are visited, only what
/// these need is prepared, and it is the same as in the whole.
/// Thread safety: const members may be called from many threads.
class PreparedLabels {
 public:
  /// Reads the volume once, drops its buffers, and coarsens it when the start mesh asks for that.
  /// image is that of the settings' SizeRules; temporary files go into `folder`.  The result does
  /// not depend on threads.  ERRORS: what the volume throws; kResource when the temporary file
  /// cannot grow.  Memory while it works: preparation_bytes() a thread; 8 bytes a label stay.
  PreparedLabels(const io::DenseVolume& volume, const MeshSettings& settings, int threads = 1,
                 const std::filesystem::path& folder = io::scratch_folder(),
                 const SizeImage* image = nullptr);

  /// Prepares only what is needed; the counts are then known already (counts_of_part()).
  /// REQUIRES: the volume outlives this.
  PreparedLabels(const io::DenseVolume& volume, const MeshSettings& settings, const LabelNeed& need,
                 int threads = 1, const std::filesystem::path& folder = io::scratch_folder(),
                 const SizeImage* image = nullptr);

  /// Returns the input's labels in a box, which may reach outside the volume: voxels there are
  /// kExterior.  For voxels beyond what is needed the volume is read again: how far the tets of a
  /// window reach out of it has no tight bound.
  [[nodiscard]] LabelBox original(const Box3& box) const;
  /// Returns the labels for start meshes.  REQUIRES: box is a needed block with its kStartHalo.
  [[nodiscard]] LabelBox shape(const Box3& box) const;
  /// True if interfaces are fitted to a source surface; otherwise they are fitted to voxel faces.
  [[nodiscard]] bool has_source() const { return source_.has_value(); }
  /// True if there is a source surface and it lies where the scores of labels are equal.
  [[nodiscard]] bool has_crossings() const { return source_ && source_->form().along_axis; }
  /// Returns the source surface in the part of the box that is in the volume or in copies of it.
  /// REQUIRES: has_source().
  [[nodiscard]] SourceSurface source(const Box3& box) const;
  /// Returns the bricks that windows need; labels of others are read when they are asked for.
  [[nodiscard]] const NeededBricks& needed() const { return needed_; }
  /// Returns the only label that the input has in a brick; none where it has several, or where the
  /// brick is not needed.
  [[nodiscard]] std::optional<Label> only_label(Index3 brick) const {
    return needed_.original.contains(brick) ? original_.uniform_label(brick) : std::nullopt;
  }
  /// Returns the only label that start meshes see in a brick; none where they see several.
  /// REQUIRES: the brick is among needed().shapes.
  [[nodiscard]] std::optional<Label> only_shape(Index3 brick) const {
    return shapes().uniform_label(brick);
  }
  [[nodiscard]] Index3 margin() const { return margin_; }
  [[nodiscard]] bool is_coarse() const { return coarse_.has_value(); }
  [[nodiscard]] const LevelMap& levels() const { return levels_; }
  /// Returns what was counted while the labels were prepared.  REQUIRES: all labels are prepared.
  [[nodiscard]] const LabelCounts& counts() const { return *counts_; }
  /// Returns the limits on edges; null when there are none.
  [[nodiscard]] const SizeField* sizes() const {
    return !sizes_.limits() ? nullptr : around_cell_ ? &*around_cell_ : &sizes_;
  }
  /// Returns these limits for the places of start meshes, which are those of the volume with its
  /// margin.
  [[nodiscard]] const SizeField* start_sizes() const { return sizes_.limits() ? &sizes_ : nullptr; }
  /// Returns what SizeSettings::across found.
  [[nodiscard]] const ThinParts& thin_parts() const { return thin_parts_; }
  /// Returns the labels whose tets should have an inner vertex; null when there are none.
  [[nodiscard]] const InnerDemand* inner() const { return inner_ ? &*inner_ : nullptr; }

 private:
  PreparedLabels(const io::DenseVolume& volume, const MeshSettings& settings,
                 const NeededBricks& bricks, std::optional<LabelCounts> counts, int threads,
                 const std::filesystem::path& folder, const SizeImage* image);

  void find_sizes(const SizeSettings& sizes, const SizeImage* image, int threads);
  void limit_interfaces(const SizeRules& rules, int threads);
  void limit_thin_parts(const SizeSettings& sizes, int threads);
  void limit_by_image(const SizeImage& image, int threads);
  void read_bricks(const io::DenseVolume& volume, int threads);
  void read_tile(const io::DenseVolume& volume, const Box3& tile);
  void find_source(int threads);
  void find_source_in(const Box3& bricks);
  void coarsen_cell(const std::filesystem::path& folder, double max_distance, int threads);
  void coarsen_tiles(io::BrickVolume& shapes, double max_distance, int threads) const;
  void coarsen_tile(io::BrickVolume& shapes, const Box3& bricks, double max_distance) const;
  [[nodiscard]] CoarsenRegion coarsened_part() const;
  /// Returns the shape of the volume without its margin.
  [[nodiscard]] Index3 cell() const { return original_.shape() - margin_ - margin_; }
  [[nodiscard]] std::array<bool, 3> repeats() const {
    return {margin_.x > 0, margin_.y > 0, margin_.z > 0};
  }
  /// Returns the bricks that hold a part of the cell.
  [[nodiscard]] Box3 bricks_of_cell() const {
    return bricks_over({margin_, original_.shape() - margin_});
  }
  [[nodiscard]] Index3 first_like(Index3 cube) const;
  void find_levels(const Box3& cubes, int threads);
  /// True if the cube has one label and sizes allow the largest cell in it.
  [[nodiscard]] bool may_be_large(Index3 cube) const;
  [[nodiscard]] bool all_may_be_large(const Box3& cubes) const;
  [[nodiscard]] const io::BrickVolume& shapes() const { return coarse_ ? *coarse_ : original_; }

  io::DenseVolume volume_;  ///< read again only where not all labels are prepared
  Index3 margin_;
  NeededBricks needed_;
  std::optional<LabelCounts> counts_;
  io::BrickVolume original_;
  std::optional<io::BrickVolume> coarse_;
  std::optional<SourceBricks> source_;
  LevelMap levels_;
  SizeField sizes_;
  std::optional<SizeField> around_cell_;  ///< set where there is a margin
  ThinParts thin_parts_;
  std::optional<InnerDemand> inner_;
};

}  // namespace mw::engine
