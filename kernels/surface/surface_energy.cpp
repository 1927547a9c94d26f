// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums over the triangles, spokes and rims of a star, in the order in which it has them.
#include "kernels/surface/surface_energy.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <span>

#include "kernels/distance/point_triangle.h"
#include "kernels/surface/faces_plane.h"
#include "kernels/surface/ring_curvature.h"
#include "kernels/surface/surface_star.h"

namespace mw {
namespace {

/// The sums of bends and of needles are divided by the number of spokes of a usual star.
constexpr double kUsualSpokes = 6.0;

/// The least 1/q that costs: that of a triangle with edges of 1, 1 and 0.35 (bench/parameters.md,
/// "Constants").
constexpr double kFreeNeedle = 1.8;

/// How far an interface may be from where its labels have their volumes before bends give way, in
/// smallest edges of a voxel (bench/parameters.md, "Constants").
constexpr double kMostOwed = 0.125;

/// How much terms count between two labels of which one is thin (bench/parameters.md, "Thin
/// labels").
struct ThinShares {
  double area, bend, needle;
};
constexpr ThinShares kAtThin{1.0, 0.6, 1.0}, kAtKept{1.0, 0.25, 1.0}, kAtSheet{1.5, 0.4, 1.0},
    kAtHeld{2.0, 0.3, 1.0}, kAtThread{0.1, 0.1, 1.0}, kAtSpeck{0.0, 0.0, 0.0};

/// How many pairs of labels have triangles at a vertex off the box where two labels touch each
/// other across a third.  Where three labels meet along a line there are three pairs.
constexpr std::size_t kPairsAtTouch = 2;

/// A factor that exceeds the rounding of squared distances.
constexpr double kRoundedUp = 1.0 + 1e-9;

Vec3 unit(const Vec3& normal) {
  const double length = normal.norm();
  return length > 0.0 ? Vec3(normal / length) : Vec3::Zero();
}

/// Gradient of the cosine between a triangle's normal and another direction, when v moves.
/// normal is the triangle's unit normal, length its length before that, and edge goes from a to b.
Vec3 cosine_gradient(const Vec3& normal, double length, const Vec3& edge, const Vec3& other,
                     double cosine) {
  return (other - cosine * normal).cross(edge) / length;
}

/// 1/q of a triangle is this times the sum of its squared edges over its area.
const double kEquilateral = 1.0 / (4.0 * std::sqrt(3.0));

/// Pieces of one carrier in metric units.
struct MetricPieces {
  PointLanes middles;  ///< relative to v
  StoredLanes areas;   ///< s, negative where the normal looks down its axis
  StoredInts axes;     ///< axes of the normals
};

MW_WIDE void to_metric(const PieceGroup& pieces, const Metric& metric, const Vec3& at,
                       MetricPieces& out) {
  const Vec3 voxel = metric.voxel();
  const double volume = voxel.prod();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<int>(i);
    store(load(pieces.middles[i]) * voxel[k] - at[k], out.middles[i]);
  }
  const Lanes area = by_axis(load(pieces.axes), lanes(volume / voxel[0]), lanes(volume / voxel[1]),
                             lanes(volume / voxel[2]));
  constexpr double kEach = 1.0 / kSamplesPerFace;
  store(load(pieces.signs) * (load(pieces.quarters) * kEach * area), out.areas);
  out.axes = pieces.axes;
}

/// What pieces add to the sums of a triangle that their feet are on.
struct InsideFits {
  StoredLanes weights;  ///< w
  StoredLanes squares;  ///< w f^2
  StoredLanes volumes;  ///< w f r
};

/// The triangle's plane goes through v, so that r is the height above it.
MW_WIDE void fit_inside(const MetricPieces& pieces, const StoredLanes& shares, const Vec3& normal,
                        InsideFits& out) {
  const Lanes3 n = lanes(normal);
  const Lanes weight = load(pieces.areas) * by_axis(load(pieces.axes), n.x, n.y, n.z);
  const Lanes share = load(shares);
  // The sum is in the order in which Eigen adds.
  const Lanes height = n.x * load(pieces.middles[0]) +
                       (n.y * load(pieces.middles[1]) + n.z * load(pieces.middles[2]));
  store(weight, out.weights);
  store(weight * share * share, out.squares);
  store(weight * share * height, out.volumes);
}

/// The triangles at v and what is computed of each.
struct KnownTriangles {
  std::span<const SurfaceTriangle> triangles;
  std::span<const Vec3> unit_normals;
  std::span<const CornerProducts> products;
};

/// The rows of the triangles that feet are on, and the weights of v at the feet.
struct NearestFeet {
  std::array<std::int64_t, kLanes> rows;
  StoredLanes at_corner;
};

/// Finds feet of the points whose bits are set in `wanted`: a foot is on the carrier when it is
/// inside, else on the nearest triangle between the same labels.
MW_WIDE void find_nearest(const KnownTriangles& known, std::size_t carrier,
                          const PointLanes& points, unsigned wanted, NearestFeet& out) {
  const Lanes3 p{load(points[0]), load(points[1]), load(points[2])};
  const SurfaceTriangle& own = known.triangles[carrier];
  const FootLanes first = feet_on_triangle(p, own.to_a, own.to_b, known.products[carrier]);
  const LaneMask bits{1, 2, 4, 8};
  const LaneMask searches = ((static_cast<std::int64_t>(wanted) & bits) == bits) & ~first.inside;
  // Lanes that are not searched begin with -1, so that nothing is nearer.
  Lanes least = searches ? first.squared_distance : lanes(-1.0);
  Lanes share = first.at_corner;
  LaneMask rows = LaneMask{} + static_cast<std::int64_t>(carrier);
  for (std::size_t i = 0; any(searches) && i < known.triangles.size(); ++i) {
    const SurfaceTriangle& t = known.triangles[i];
    if (i == carrier || !t.is_between(own.low, own.high)) continue;
    // The triangle is no nearer than its plane, which goes through v.
    const Lanes height = eigen_dot(lanes(known.unit_normals[i]), p);
    if (!any(height * height <= kRoundedUp * least)) continue;
    const FootLanes foot = feet_on_triangle(p, t.to_a, t.to_b, known.products[i]);
    const LaneMask nearer = foot.squared_distance < least;
    least = nearer ? foot.squared_distance : least;
    share = nearer ? foot.at_corner : share;
    rows = nearer ? LaneMask{} + static_cast<std::int64_t>(i) : rows;
  }
  store(share, out.at_corner);
  std::memcpy(out.rows.data(), &rows, sizeof rows);
}

/// Where the measures of four triangles go.
struct FourMeasures {
  SurfaceNormal* normals;  ///< SurfaceTriangle::normal()
  double* areas;
  double* squares;  ///< sums of squared edges
};

/// Measures four triangles.
MW_WIDE void measure(const std::array<StoredLanes, 6>& places, const Vec3& x,
                     const FourMeasures& out) {
  const Lanes3 at = lanes(x);
  const Lanes3 a = Lanes3{load(places[0]), load(places[1]), load(places[2])} - at;
  const Lanes3 b = Lanes3{load(places[3]), load(places[4]), load(places[5])} - at;
  const Lanes3 n = cross(a, b), c = b - a;
  const Lanes square = eigen_dot(n, n), area = 0.5 * root(square);
  const Lanes squares = eigen_dot(a, a) + eigen_dot(b, b) + eigen_dot(c, c);
  // The lanes are transposed, so that a normal and its square lie together.
  const Lanes xy02 = __builtin_shufflevector(n.x, n.y, 0, 4, 2, 6),
              xy13 = __builtin_shufflevector(n.x, n.y, 1, 5, 3, 7),
              zs02 = __builtin_shufflevector(n.z, square, 0, 4, 2, 6),
              zs13 = __builtin_shufflevector(n.z, square, 1, 5, 3, 7);
  const std::array<Lanes, kLanes> rows{__builtin_shufflevector(xy02, zs02, 0, 1, 4, 5),
                                       __builtin_shufflevector(xy13, zs13, 0, 1, 4, 5),
                                       __builtin_shufflevector(xy02, zs02, 2, 3, 6, 7),
                                       __builtin_shufflevector(xy13, zs13, 2, 3, 6, 7)};
  static_assert(sizeof(SurfaceNormal) == sizeof(Lanes));
  for (std::size_t k = 0; k < kLanes; ++k) {
    StoredLanes row;
    store(rows[k], row);
    out.normals[k] = {Vec3(row[0], row[1], row[2]), row[3]};
  }
  std::memcpy(out.areas, &area, sizeof area);
  std::memcpy(out.squares, &squares, sizeof squares);
}

}  // namespace

