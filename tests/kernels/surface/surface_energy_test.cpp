// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The energy of interfaces: derivatives by differences, and where it is least.
#include "kernels/surface/surface_energy.h"

#include <Eigen/Eigenvalues>
#include <map>

#include "kernels/simplify/simplify.h"
#include "kernels/surface/thin_label.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

constexpr double kBound = 1.5;
constexpr SurfaceWeights kFitAlone{
    .area = 0.0, .junction_area = 0.0, .bend = 0.0, .needle = 0.0, .speck = 0.0};
constexpr SurfaceWeights kBendsAlone{
    .fit = 0.0, .junction_fit = 0.0, .area = 0.0, .bend = 4.5, .needle = 0.0, .speck = 0.0};
constexpr SurfaceWeights kNeedlesAlone{
    .fit = 0.0, .junction_fit = 0.0, .area = 0.0, .bend = 0.0, .needle = 3.0, .speck = 0.0};

Vec3 random_offset(std::mt19937& random) {
  const auto step = [&] { return 0.001 * (static_cast<double>(below(random, 401)) - 200.0); };
  const double x = step(), y = step();
  return {x, y, step()};
}

StarTerms derivatives(SurfaceEnergy& energy, const Vec3& x, double scale = 1.0) {
  StarTerms terms;
  energy.add_derivatives(x, scale, terms);
  return terms;
}

Vec3 gradient_by_differences(const SurfaceEnergy& energy, const Vec3& x) {
  constexpr double kStep = 1e-5;
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    const Vec3 step = kStep * Vec3::Unit(i);
    out[i] = (energy.value_at(x + step) - energy.value_at(x - step)) / (2.0 * kStep);
  }
  return out;
}

void expect_derivatives(SurfaceEnergy& energy, const Vec3& x) {
  const StarTerms terms = derivatives(energy, x);
  const Vec3 expected = gradient_by_differences(energy, x);
  const double size = 1.0 + expected.norm() + std::abs(energy.value_at(x));
  EXPECT_NEAR((terms.gradient - expected).norm(), 0.0, 1e-5 * size);
  EXPECT_NEAR((terms.hessian - terms.hessian.transpose()).norm(), 0.0,
              1e-12 * terms.hessian.norm());
  const Vec3 eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(terms.hessian).eigenvalues();
  EXPECT_GE(eigenvalues[0], -1e-9 * (1.0 + eigenvalues[2]));
  const StarTerms twice = derivatives(energy, x, 2.0);
  EXPECT_NEAR((twice.gradient - 2.0 * terms.gradient).norm(), 0.0, 1e-9 * size);
  EXPECT_NEAR((twice.hessian - 2.0 * terms.hessian).norm(), 0.0, 1e-9 * terms.hessian.norm());
}

/// Triangles of some size only: next to a flat one differences say little.
bool is_regular(const SurfaceStar& star, const Vec3& x) {
  return std::all_of(star.triangles().begin(), star.triangles().end(),
                     [&](const SurfaceTriangle& t) { return t.normal(x).norm() > 0.05; });
}

/// Calls visit(mesh, metric, guard, star) at interface vertices of random meshes, some simplified.
template <typename Visit>
void each_random_star(unsigned seed, Visit visit) {
  std::mt19937 random(seed);
  for (std::uint32_t i = 0; i < 40 && !::testing::Test::HasFailure(); ++i) {
    const Metric metric = i % 3 == 0 ? Metric({1.0, 2.0, 1.5}) : Metric();
    const auto kind = i % 4 == 0 ? VolumeKind::kNoise : VolumeKind::kBlobs;
    const SmallVolume volume = random_volume_of(random, kind, {6, 5, 6}, 2 + below(random, 3));
    GuardedMesh guarded(volume, kBound);
    if (i % 2 == 0) simplify(guarded.mesh, metric, {.quality_floor = 0.05}, &guarded.guard);
    disturb(guarded.mesh, random);
    SurfaceStar star;
    for (LocalVertex v = 0; v < guarded.mesh.vertex_count(); ++v) {
      if (!guarded.mesh.is_alive(v) || !guarded.mesh.on_interface(v)) continue;
      star.collect(guarded.mesh, metric, v);
      star.collect_rims(guarded.mesh, metric);
      visit(guarded.mesh, metric, guarded.guard, star);
    }
  }
}

