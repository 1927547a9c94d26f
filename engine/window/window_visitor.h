// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A visit takes the blocks of a window, runs the kernels on them, and commits new blocks.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <optional>

#include "engine/labels/label_counts.h"
#include "engine/labels/prepared_labels.h"
#include "engine/settings/settings.h"
#include "engine/window/block_store.h"
#include "engine/window/window.h"
#include "engine/window/window_order.h"
#include "io/labels/label_table.h"
#include "kernels/odt/codt.h"
#include "kernels/optimise/optimise.h"
#include "kernels/simplify/simplify.h"
#include "kernels/start/cells/cell_template.h"
#include "kernels/start/graded_start.h"

namespace mw::engine {

/// The radius ratio where interfaces are everywhere (bench/parameters.md, "Constants").
inline constexpr double kInnerQuality = 0.44;
/// The radius ratio where most of a mesh is far from them (bench/parameters.md, "Constants").
inline constexpr double kSparseInnerQuality = 0.38;

/// Returns MeshSettings::inner_quality for a volume that has these faces and no others.  It is a
/// function of the labels alone, so any number of threads and processes gives the same.
///
/// There are about as many vertices far from interfaces as bricks of 16^3 voxels without a face,
/// and a few vertices near interfaces for each hundred faces.  Where the first outnumber the
/// second, fewer of them give a mesh of half the size whose shape is about the same
/// (bench/parameters.md); elsewhere a lower inner quality shows in the mean at once.
[[nodiscard]] double inner_quality_for(const BoundaryFaces& faces);

/// What visits did.  Counts add up to the same sums in any order; times are wall seconds, summed
/// over threads.
struct VisitStats {
  std::uint64_t windows = 0;
  SimplifyStats simplify;
  OptimiseStats optimise;
  CodtStats codt;
  std::uint64_t inner_vertices = 0;  ///< inner vertices added
  double start_seconds = 0.0;
  double simplify_seconds = 0.0;
  double optimise_seconds = 0.0;
  double codt_seconds = 0.0;
  double exchange_seconds = 0.0;  ///< gather and scatter

  VisitStats& operator+=(const VisitStats& other);
};

/// What visits of one march do beyond what every march does.
struct VisitPlan {
  /// Set in the last march, where only shape is left to improve: visits optimise longer and flip
  /// more, smooth fitted interfaces, and add the inner vertices that labels demand.  The order of
  /// its windows tells which vertices an earlier window has seen, which wait for changes, and which
  /// no later window will see: only these get more than one sweep.
  std::optional<WindowOrder> last = std::nullopt;
  /// Set where a march only heals: what the one before kept, where its grid began, and what is near
  /// the planes where the volume ends.  This is the grid of the march before.
  std::optional<WindowGrid> before = std::nullopt;
  /// Which one of several marches is this that make vertices?  Ids are apart by it.
  std::uint64_t turn = 0, turns = 1;
  /// Optional: adds constrained ODT with this triangulation, which many threads may call at once.
  /// Local optimisation stays around it when there is a quality floor: tets of a Delaunay
  /// triangulation are often below one, so patches that are good already come through, and one
  /// sweep more lifts what CODT left.  Without a floor CODT stands alone, as in the paper.
  Triangulate triangulate = {};
  /// Optional: lends threads to the filling of a window's queue.  The result is the same.
  ParallelFor seeding = {};
};

/// Visits windows of one march.  Blocks that were never stored are made from voxels.
/// Where settings have no inner_quality, it is kInnerQuality.
/// REQUIRES: windows are visited in an order that respects predecessors; the references outlive it.
/// Thread safety: windows that share no block may be visited at the same time.
class WindowVisitor {
 public:
  WindowVisitor(const PreparedLabels& labels, const Metric& metric, const MeshSettings& settings,
                const WindowGrid& grid, BlockStore& store, VisitPlan plan = {});

  /// Returns the bound on distances in voxels, which says how far around a window's content a visit
  /// reads labels; without one it reads none.
  [[nodiscard]] std::optional<double> max_distance() const { return max_distance_; }
  /// True if it reads a source surface there as well.
  [[nodiscard]] bool has_source() const { return labels_.has_source(); }
  /// Returns the size of a block that is made from voxels.  Cost: about a hundredth of a visit.
  [[nodiscard]] StartSize start_size(Index3 block) const;
  /// Makes a block from voxels.
  [[nodiscard]] BlockMesh start(Index3 block) const;
  /// Returns what this visit did.
  VisitStats visit(Index3 window) const;

 private:
  void polish(const WindowOrder& order);
  [[nodiscard]] std::vector<LatticeBox> boxes_of(const std::vector<Index3>& windows) const;
  /// Return the boxes of the windows that come before and after this one; none unless this is the
  /// last march with smooth surfaces.
  [[nodiscard]] std::vector<LatticeBox> earlier_boxes(Index3 window) const;
  [[nodiscard]] std::vector<LatticeBox> later_boxes(Index3 window) const;
  [[nodiscard]] bool has_rest(Index3 window) const;
  /// Returns the boxes that the march before has finished, where it did so.
  [[nodiscard]] std::vector<LatticeBox> finished_boxes() const;
  /// Returns the labels that a distance guard needs around a mesh.
  [[nodiscard]] LabelBox labels_around(const TetMesh& mesh) const;
  void work_on(Index3 window, WindowContent& content, VisitStats& stats) const;
  void reconnect(Index3 window, WindowContent& content, VisitStats& stats) const;
  void add_inner(Index3 window, WindowContent& content, VisitStats& stats) const;
  [[nodiscard]] SteinerIds ids_of(Index3 window) const;
  [[nodiscard]] Index3 start_volume() const;
  /// Returns how blocks are made from voxels, with the templates of cells that the calling thread
  /// has made before.
  [[nodiscard]] StartOptions start_options() const;
  /// Returns use(labels around the block, box of the block), both placed in start_volume().
  template <typename Use>
  [[nodiscard]] auto with_labels(Index3 block, Use use) const;

  const PreparedLabels& labels_;
  const WindowGrid& grid_;
  BlockStore& store_;
  Metric metric_;
  BoxPlanes inner_;
  StartOptions start_;
  mutable tbb::enumerable_thread_specific<CellTemplates> templates_;
  SimplifyOptions simplify_;
  OptimiseOptions optimise_;
  CodtOptions codt_;
  std::optional<WindowGrid> before_;
  std::uint64_t turn_, turns_;  ///< see VisitPlan
  Triangulate triangulate_;
  std::optional<WindowOrder> order_;  ///< set in the last march with smooth surfaces
  std::optional<double> max_distance_;
  std::optional<double> target_reduction_;
};

}  // namespace mw::engine