// More than five parameters: what a vertex is judged by, each kept by another class.
void SurfaceEnergy::collect(const TetMesh& mesh, const Metric& metric, const SurfaceStar& star,
                            const DistanceGuard& guard, const CurvatureField* curvature,
                            const VolumeDebts* debts) {
  star_ = &star;
  square_.setZero();
  linear_.setZero();
  pressure_.setZero();
  own_square_.setZero();
  own_linear_.setZero();
  mass_ = 0.0;
  unit_normals_.clear();
  balances_.clear();
  double area = 0.0;
  for (const SurfaceTriangle& t : star.triangles()) {
    const Vec3 normal = t.normal(Vec3::Zero());
    area += 0.5 * normal.norm();
    unit_normals_.push_back(unit(normal));
    balance(t.low, t.high).triangles += 1.0;
  }
  const LocalVertex v = star.vertex();
  fit(metric, mesh.position(v), guard);
  if (mass_ > 0.0) mass_ = std::max(mass_, area / 6.0);
  const bool on_box = mesh.planes(v) != 0, two_labels = mesh.order(v) == (on_box ? 3 : 2);
  fit_weight_ = two_labels ? weights_.fit : weights_.junction_fit;
  area_weight_ = on_box ? 0.0 : two_labels ? weights_.area : weights_.junction_area;
  bend_weight_ = weights_.bend / kUsualSpokes;
  needle_weight_ = weights_.needle / kUsualSpokes;
  const bool is_kept = yield_to_thin(find_thin(mesh, metric, guard.labels()), two_labels);
  if (curvature != nullptr && area_weight_ > 0.0) find_pressure(*curvature);
  if (debts != nullptr && mass_ > 0.0) {
    take_debts(*debts);
    if (is_kept) remember(*debts);
    if (!is_kept && two_labels) yield_to(*debts);
  }
  add_specks();
  gather_corners();
  present_ = raw_value_at(Vec3::Zero());
}