/// Debts of all vertices, any up to a hundred times `unit`.
VolumeDebts random_debts(const TetMesh& mesh, std::mt19937& random, double unit = 0.001) {
  VolumeDebts out;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    out.set(v, std::array{VolumeDebt{0, 1, unit * below(random, 100)},
                          VolumeDebt{0, 2, -unit * below(random, 100)}});
  }
  return out;
}

/// The star's vertex owes `own`, all others `ring`.
VolumeDebts debts_of(const TetMesh& mesh, const SurfaceStar& star, double own, double ring) {
  const SurfaceTriangle& t = star.triangles().front();
  VolumeDebts out;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    out.set(v, std::array{VolumeDebt{t.low, t.high, v == star.vertex() ? own : ring}});
  }
  return out;
}

TEST(SurfaceEnergy, HasItsDerivatives) {
  std::mt19937 random(1141);
  int checked = 0, bent = 0;
  each_random_star(1142, [&](const TetMesh& mesh, const Metric& metric, const DistanceGuard& guard,
                             const SurfaceStar& star) {
    const Vec3 x = below(random, 4) == 0 ? Vec3::Zero() : random_offset(random);
    if (below(random, 4) != 0 || !is_regular(star, x)) return;
    CurvatureField curvature;
    curvature.measure(mesh, metric);
    const VolumeDebts debts = random_debts(mesh, random);
    const SurfaceWeights no_bends{.bend = 0.0};
    const SurfaceWeights with_lines{.line = 3.0, .line_planes = 2.0};
    for (const SurfaceWeights& weights :
         {no_bends, kFitAlone, kBendsAlone, kNeedlesAlone, with_lines}) {
      SurfaceEnergy energy(weights);
      energy.collect(mesh, metric, star, guard, &curvature, &debts);
      EXPECT_EQ(energy.value_at(Vec3::Zero()), 0.0);
      expect_derivatives(energy, x);
      energy.collect(mesh, metric, star, guard, nullptr, nullptr);
      EXPECT_EQ(energy.value_at(Vec3::Zero()), 0.0);
      expect_derivatives(energy, x);
      energy.add_line({random_offset(random), random_offset(random).normalized(), 0.7});
      energy.add_line_planes(metric, mesh.position(star.vertex()), guard.labels(), 0.7);
      EXPECT_EQ(energy.value_at(Vec3::Zero()), 0.0);
      expect_derivatives(energy, x);
    }
    ++checked;
    bent += star.bends_at(x) > 0.01 ? 1 : 0;
  });
  EXPECT_GT(checked, 200);
  EXPECT_GT(bent, 100);
}

/// A square's Hessian is what it is.
TEST(SurfaceEnergy, HasTheHessianOfTheFit) {
  std::mt19937 random(1143);
  each_random_star(1144, [&](const TetMesh& mesh, const Metric& metric, const DistanceGuard& guard,
                             const SurfaceStar& star) {
    SurfaceEnergy energy(kFitAlone);
    energy.collect(mesh, metric, star, guard, nullptr, nullptr);
    const Vec3 x = random_offset(random), y = random_offset(random);
    const StarTerms at_x = derivatives(energy, x), at_y = derivatives(energy, y);
    EXPECT_NEAR((at_y.gradient - at_x.gradient - at_x.hessian * (y - x)).norm(), 0.0, 1e-9);
  });
}

/// How much area and bends count at a vertex.
struct Shares {
  double area = 1.0;
  double bend = 1.0;
};

