// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a good interface costs: distance to the input's faces, area at constant volume, bends,
// needles.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernels/core/label.h"
#include "kernels/distance/distance_guard.h"
#include "kernels/distance/point_triangle.h"
#include "kernels/mesh/tet_mesh.h"
#include "kernels/quality/star_batch.h"
#include "kernels/surface/line_field.h"
#include "kernels/surface/speck.h"
#include "kernels/surface/surface_star.h"
#include "kernels/surface/thin_label.h"

namespace mw {

/// Volume that a vertex leaves between the input's faces and the interface of labels low < high.
struct VolumeDebt {
  Label low = 0;
  Label high = 0;
  double volume = 0.0;  ///< what low lacks and high has too much of, for each triangle there
};

/// The debts that vertices had after their last visit.
class VolumeDebts {
 public:
  void set(LocalVertex v, std::span<const VolumeDebt> debts) {
    if (v >= rows_.size()) rows_.resize(std::size_t{v} + 1, kNone);
    if (rows_[v] == kNone) {
      rows_[v] = static_cast<std::uint32_t>(lists_.size());
      lists_.emplace_back();
    }
    lists_[rows_[v]].assign(debts.begin(), debts.end());
  }
  /// Returns a debt per triangle; 0 at vertices that were not visited.
  [[nodiscard]] double of(LocalVertex v, Label low, Label high) const {
    if (v >= rows_.size() || rows_[v] == kNone) return 0.0;
    for (const VolumeDebt& d : lists_[rows_[v]]) {
      if (d.low == low && d.high == high) return d.volume;
    }
    return 0.0;
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::vector<std::uint32_t> rows_;  ///< row in lists_ of each vertex
  std::vector<std::vector<VolumeDebt>> lists_;
};

/// Weights of the parts of SurfaceEnergy.  Where they come from is in bench/parameters.md,
/// "Constants".
struct SurfaceWeights {
  double fit = 3.0;             ///< between two labels
  double junction_fit = 1.8;    ///< where more labels meet
  double area = 1.0;            ///< beside the fit, voxels squared, between two labels
  double junction_area = 0.01;  ///< beside the fit where more labels meet
  double bend = 8.0;
  double needle = 6.0;
  double speck = 5.0;        ///< of the volume of a part of one to three voxels
  double line = 0.0;         ///< of the distance from a smooth line, in edges of the line
  double line_planes = 0.0;  ///< of a line's distance from the planes of its faces, likewise
  /// The curvature of a vertex makes pressure up to this, 1 / voxel, and beyond it only where the
  /// whole ring bends as much in the same direction, as on a thread.  Where edges are several
  /// voxels long, what is sharper than a ball of a few voxels is otherwise a step and not a shape.
  double max_curvature = 0.5;
  bool with_pressure = true;
  /// Debts add up wherever a label is thin, until they are paid, at the cost of shapes and bends;
  /// otherwise on sheets and threads alone.
  bool keep_thin = false;
};

/// An energy of the interface triangles at a vertex v, as a function of where v is put, that adds
/// to the shape energy of its tets; 0 where v is.
///
/// Fit.  The faces of the input's interfaces that the triangles carry (DistanceGuard) have area s
/// and unit normal e; let n be the unit normal of the nearest triangle at v, r the height of the
/// face's middle above that triangle's plane, and f the weight of v at the foot.  Then
///   Q(x) = sum of w (f n.x - r)^2 with w = max(0, s e.n).
/// Where its gradient is zero, the signed volume between input and output, weighted by the hat
/// function of v, is zero; hat functions add up to 1, so labels keep their volumes.
///
/// Area.  A fit alone leaves spikes and folds, which no face holds, as they are.  Area pulls them
/// straight, and a pressure P counters the pull by as much as the neighbours' curvature asks for,
/// up to v's own.  Together they diffuse curvature, so that balls stay balls of the same volume. On
/// the box there is no area term, because it would turn surfaces perpendicular to the box.
///
/// Debts.  The volume that v and its ring still owed after their last visits (VolumeDebts) is added
/// to what Q asks for, because shapes and bends may hold v back but not its neighbours.  Where all
/// of them owe in the same direction no neighbour can help.  So between two labels bends count
/// 1 / (1 + (8 d)^8) times as much, where d is the mean distance that is owed, in voxels.
///
/// Thin labels.  A sheet of one voxel whose voxels touch along edges is held there, so what is
/// between these places has to be thicker than the sheet, and bends count less at a thin label
/// (thin_label_at()).  Where it is a sheet or a thread, and with keep_thin everywhere, debts are
/// added to those that vertices had before, and bends count still less.  Where a sheet is held in
/// many places area counts more, also where two other labels touch each other across it.
///
/// Specks.  Area, bends and needles of a part of one to three voxels say nothing, and would pull it
/// to nothing.  They are left out where a vertex is between two labels, one of which is a speck.
/// Its voxels tell its volume (SpeckMeasure), which costs S = ((volume - voxels) / voxels)^2 at
/// each of its vertices, and more by as much as it is too small.
///
/// Bends.  The sum of the bend energies (surface_star.h) of spokes and rims.
///
/// Needles.  A triangle whose shape q (4 sqrt(3) area / sum of squared edges, 1 at most) is below
/// 0.56 costs (1/q - 1.8)^2.  Tets beside a needle may be good enough all the same, and what is
/// computed on the surface is not.
///
/// Lines.  Where three labels meet, faces say little of the line's place, which is where three
/// interfaces cut each other, and voxels make it a zigzag.  So a vertex on a line is drawn to where
/// its neighbours on the line would have it (LineField), across the line: L is the squared distance
/// in units of the squared mean edge of the line there.  The line is also drawn to the plane of the
/// faces of each two labels that meet there (plane_of_faces()): F is the sum of the squared
/// distances from these planes, in the same units.
///
/// The whole energy, with E the present shape energy of v's tets and M the sum of w f^2 (or, where
/// few faces are carried, a sixth of the triangles' area), is
///   E (fit/M (Q + area (Area - P.x)) + bend/6 (sum of bend energies) + needle/6 (sum of those of
///   needles) + speck S + line L + line_planes F), less its value at 0.
class SurfaceEnergy {
 public:
  explicit SurfaceEnergy(const SurfaceWeights& weights) : weights_(weights) {}