void SurfaceEnergy::add_specks() {
  // One that has nearly vanished must not outweigh all else.
  constexpr double kLeastShare = 0.1;
  for (const SpeckVolume& speck : specks_) {
    const double weight = weights_.speck / std::clamp(speck.share, kLeastShare, 1.0);
    own_square_ += weight * speck.slope * speck.slope.transpose();
    own_linear_ += weight * (1.0 - speck.share) * speck.slope;
  }
}

void SurfaceEnergy::add_line(const LinePlace& place) {
  const Eigen::Matrix3d across =
      Eigen::Matrix3d::Identity() - place.direction * place.direction.transpose();
  const Eigen::Matrix3d square = weights_.line * place.share / (place.edge * place.edge) * across;
  own_square_ += square;
  own_linear_ += square * place.place;
  present_ = raw_value_at(Vec3::Zero());
}

void SurfaceEnergy::add_line_planes(const Metric& metric, Point at, const LabelBox& labels,
                                    double edge) {
  const double weight = weights_.line_planes / (edge * edge);
  for (const Balance& b : balances_) {
    Vec3 towards_high = Vec3::Zero();
    for (const SurfaceTriangle& t : star_->triangles()) {
      if (t.is_between(b.low, b.high)) towards_high += t.normal(Vec3::Zero());
    }
    const auto plane = plane_of_faces(labels, metric, at, {b.low, b.high}, unit(towards_high));
    if (!plane) continue;
    own_square_ += weight * plane->normal * plane->normal.transpose();
    own_linear_ += weight * plane->height * plane->normal;
  }
  present_ = raw_value_at(Vec3::Zero());
}