/// Less or more between two labels of which one is thin there.
Shares shares_at(const TetMesh& mesh, const DistanceGuard& guard, const SurfaceStar& star) {
  const LocalVertex v = star.vertex();
  if (mesh.order(v) != (mesh.planes(v) != 0 ? 3 : 2)) return {};
  std::optional<ThinLabel> thin;
  for (const SurfaceTriangle& t : star.triangles()) {
    for (const Label label : {t.low, t.high}) {
      const auto found = thin_label_at(guard.labels(), mesh.position(v), label);
      if (found) thin = thin.value_or(ThinLabel{}) |= *found;
    }
  }
  if (!thin) return {};
  if (thin->is_sheet) return {.area = thin->is_held ? 2.0 : 1.5, .bend = thin->is_held ? 0.3 : 0.4};
  if (thin->is_thread) return {.area = 0.1, .bend = 0.1};
  return {.bend = 0.6};
}

TEST(SurfaceEnergy, OfBendsAloneIsTheirSumAndLessAtThinLabels) {
  std::mt19937 random(1145);
  std::map<double, int> found;
  each_random_star(1146, [&](const TetMesh& mesh, const Metric& metric, const DistanceGuard& guard,
                             const SurfaceStar& star) {
    SurfaceEnergy energy(kBendsAlone);
    energy.collect(mesh, metric, star, guard, nullptr, nullptr);
    const Vec3 x = random_offset(random);
    const double share = shares_at(mesh, guard, star).bend, weight = share * 4.5 / 6.0;
    EXPECT_NEAR(energy.value_at(x), weight * (star.bends_at(x) - star.bends_at(Vec3::Zero())),
                1e-9);
    ++found[share];
    double min = 1.0;
    for (const InterfaceEdge& e : interface_edges(interface_triangles(mesh))) {
      const LocalVertex v = star.vertex();
      if (!e.triangles[0].has(v) && !e.triangles[1].has(v)) continue;
      min = std::min(min, cosine_between(e.triangles[0].normal(mesh, metric),
                                         e.triangles[1].normal(mesh, metric)));
    }
    EXPECT_NEAR(energy.min_cosine(), min, 1e-9);
  });
  EXPECT_GT(found[0.6], 100);
  EXPECT_GT(found[0.4] + found[0.3] + found[0.1], 10);
}

TEST(SurfaceEnergy, OfNeedlesAloneIsThatOfTheirShapes) {
  std::mt19937 random(1147);
  int needles = 0;
  each_random_star(1148, [&](const TetMesh& mesh, const Metric& metric, const DistanceGuard& guard,
                             const SurfaceStar& star) {
    SurfaceEnergy energy(kNeedlesAlone);
    energy.collect(mesh, metric, star, guard, nullptr, nullptr);
    const Vec3 x = random_offset(random);
    if (!is_regular(star, x)) return;
    const auto cost_at = [&](const Vec3& at) {
      double sum = 0.0;
      for (const SurfaceTriangle& t : star.triangles()) {
        const std::array<Vec3, 3> corners{at, t.to_a, t.to_b};
        double squares = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
          squares += (corners[(i + 1) % 3] - corners[i]).squaredNorm();
        }
        const double area = 0.5 * (t.to_a - at).cross(t.to_b - at).norm();
        const double excess = squares / (4.0 * std::sqrt(3.0) * area) - 1.8;
        if (excess > 0.0) sum += excess * excess;
      }
      return sum;
    };
    const double expected = 3.0 / 6.0 * (cost_at(x) - cost_at(Vec3::Zero()));
    EXPECT_NEAR(energy.value_at(x), expected, 1e-9 * (1.0 + cost_at(x)));
    needles += cost_at(x) > 0.0 ? 1 : 0;
  });
  EXPECT_GT(needles, 100);
}