  /// Computes the energy at the star's vertex.  A null curvature leaves out pressure, and null
  /// debts leave out debts.  Keeps a reference to star.
  /// REQUIRES: spokes and rims were collected if weights.bend > 0.
  void collect(const TetMesh& mesh, const Metric& metric, const SurfaceStar& star,
               const DistanceGuard& guard, const CurvatureField* curvature,
               const VolumeDebts* debts);

  /// Adds the term of lines to what was collected.
  void add_line(const LinePlace& place);
  /// Adds that of the planes of faces at a vertex on a line, with the line's mean edge there.
  void add_line_planes(const Metric& metric, Point at, const LabelBox& labels, double edge);

  /// The energy without the factor E; 0 for x = 0.
  [[nodiscard]] double value_at(const Vec3& x) const { return raw_value_at(x) - present_; }
  /// Adds `scale` times the derivatives; the Hessian is replaced by a positive semidefinite one.
  void add_derivatives(const Vec3& x, double scale, StarTerms& terms) const;

  /// The volumes that v's own faces would still ask of it at x.
  /// The span is valid until the next call.
  [[nodiscard]] std::span<const VolumeDebt> debts_at(const Vec3& x);

  /// True if a part of few voxels is at v.
  [[nodiscard]] bool has_specks() const { return !specks_.empty(); }
  /// The least cosine of a spoke or rim at present; 1 when there is none.
  [[nodiscard]] double min_cosine() const;

 private:
  /// Sums of the fit between two labels.
  struct Balance {
    Label low = 0;
    Label high = 0;
    double triangles = 0.0;
    double before = 0.0;        ///< debt of a thin label that is not forgotten
    double volume = 0.0;        ///< sum of w f r
    Vec3 slope = Vec3::Zero();  ///< sum of w f^2 n
  };

  /// Sums of the fit at a triangle.
  struct TriangleFit {
    double square = 0.0;  ///< sum of w f^2
    double volume = 0.0;  ///< sum of w f r
  };

  /// Corners of four triangles: x, y and z of a and of b; all at v where there is no triangle.
  struct CornerLanes {
    std::array<StoredLanes, 6> places{};
  };

  void gather_corners();
  [[nodiscard]] Balance& balance(Label low, Label high);
  void fit(const Metric& metric, Point origin, const DistanceGuard& guard);
  void add_pieces(const PieceGroup& pieces, std::size_t carrier, const Metric& metric,
                  const Vec3& at);
  void sum_up_fits();
  void find_pressure(const CurvatureField& curvature);
  void take_debts(const VolumeDebts& debts);
  void yield_to(const VolumeDebts& debts);
  bool yield_to_thin(const std::optional<ThinLabel>& thin, bool two_labels);
  void remember(const VolumeDebts& debts);
  [[nodiscard]] std::optional<ThinLabel> find_thin(const TetMesh& mesh, const Metric& metric,
                                                   const LabelBox& labels);
  void add_specks();
  [[nodiscard]] double raw_value_at(const Vec3& x) const;
  [[nodiscard]] double needles() const;
  void add_area(const Vec3& x, double scale, StarTerms& terms) const;
  void add_bends(const Vec3& x, double scale, StarTerms& terms) const;
  void add_needles(const Vec3& x, double scale, StarTerms& terms) const;
  void add_bend(const Vec3& gradient, double cosine, double scale, StarTerms& terms) const;

  SurfaceWeights weights_;
  const SurfaceStar* star_ = nullptr;
  std::vector<Vec3> unit_normals_;  ///< unit normals of the star's triangles
  double mass_ = 0.0;               ///< M; 0 when there is nothing to fit
  double fit_weight_ = 0.0;
  double area_weight_ = 0.0;
  double bend_weight_ = 0.0;                          ///< weight of each spoke and rim
  double needle_weight_ = 0.0;                        ///< weight of each triangle
  Eigen::Matrix3d square_ = Eigen::Matrix3d::Zero();  ///< Q is x.square x - 2 linear.x
  Vec3 linear_ = Vec3::Zero();
  Vec3 pressure_ = Vec3::Zero();
  /// The terms of specks, lines and planes are x.own_square x - 2 own_linear.x.
  Eigen::Matrix3d own_square_ = Eigen::Matrix3d::Zero();
  Vec3 own_linear_ = Vec3::Zero();
  double present_ = 0.0;
  std::vector<TriangleFit> fits_;  ///< one for each of the star's triangles
  std::vector<CornerProducts> products_;
  std::vector<Balance> balances_;
  std::vector<VolumeDebt> debts_;
  SpeckMeasure speck_measure_;
  std::vector<SpeckVolume> specks_;             ///< those at v
  std::vector<CornerLanes> corners_;            ///< corners of the star's triangles
  mutable std::vector<SurfaceNormal> normals_;  ///< scratch; four for each of corners_
  mutable std::vector<double> areas_;           ///< scratch; areas, in the same rows
  mutable std::vector<double> squares_;         ///< scratch; sums of squared edges, likewise
};

}  // namespace mw