void SurfaceEnergy::gather_corners() {
  const std::vector<SurfaceTriangle>& triangles = star_->triangles();
  corners_.assign((triangles.size() + kLanes - 1) / kLanes, {});
  normals_.resize(corners_.size() * kLanes);
  areas_.resize(normals_.size());
  squares_.resize(normals_.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::array<StoredLanes, 6>& places = corners_[i / kLanes].places;
    for (std::size_t k = 0; k < 3; ++k) {
      places[k][i % kLanes] = triangles[i].to_a[static_cast<int>(k)];
      places[3 + k][i % kLanes] = triangles[i].to_b[static_cast<int>(k)];
    }
  }
}

void SurfaceEnergy::fit(const Metric& metric, Point origin, const DistanceGuard& guard) {
  const Vec3 at = metric.vector({}, origin);
  const std::vector<SurfaceTriangle>& triangles = star_->triangles();
  fits_.assign(triangles.size(), {});
  products_.clear();
  for (const SurfaceTriangle& t : triangles) products_.push_back(corner_products(t.to_a, t.to_b));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const SurfaceTriangle& t = triangles[i];
    guard.for_each_group(triangle_key(star_->vertex(), t.a, t.b), t.low,
                         [&](const PieceGroup& pieces) { add_pieces(pieces, i, metric, at); });
  }
  sum_up_fits();
}

/// Most feet are on the carrier, which feet_inside() finds for several pieces at once.
void SurfaceEnergy::add_pieces(const PieceGroup& pieces, std::size_t carrier, const Metric& metric,
                               const Vec3& at) {
  const SurfaceTriangle& own = star_->triangles()[carrier];
  MetricPieces group;
  to_metric(pieces, metric, at, group);
  const FeetInside feet = feet_inside(group.middles, own.to_a, own.to_b);
  TriangleFit& fit_of_own = fits_[carrier];
  InsideFits inside;
  fit_inside(group, feet.at_corner, unit_normals_[carrier], inside);
  const unsigned outside = ((1U << pieces.size) - 1U) & ~feet.points;
  NearestFeet nearest;
  if (outside != 0) {
    find_nearest({star_->triangles(), unit_normals_, products_}, carrier, group.middles, outside,
                 nearest);
  }
  for (std::size_t k = 0; k < pieces.size; ++k) {
    if ((outside >> k & 1U) == 0) {
      if (!(inside.weights[k] > 0.0)) continue;
      fit_of_own.square += inside.squares[k];
      fit_of_own.volume += inside.volumes[k];
      continue;
    }
    const Vec3 p(group.middles[0][k], group.middles[1][k], group.middles[2][k]);
    const auto row = static_cast<std::size_t>(nearest.rows[k]);
    const double share = nearest.at_corner[k];
    const Vec3& n = unit_normals_[row];
    const double weight = group.areas[k] * n[static_cast<int>(pieces.axes[k])];
    if (!(weight > 0.0)) continue;
    // The triangle's plane goes through v, so that r is the height above it.
    fits_[row].square += weight * share * share;
    fits_[row].volume += weight * share * n.dot(p);
  }
}

void SurfaceEnergy::sum_up_fits() {
  for (std::size_t i = 0; i < fits_.size(); ++i) {
    const SurfaceTriangle& t = star_->triangles()[i];
    const Vec3& n = unit_normals_[i];
    square_ += fits_[i].square * n * n.transpose();
    linear_ += fits_[i].volume * n;
    mass_ += fits_[i].square;
    Balance& b = balance(t.low, t.high);
    b.volume += fits_[i].volume;
    b.slope += fits_[i].square * n;
  }
}