/// Gradient at 0 of the energy without bends.
Vec3 slope(const SurfaceWeights& weights, const TetMesh& mesh, const Metric& metric,
           const DistanceGuard& guard, const SurfaceStar& star,
           const CurvatureField* curvature = nullptr, const VolumeDebts* debts = nullptr) {
  SurfaceEnergy energy(weights);
  energy.collect(mesh, metric, star, guard, curvature, debts);
  return derivatives(energy, Vec3::Zero()).gradient;
}

/// The slope of the area of the star's triangles, by differences.
Vec3 area_slope(const SurfaceStar& star) {
  constexpr double kStep = 1e-5;
  Vec3 out = Vec3::Zero();
  for (const SurfaceTriangle& t : star.triangles()) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 step = kStep * Vec3::Unit(i);
      out[i] += 0.5 * (t.normal(step).norm() - t.normal(-step).norm()) / (2.0 * kStep);
    }
  }
  return out;
}

/// The curvature of a ring between two labels: the mean of values cut at 0.5; where all are beyond
/// that and of one sign, the nearest to 0; and where those of two vertices are, which are there
/// twice, and none is beyond 0.3 of the other sign, the lesser of the two that are farthest from 0.
double ring_curvature(const SurfaceStar& star, const CurvatureField& field) {
  std::vector<double> known;
  double sum = 0.0;
  for (const SurfaceTriangle& t : star.triangles()) {
    for (const LocalVertex w : {t.a, t.b}) {
      if (!field.at(w)) continue;
      known.push_back(*field.at(w));
      sum += std::clamp(known.back(), -0.5, 0.5);
    }
  }
  if (known.empty()) return 0.0;
  const auto count_beyond = [&](double sign, double limit) {
    return std::count_if(known.begin(), known.end(), [&](double k) { return sign * k > limit; });
  };
  const auto all = static_cast<std::ptrdiff_t>(known.size());
  for (const double sign : {1.0, -1.0}) {
    std::sort(known.begin(), known.end(), [&](double k, double l) { return sign * k > sign * l; });
    if (count_beyond(sign, 0.5) == all) return known.back();
    if (count_beyond(sign, 0.5) > 2 && count_beyond(-sign, 0.3) == 0) return known[2];
  }
  return sum / static_cast<double>(all);
}

/// The curvature that presses on v: that of its ring, up to its own where that is known.
double pressing_curvature(const SurfaceStar& star, const CurvatureField& field) {
  const double ring = ring_curvature(star, field);
  const std::optional<double> own = field.at(star.vertex());
  if (!own) return ring;
  if (ring * *own <= 0.0) return 0.0;
  return std::abs(*own) < std::abs(ring) ? *own : ring;
}

/// Pressure: that curvature times what a move adds to the volume.  Debts: half of v's own,
/// and of each corner of each triangle 0.45, along the normal.  Both in units of the area term.
TEST(SurfaceEnergy, HasPressureAndDebtsInProportionToTheArea) {
  std::mt19937 random(1147);
  int checked = 0, bent = 0, limited = 0;
  each_random_star(1148, [&](const TetMesh& mesh, const Metric& metric, const DistanceGuard& guard,
                             const SurfaceStar& star) {
    const LocalVertex v = star.vertex();
    if (mesh.planes(v) != 0 || mesh.order(v) != 2 || !is_regular(star, Vec3::Zero())) return;
    constexpr SurfaceWeights kWithArea{.area = 1.0, .bend = 0.0, .needle = 0.0};
    const Vec3 plain = slope(kWithArea, mesh, metric, guard, star);
    const Vec3 of_area = area_slope(star);
    const Vec3 added = plain - slope(kFitAlone, mesh, metric, guard, star);
    if (of_area.norm() < 0.1 || !(added.norm() > 0.0)) return;
    const double factor = added.dot(of_area) / of_area.squaredNorm();
    CurvatureField curvature;
    curvature.measure(mesh, metric);
    const VolumeDebts debts = random_debts(mesh, random, 1e-5);
    Vec3 of_volume = Vec3::Zero(), owed = Vec3::Zero();
    for (const SurfaceTriangle& t : star.triangles()) {
      const Vec3 normal = t.to_a.cross(t.to_b);
      of_volume += normal / 6.0;
      owed += 0.5 * debts.of(v, t.low, t.high) * normal.normalized();
      for (const LocalVertex w : {t.a, t.b}) {
        owed += 0.45 * debts.of(w, t.low, t.high) * normal.normalized();
      }
    }
    const double bends = pressing_curvature(star, curvature);
    bent += std::abs(bends) > 0.5 ? 1 : 0;
    limited += bends != ring_curvature(star, curvature) ? 1 : 0;
    const Vec3 pressure = bends * of_volume;
    const double precision = 1e-5 * factor * (1.0 + pressure.norm() + owed.norm());
    const Vec3 pressed = slope(kWithArea, mesh, metric, guard, star, &curvature);
    EXPECT_NEAR((pressed - plain + factor * pressure).norm(), 0.0, precision);
    const Vec3 indebted = slope(kWithArea, mesh, metric, guard, star, nullptr, &debts);
    const double of_fit = factor / shares_at(mesh, guard, star).area;
    EXPECT_NEAR((indebted - plain + 2.0 * of_fit * owed).norm(), 0.0, 10.0 * precision);
    ++checked;
  });
  EXPECT_GT(checked, 100);
  EXPECT_GT(bent, 5);
  EXPECT_GT(limited, 20);
}

