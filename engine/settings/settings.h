// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a user can choose about a run; the result is a function of the volume and of these.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernels/core/error.h"
#include "kernels/core/label.h"
#include "kernels/size/size_field.h"
#include "kernels/topology/kept_topology.h"

namespace mw::engine {

/// The largest window edge, which keeps every tetrahedron within the range of exact arithmetic.
inline constexpr int kMaxWindow = 256;

enum class StartMesh {
  kCoarse,  ///< labels coarsened first, then as kOctree; not with interfaces kept: then kOctree
  kOctree,  ///< larger cells inside labels
  kDense,   ///< the paper's: five tets a voxel
};

/// Which of two windows that share a block comes first; each order has its own result.
enum class Order {
  kRaster,  ///< the paper's (Sec 4.1): narrow on small volumes
  kColour,  ///< eight colours by parity of the window's position
};

/// What interfaces are made to follow.
enum class Surface {
  kSmooth,  ///< smooth surfaces that keep the labels' volumes
  kVoxel,   ///< the quadrics of the paper alone (Sec 5.2)
};

/// What improves tets after each simplification.
enum class Optimizer {
  kLocal,   ///< flips and smoothing
  kTetgen,  ///< in the last march the paper's constrained ODT (Sec 5.5), else as kLocal
  kNone,
};

/// Axes along which a volume repeats itself: bit 0 = x.
using PeriodicAxes = unsigned;

/// How long the edges of a label's tets should be.
struct LabelSize {
  RawLabel label = 0;
  double edge = 0.0;  ///< in the unit of SizeRules

  friend bool operator==(const LabelSize&, const LabelSize&) = default;
};

/// The size that is asked for near the faces between two labels.  No label stands for any label.
struct InterfaceSize {
  std::optional<RawLabel> low;
  std::optional<RawLabel> high;
  double edge = 0.0;  ///< in the unit of SizeRules

  friend bool operator==(const InterfaceSize&, const InterfaceSize&) = default;
};

/// Sizes that edges should have.  Most edges are 0.6 of the size or longer; none is longer than
/// kLongest times the size, and contraction makes none longer than kContracted times the size.
struct SizeRules {
  static constexpr double kContracted = 1.25;
  static constexpr double kLongest = kContracted * SizeField::kStretch;
  /// Tets in a cube whose edges are as long as the size, where one size fills a label.
  static constexpr double kTetsACube = 11;

  std::vector<LabelSize> labels;          ///< each label once, ascending
  std::optional<double> others;           ///< for all labels that are not listed
  std::vector<InterfaceSize> interfaces;  ///< each pair once, ascending; low < high, or both none
  std::string image;                      ///< file with a size for each voxel, or empty
  /// Whether the sizes above are in voxels of the lattice, and not in physical units; those of an
  /// image are always physical.
  bool in_voxels = false;

  [[nodiscard]] bool any() const {
    return !labels.empty() || others.has_value() || !interfaces.empty() || !image.empty();
  }
  /// Returns the smallest of these sizes; infinity when there is only an image.
  [[nodiscard]] double least() const;
  /// Returns the size near faces between two labels: that of the pair, else the smaller of those of
  /// each label and any other, else that of all faces; none if no rule is about them.
  [[nodiscard]] std::optional<double> of_interface(RawLabel a, RawLabel b) const;
  /// Returns the size of a label; none where only what is around it limits its edges.
  [[nodiscard]] std::optional<double> of_label(RawLabel label) const;
  /// Returns the rules with each size that is written here multiplied; an image has its own factor.
  [[nodiscard]] SizeRules scaled(double factor) const;
  /// Returns the rules in physical units, where the edge of a voxel is so long.
  [[nodiscard]] SizeRules in_physical_units(double voxel) const;

  friend bool operator==(const SizeRules&, const SizeRules&) = default;
};

/// Limits on the edges of labels, and of what is around them (kernels/size/size_field.h).
struct SizeSettings {
  SizeRules rules;
  double gradation = 0.3;  ///< how much limits grow with the distance to where they are asked
  /// Whether tets with all corners on interfaces or the box get a vertex inside their label, where
  /// shapes allow it: in labels that have a size, or in all when none is listed.
  bool inner_vertices = false;
  /// How many tets the mesh that is written should have; 0 leaves that to the sizes.  Sizes are
  /// weights then, scaled until the mesh has that many (engine/job/count_pilot.h).
  std::int64_t count = 0;
  /// The least number of edges that lie one behind the other across thin parts of labels, as far as
  /// the voxels allow (kernels/size/thickness.h); 0 asks for none.
  int across = 0;

  /// Returns whether some edge has a limit.
  [[nodiscard]] bool limits_edges() const { return rules.any() || across > 0; }
};

/// Voxels are those of the lattice that the volume is meshed on.  Every field has its entry in
/// setting_table.cpp, where flags, config keys, check() and the identity of a run come from.
struct MeshSettings {
  int window = 32;  ///< window edge in voxels, even
  int marches = 2;  ///< each over the whole volume, with windows twice as large
  Order order = Order::kColour;
  StartMesh start = StartMesh::kCoarse;
  std::optional<double> edge_variance;  ///< bound on Eq (3); empty if unbounded
  /// No tet has a radius ratio below this; 0 asks nothing of shapes, as in the paper.
  double quality_floor = 0.2;
  /// The floor around inner vertices that contractions move (SimplifyOptions::inner_quality).  It
  /// counts only above a quality_floor that is not 0.  If empty, inner_quality_for() chooses it.
  std::optional<double> inner_quality;
  std::optional<double> max_distance = 1.5;  ///< hard bound in voxels, two-sided, or empty
  /// Each window stops collapsing at this many vertices a voxel; if empty, only the bounds stop it.
  std::optional<double> target_reduction;
  KeptTopology topology = KeptTopology::kLabels;
  Surface surface = Surface::kSmooth;
  Optimizer optimizer = Optimizer::kLocal;
  SizeSettings sizes;
  /// Opposite faces of the volume get the same triangles (engine/labels/periodic_labels.h).
  PeriodicAxes periodic = 0;
  int odt_iterations = 10;  ///< at most, in each window, by kTetgen; the paper's number (Sec 6)
};

/// Returns a level: cells of the start mesh have at most 2^level voxels an axis, and blocks begin
/// at multiples of that.
[[nodiscard]] int largest_cell_level(const MeshSettings& settings);

/// ERRORS: mw::Error(kUsage) naming the setting, its value and what is allowed, or the settings
///         that contradict each other.
void check(const MeshSettings& settings);

}  // namespace mw::engine