SurfaceEnergy::Balance& SurfaceEnergy::balance(Label low, Label high) {
  const auto found = std::find_if(balances_.begin(), balances_.end(),
                                  [&](const Balance& b) { return b.low == low && b.high == high; });
  if (found != balances_.end()) return *found;
  return balances_.emplace_back(Balance{low, high});
}

std::span<const VolumeDebt> SurfaceEnergy::debts_at(const Vec3& x) {
  debts_.clear();
  for (const Balance& b : balances_) {
    debts_.push_back({b.low, b.high, b.before + (b.volume - b.slope.dot(x)) / b.triangles});
  }
  return debts_;
}

/// Sums, over the pairs of labels at v, the ring's curvature times the gradient of the volume.  The
/// curvature counts up to that of v itself: beside the rim of a plate the plate would be pressed
/// thick.
void SurfaceEnergy::find_pressure(const CurvatureField& curvature) {
  const std::vector<SurfaceTriangle>& triangles = star_->triangles();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const SurfaceTriangle& first = triangles[i];
    const auto is_same = [&](const SurfaceTriangle& t) {
      return t.is_between(first.low, first.high);
    };
    const auto end = triangles.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::any_of(triangles.begin(), end, is_same)) continue;
    RingCurvature ring(weights_.max_curvature);
    Vec3 volume_gradient = Vec3::Zero();
    for (const SurfaceTriangle& t : triangles) {
      if (!is_same(t)) continue;
      volume_gradient += t.normal(Vec3::Zero()) / 6.0;
      ring.add(curvature.at(t.a));
      ring.add(curvature.at(t.b));
    }
    const double own = curvature.at(star_->vertex()).value_or(ring.value());
    pressure_ += std::clamp(ring.value(), std::min(own, 0.0), std::max(own, 0.0)) * volume_gradient;
  }
}

/// Adds shares of v's own debts and of the ring's to what v's faces ask of it.
void SurfaceEnergy::take_debts(const VolumeDebts& debts) {
  // The row of these shares is in bench/parameters.md, "Constants".
  constexpr double kShareOfOwn = 0.5, kShareOfRing = 0.9;
  // A vertex of the ring is at two of the triangles, in general.
  constexpr double kEachOfRing = 0.5 * kShareOfRing;
  const std::vector<SurfaceTriangle>& triangles = star_->triangles();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const SurfaceTriangle& t = triangles[i];
    const double volume = kShareOfOwn * debts.of(star_->vertex(), t.low, t.high) +
                          kEachOfRing * debts.of(t.a, t.low, t.high) +
                          kEachOfRing * debts.of(t.b, t.low, t.high);
    linear_ += volume * unit_normals_[i];
  }
}

/// Lowers the weight of bends where the whole star owes in one direction, as on sheets held
/// where their sides touch.  Steps keep their weight, as they owe as much as they are owed.
void SurfaceEnergy::yield_to(const VolumeDebts& debts) {
  double owed = 0.0;
  for (const SurfaceTriangle& t : star_->triangles()) {
    for (const LocalVertex corner : {star_->vertex(), t.a, t.b}) {
      owed += debts.of(corner, t.low, t.high) / 3.0;
    }
  }
  const double share = owed / (mass_ * kMostOwed);
  const double square = share * share;
  bend_weight_ /= 1.0 + square * square * square * square;
}

/// Changes the weights of what would pull a thin label to nothing.  Returns whether debts add up.
bool SurfaceEnergy::yield_to_thin(const std::optional<ThinLabel>& thin, bool two_labels) {
  if (!thin) return false;
  if (two_labels) {
    const ThinShares& shares = thin->is_speck && area_weight_ > 0.0 ? kAtSpeck
                               : thin->is_held                      ? kAtHeld
                               : thin->is_sheet                     ? kAtSheet
                               : thin->is_thread                    ? kAtThread
                               : weights_.keep_thin                 ? kAtKept
                                                                    : kAtThin;
    area_weight_ *= shares.area;
    bend_weight_ *= shares.bend;
    needle_weight_ *= shares.needle;
  } else if (thin->is_held && area_weight_ > 0.0 && balances_.size() == kPairsAtTouch) {
    area_weight_ = kAtHeld.area * weights_.area;
  }
  return thin->is_sheet || thin->is_thread || weights_.keep_thin;
}