/// Bends count 1 / (1 + d^8) times as much where all owe d, and as before where the star owes
/// nothing in all.  Where more than two labels meet they always count.
TEST(SurfaceEnergy, BendsGiveWayWhereVolumeIsOwed) {
  std::mt19937 random(1151);
  int gave_way = 0, at_junctions = 0;
  each_random_star(1152, [&](const TetMesh& mesh, const Metric& metric, const DistanceGuard& guard,
                             const SurfaceStar& star) {
    const Vec3 x = random_offset(random);
    const auto value = [&](double own, double ring) {
      const VolumeDebts debts = debts_of(mesh, star, own, ring);
      SurfaceEnergy energy(kBendsAlone);
      energy.collect(mesh, metric, star, guard, nullptr, &debts);
      return energy.value_at(x);
    };
    const double free = value(0, 0);
    if (std::abs(free) < 1e-3 || star.fan().empty()) return;
    EXPECT_NEAR(value(2.0, -1.0), free, 1e-9 * std::abs(free));
    if (mesh.order(star.vertex()) != (mesh.planes(star.vertex()) != 0 ? 3 : 2)) {
      EXPECT_EQ(value(1.0, 1.0), free);
      ++at_junctions;
      return;
    }
    const double once = free / value(0.05, 0.05) - 1.0, twice = free / value(0.1, 0.1) - 1.0;
    if (once < 1e-6) return;  // too little, or no face is carried there
    EXPECT_NEAR(twice / once, 256.0, 1.0);
    EXPECT_NEAR(value(-0.05, -0.05), value(0.05, 0.05), 1e-9);
    ++gave_way;
  });
  EXPECT_GT(gave_way, 100);
  EXPECT_GT(at_junctions, 50);
}