/// Returns what is true of any of v's labels that are thin there, and nothing if none is.  Measures
/// specks, where their volumes count.
std::optional<ThinLabel> SurfaceEnergy::find_thin(const TetMesh& mesh, const Metric& metric,
                                                  const LabelBox& labels) {
  specks_.clear();
  std::optional<ThinLabel> out;
  const LocalVertex v = star_->vertex();
  for (auto b = balances_.begin(); b != balances_.end(); ++b) {
    for (const Label label : {b->low, b->high}) {
      const bool is_known = std::any_of(balances_.begin(), b, [label](const Balance& other) {
        return other.low == label || other.high == label;
      });
      if (is_known) continue;
      const std::optional<ThinLabel> thin = thin_label_at(labels, mesh.position(v), label);
      if (!thin) continue;
      if (weights_.speck > 0.0 && (thin->is_speck || thin->is_small)) {
        const auto found = speck_measure_.at(mesh, metric, v, label, labels);
        specks_.insert(specks_.end(), found.begin(), found.end());
      }
      if (!out) out.emplace();
      *out |= *thin;
    }
  }
  return out;
}

/// Keeps what v owed before its visit.
void SurfaceEnergy::remember(const VolumeDebts& debts) {
  for (Balance& b : balances_) b.before = debts.of(star_->vertex(), b.low, b.high);
}

double SurfaceEnergy::min_cosine() const {
  double min = 1.0;
  for (const Spoke& s : star_->spokes()) {
    min = std::min(min, unit_normals_[s.first].dot(unit_normals_[s.second]));
  }
  for (const Rim& r : star_->rims()) {
    min = std::min(min, unit_normals_[r.triangle].dot(r.normal));
  }
  return min;
}

double SurfaceEnergy::raw_value_at(const Vec3& x) const {
  double value = x.dot(own_square_ * x) - 2.0 * own_linear_.dot(x);
  const bool has_area = mass_ > 0.0 && area_weight_ > 0.0, has_bends = weights_.bend > 0.0;
  const bool has_needles = needle_weight_ > 0.0;
  if (has_area || has_bends || has_needles) {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const std::size_t row = i * kLanes;
      measure(corners_[i].places, x, {&normals_[row], &areas_[row], &squares_[row]});
    }
  }
  if (mass_ > 0.0) {
    double fit = x.dot(square_ * x) - 2.0 * linear_.dot(x);
    if (has_area) {
      double area = 0.0;
      for (std::size_t i = 0; i < star_->triangles().size(); ++i) area += areas_[i];
      fit += area_weight_ * (area - pressure_.dot(x));
    }
    value += fit_weight_ / mass_ * fit;
  }
  if (has_bends) value += bend_weight_ * star_->bends(normals_);
  if (has_needles) value += needle_weight_ * needles();
  return value;
}

/// The sum over the triangles that were measured last.
double SurfaceEnergy::needles() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < star_->triangles().size(); ++i) {
    if (kEquilateral * squares_[i] <= kFreeNeedle * areas_[i]) continue;
    const double excess = kEquilateral * squares_[i] / areas_[i] - kFreeNeedle;
    sum += excess * excess;
  }
  return sum;
}

void SurfaceEnergy::add_derivatives(const Vec3& x, double scale, StarTerms& terms) const {
  if (mass_ > 0.0) {
    const double factor = scale * fit_weight_ / mass_;
    terms.gradient += factor * 2.0 * (square_ * x - linear_);
    terms.hessian += factor * 2.0 * square_;
    if (area_weight_ > 0.0) add_area(x, factor * area_weight_, terms);
  }
  terms.gradient += scale * 2.0 * (own_square_ * x - own_linear_);
  terms.hessian += scale * 2.0 * own_square_;
  if (weights_.bend > 0.0) add_bends(x, scale * bend_weight_, terms);
  if (needle_weight_ > 0.0) add_needles(x, scale * needle_weight_, terms);
}

/// The Hessian leaves out the motions within a triangle's plane.
void SurfaceEnergy::add_area(const Vec3& x, double scale, StarTerms& terms) const {
  constexpr double kNarrow = 0.1;
  terms.gradient -= scale * pressure_;
  for (const SurfaceTriangle& t : star_->triangles()) {
    const Vec3 edge = t.to_b - t.to_a;
    const Vec3 normal = t.normal(x);
    const double length = normal.norm(), base = edge.norm();
    if (!(length > 0.0)) continue;
    const Vec3 n = normal / length;
    terms.gradient += 0.5 * scale * n.cross(edge);
    const double height = std::max(length / base, kNarrow * base);
    terms.hessian += 0.5 * scale * base / height * n * n.transpose();
  }
}

void SurfaceEnergy::add_bends(const Vec3& x, double scale, StarTerms& terms) const {
  const std::vector<SurfaceTriangle>& t = star_->triangles();
  const auto edge = [&](std::uint32_t i) { return Vec3(t[i].to_b - t[i].to_a); };
  for (const Spoke& s : star_->spokes()) {
    const Vec3 m = t[s.first].normal(x), n = t[s.second].normal(x);
    const double lm = m.norm(), ln = n.norm();
    if (!(lm > 0.0) || !(ln > 0.0)) continue;
    const Vec3 um = m / lm, un = n / ln;
    const double cosine = um.dot(un);
    if (!(bend_excess(cosine) > 0.0)) continue;
    const Vec3 gradient = cosine_gradient(um, lm, edge(s.first), un, cosine) +
                          cosine_gradient(un, ln, edge(s.second), um, cosine);
    add_bend(gradient, cosine, scale, terms);
  }
  for (const Rim& r : star_->rims()) {
    const Vec3 m = t[r.triangle].normal(x);
    const double length = m.norm();
    if (!(length > 0.0)) continue;
    const Vec3 um = m / length;
    const double cosine = um.dot(r.normal);
    if (!(bend_excess(cosine) > 0.0)) continue;
    add_bend(cosine_gradient(um, length, edge(r.triangle), r.normal, cosine), cosine, scale, terms);
  }
}

/// Adds the derivatives of what needles cost, which are squares, with a Gauss-Newton Hessian.
void SurfaceEnergy::add_needles(const Vec3& x, double scale, StarTerms& terms) const {
  for (const SurfaceTriangle& t : star_->triangles()) {
    const Vec3 a = t.to_a - x, b = t.to_b - x, edge = t.to_b - t.to_a, normal = a.cross(b);
    const double length = normal.norm();
    const double squares = a.squaredNorm() + b.squaredNorm() + edge.squaredNorm();
    if (!(length > 0.0) || 2.0 * kEquilateral * squares <= kFreeNeedle * length) continue;
    const double inverse = 2.0 * kEquilateral * squares / length;
    // The gradients of sum and length are -2 (a + b) and n x edge, with n the unit normal.
    const Vec3 gradient =
        -inverse * (2.0 / squares * (a + b) + normal.cross(edge) / (length * length));
    terms.gradient += 2.0 * scale * (inverse - kFreeNeedle) * gradient;
    terms.hessian += 2.0 * scale * gradient * gradient.transpose();
  }
}

/// Adds the derivatives of a bend's energy, which is a square, with a Gauss-Newton Hessian.
void SurfaceEnergy::add_bend(const Vec3& gradient, double cosine, double scale,
                             StarTerms& terms) const {
  terms.gradient -= 2.0 * scale * bend_excess(cosine) * gradient;
  terms.hessian += 2.0 * scale * gradient * gradient.transpose();
}

}  // namespace mw