/// Where the labels on both sides of a held sheet touch across it, area counts as on the sheet.
TEST(SurfaceEnergy, HasTheAreaOfASheetWhereItsSidesTouch) {
  const SmallVolume volume = volume_from({16, 10, 11}, 3, [](auto x, auto, auto z) {
    const auto height = z - 2 - x / 3;
    return height < 0 ? 0 : height == 0 ? 1 : 2;
  });
  GuardedMesh guarded(volume, kBound);
  const Metric metric;
  SurfaceStar star;
  int touches = 0, lines = 0;
  for (LocalVertex v = 0; v < guarded.mesh.vertex_count(); ++v) {
    if (guarded.mesh.planes(v) != 0 || guarded.mesh.order(v) != 3) continue;
    star.collect(guarded.mesh, metric, v);
    const auto& triangles = star.triangles();
    const bool is_touch = std::ranges::none_of(
        triangles, [](const SurfaceTriangle& t) { return t.is_between(0, 2); });
    const auto thin = thin_label_at(guarded.labels, guarded.mesh.position(v), 1);
    const auto slope_with = [&](double area, double junction_area) {
      const SurfaceWeights weights{
          .area = area, .junction_area = junction_area, .bend = 0.0, .needle = 0.0};
      return slope(weights, guarded.mesh, metric, guarded.guard, star);
    };
    const Vec3 plain = slope_with(1.0, 0.01);
    const bool is_as_on_sheet = is_touch && thin && thin->is_held;
    EXPECT_EQ(slope_with(1.0, 0.5) == plain, is_as_on_sheet);
    EXPECT_EQ(slope_with(0.5, 0.01) == plain, !is_as_on_sheet);
    (is_as_on_sheet ? touches : lines) += 1;
  }
  EXPECT_GT(touches, 5);
  EXPECT_GT(lines, 0);
}

/// On the box there is no area term.
TEST(SurfaceEnergy, LeavesAreaOutOnTheBox) {
  int on_box = 0;
  each_random_star(1149, [&](const TetMesh& mesh, const Metric& metric, const DistanceGuard& guard,
                             const SurfaceStar& star) {
    if (mesh.planes(star.vertex()) == 0) return;
    EXPECT_EQ(slope({.bend = 0.0, .needle = 0.0}, mesh, metric, guard, star),
              slope(kFitAlone, mesh, metric, guard, star));
    ++on_box;
  });
  EXPECT_GT(on_box, 100);
}

/// Moves interface vertices of a plane between labels 0 and 1 by `height` along its axis, except
/// those for which `stays` returns true.
template <typename Stays>
void move_plane(TetMesh& mesh, int axis, double height, Stays stays) {
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.on_interface(v) || stays(v)) continue;
    const auto by = static_cast<std::int32_t>(height * kUnitsPerVoxel);
    Point x = mesh.position(v);
    (axis == 0 ? x.x : axis == 1 ? x.y : x.z) += by;
    mesh.move(v, x, mesh.quadric(v));
  }
}

/// A plane across an axis in the middle of 6^3 voxels, one label or the other below.
SmallVolume plane(int axis, bool reversed) {
  return volume_from({6, 6, 6}, 2, [&](auto x, auto y, auto z) {
    const auto along = axis == 0 ? x : axis == 1 ? y : z;
    return (along < 3) == reversed ? 1 : 0;
  });
}

/// Value of the hat function of v at p, its own place the origin, and the sums that it gives.
struct Hat {
  double once = 0.0;
  double twice = 0.0;

  Hat(const TetMesh& mesh, const SurfaceStar& star, const DistanceGuard& guard,
      const Metric& metric) {
    const Vec3 at = metric.vector({}, mesh.position(star.vertex()));
    for (const SurfaceTriangle& t : star.triangles()) {
      guard.for_each_piece(
          triangle_key(star.vertex(), t.a, t.b), t.low, [&](const DistanceGuard::Piece& piece) {
            add(piece.middle.cwiseProduct(metric.voxel()) - at, piece.quarters, star);
          });
    }
  }
  void add(const Vec3& p, double area, const SurfaceStar& star) {
    double value = 0.0, min = 1e9;
    for (const SurfaceTriangle& t : star.triangles()) {
      const Foot foot = foot_on_triangle(p, t.to_a, t.to_b);
      if (foot.squared_distance >= min) continue;
      min = foot.squared_distance;
      value = foot.weights[0];
    }
    once += area * value;
    twice += area * value * value;
  }
};

/// Visits all interface vertices off the box, in planes across all axes, both ways round.
template <typename Visit>
void each_vertex_of_planes(double height, bool alone, Visit visit) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool reversed : {false, true}) {
      const Metric metric = reversed ? Metric() : Metric({1.0, 2.0, 1.5});
      const SmallVolume volume = plane(axis, reversed);
      const GuardedMesh planes(volume, kBound);
      for (LocalVertex v = 0; v < planes.mesh.vertex_count(); ++v) {
        if (!planes.mesh.on_interface(v) || planes.mesh.planes(v) != 0) continue;
        TetMesh mesh = planes.mesh;
        move_plane(mesh, axis, -height, [&](LocalVertex w) { return alone && w != v; });
        SurfaceStar star;
        star.collect(mesh, metric, v);
        star.collect_rims(mesh, metric);
        visit(mesh, metric, planes.guard, star, Vec3(Vec3::Unit(axis)));
      }
    }
  }
}

/// All of the plane lies h below its faces: v goes so far that the volume under its hat function is
/// made up for, though its neighbours stay; then it owes nothing.
TEST(SurfaceEnergy, FitMakesUpForTheVolumeUnderTheHat) {
  constexpr double kHeight = 0.25;
  int checked = 0;
  each_vertex_of_planes(kHeight, false,
                        [&](const TetMesh& mesh, const Metric& metric, const DistanceGuard& guard,
                            const SurfaceStar& star, const Vec3& normal) {
                          SurfaceEnergy energy(kFitAlone);
                          energy.collect(mesh, metric, star, guard, nullptr, nullptr);
                          const Hat hat(mesh, star, guard, metric);
                          ASSERT_GT(hat.twice, 0.0);
                          const double height = kHeight * metric.voxel().dot(normal);
                          const Vec3 x = height * hat.once / hat.twice * normal;
                          const StarTerms terms = derivatives(energy, x);
                          EXPECT_NEAR(terms.gradient.norm(), 0.0, 1e-9);
                          EXPECT_GT(normal.dot(terms.hessian * normal), 0.1);
                          EXPECT_LT(energy.value_at(x), -1e-3);
                          for (const VolumeDebt& d : energy.debts_at(x))
                            EXPECT_NEAR(d.volume, 0.0, 1e-9);
                          for (const VolumeDebt& d : energy.debts_at(Vec3::Zero()))
                            EXPECT_GT(std::abs(d.volume), 1e-3);
                          ++checked;
                        });
  EXPECT_EQ(checked, 150);
}

/// Only v lies h below the plane: it goes back, by h n.
TEST(SurfaceEnergy, FitIsLeastOnThePlane) {
  constexpr double kHeight = 0.0625;
  each_vertex_of_planes(kHeight, true,
                        [&](const TetMesh& mesh, const Metric& metric, const DistanceGuard& guard,
                            const SurfaceStar& star, const Vec3& normal) {
                          SurfaceEnergy energy(kFitAlone);
                          energy.collect(mesh, metric, star, guard, nullptr, nullptr);
                          const double height = kHeight * metric.voxel().dot(normal);
                          const StarTerms terms = derivatives(energy, Vec3::Zero());
                          const double min =
                              -normal.dot(terms.gradient) / normal.dot(terms.hessian * normal);
                          EXPECT_NEAR(min, height, 0.05 * height);
                        });
}

/// Where the volumes are right, a flat plane is at rest, area and bends included.
TEST(SurfaceEnergy, IsLeastForAPlaneWhereItIs) {
  each_vertex_of_planes(0.0, false,
                        [&](const TetMesh& mesh, const Metric& metric, const DistanceGuard& guard,
                            const SurfaceStar& star, const Vec3& normal) {
                          SurfaceEnergy energy(SurfaceWeights{});
                          energy.collect(mesh, metric, star, guard, nullptr, nullptr);
                          EXPECT_NEAR(derivatives(energy, Vec3::Zero()).gradient.norm(), 0.0, 1e-9);
                          for (const double step : {0.2, -0.2})
                            EXPECT_GT(energy.value_at(step * normal), 0.01);
                          EXPECT_EQ(energy.min_cosine(), 1.0);
                        });
}

}  // namespace
}  // namespace mw::test
