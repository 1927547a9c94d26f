// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Iterations with triangulators that flip, add points, lie or fail; where vertices go, by solving
// for circumcentres, and who may not move.
#include "kernels/odt/codt.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "kernels/odt/rebuild.h"
#include "kernels/odt/window_plc.h"
#include "kernels/quality/quality.h"
#include "tests/kernels/odt/window_meshes.h"

namespace mw::test {
namespace {

constexpr CodtOptions kOptions{.iterations = 4, .min_gain = -1.0, .ids = {1ULL << 63, 1000}};

/// A window with a sample on some interface triangles, named by ids.
struct Sampled {
  explicit Sampled(std::mt19937& random) : window(random_window(random)) {
    FaceSamples next = 1;
    const TetMesh& mesh = window.mesh;
    for (const auto& [face, sides] : borders(face_labels(mesh.tets(), positions(mesh)))) {
      if (sides.size() != 2) continue;
      const Label side = std::min(sides[0].second, sides[1].second);
      for (std::uint32_t n = below(random, 3); n > 0; --n) samples.add(face, side, next++);
    }
  }

  using Named = std::tuple<std::array<VertexId, 3>, Label, FaceSamples>;
  [[nodiscard]] std::set<Named> named() const {
    std::set<Named> out;
    const TetMesh& mesh = window.mesh;
    for (const LocalTet& t : mesh.tets()) {
      for (int corner = 0; corner < 4; ++corner) {
        const LinkTriangle f = link_triangle(t, corner);
        const TriangleKey key = triangle_key(f.a, f.b, f.c);
        if (!samples.has(key, t.label)) continue;
        for (const FaceSamples s : samples.of(key)) {
          out.insert({{mesh.id(key[0]), mesh.id(key[1]), mesh.id(key[2])}, t.label, s});
        }
      }
    }
    return out;
  }

  WindowCase window;
  CarriedSamples samples;
};

/// What constrained ODT must leave alone, by ids.
struct Fixed {
  std::map<VertexId, Point> by_id;
  std::set<std::pair<std::array<VertexId, 3>, std::vector<Label>>> borders;
  std::map<Label, std::int64_t> volumes;

  explicit Fixed(const TetMesh& mesh) {
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (!mesh.is_free(v) || mesh.planes(v) != 0 || mesh.on_interface(v)) {
        by_id[mesh.id(v)] = mesh.position(v);
      }
    }
    const std::vector<Point> at = positions(mesh);
    for (const auto& [face, sides] : test::borders(face_labels(mesh.tets(), at))) {
      std::vector<Label> labels;
      for (const auto& side : sides) labels.push_back(side.second);
      borders.insert({{mesh.id(face[0]), mesh.id(face[1]), mesh.id(face[2])}, labels});
    }
    volumes = label_volumes(mesh.tets(), at);
  }
  friend bool operator==(const Fixed&, const Fixed&) = default;
};

void expect_sound(const TetMesh& mesh) {
  expect_same_regions(mesh.tets(), mesh);
  for (LocalVertex v = 1; v < mesh.vertex_count(); ++v) {
    EXPECT_LT(mesh.id(v - 1), mesh.id(v));
    EXPECT_TRUE(mesh.is_alive(v));
  }
}

CodtStats run(Sampled& sampled, const CodtOptions& options, const Triangulate& triangulate) {
  WindowCase& window = sampled.window;
  return codt(window.mesh, sampled.samples, far_corner(window.volume.shape), window.metric, options,
              triangulate);
}

TEST(Codt, KeepsHullInterfacesAndSamples) {
  std::mt19937 random(1251);
  std::uint64_t moves = 0, patches = 0;
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    Sampled sampled(random);
    const Fixed before(sampled.window.mesh);
    const auto samples = sampled.named();
    const TetMesh& mesh = sampled.window.mesh;
    const CodtStats stats = run(sampled, kOptions, [&](const Plc& plc) {
      EXPECT_EQ(plc.points.size(), mesh.vertex_count());
      TetMesh other = mesh;
      flip_some(other, sampled.window.metric, random, 150);
      return as_triangulation(window_plc(mesh, sampled.window.metric), mesh, other);
    });
    EXPECT_EQ(stats.iterations, 4U);
    EXPECT_EQ(stats.fallbacks, 0U);
    EXPECT_TRUE(Fixed(mesh) == before);
    EXPECT_TRUE(sampled.named() == samples);
    expect_sound(mesh);
    moves += stats.moves;
    patches += stats.replaced.patches;
  }
  EXPECT_GT(moves, 200U);
  EXPECT_GT(patches, 100U);
}

/// Cuts a few tets at their middle; with cubes for voxels the lattice is that of the Plc.
Triangulation with_points(const WindowPlc& asked, std::mt19937& random) {
  Triangulation made{{}, {}, asked.content.regions};
  for (const LocalTet& t : asked.content.tets) made.tets.push_back(t.vertices);
  const auto count = static_cast<std::uint32_t>(made.tets.size());
  for (std::size_t tet : std::set<std::size_t>{below(random, count), below(random, count)}) {
    const auto corners = made.tets[tet];
    PlcPoint middle{};
    for (std::uint32_t v : corners) {
      for (std::size_t k = 0; k < 3; ++k) middle[k] += 0.25 * asked.plc.points[v][k];
    }
    const auto row = static_cast<std::uint32_t>(asked.plc.points.size() + made.added.size());
    made.added.push_back(middle);
    for (std::size_t i = 0; i < 4; ++i) {
      auto part = corners;
      part[i] = row;
      if (i == 0) made.tets[tet] = part;
      if (i > 0) made.tets.push_back(part);
      if (i > 0) made.regions.push_back(made.regions[tet]);
    }
  }
  return made;
}

TEST(Codt, GivesSteinerPointsTheIdsOfTheWindow) {
  std::mt19937 random(1252);
  std::uint64_t added = 0;
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    Sampled sampled(random);
    const Fixed before(sampled.window.mesh);
    const auto samples = sampled.named();
    const TetMesh& mesh = sampled.window.mesh;
    CodtOptions options = kOptions;
    options.ids = {(1ULL << 63) + 77, 5};
    const CodtStats stats = run(sampled, options, [&](const Plc&) {
      return with_points(window_plc(mesh, sampled.window.metric), random);
    });
    expect_sound(mesh);
    EXPECT_TRUE(Fixed(mesh) == before);
    EXPECT_TRUE(sampled.named() == samples);
    EXPECT_LE(stats.added, 5U);
    std::vector<VertexId> ids;
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.id(v) < options.ids.first) continue;
      ids.push_back(mesh.id(v));
      EXPECT_TRUE(mesh.is_free(v) && !mesh.on_interface(v) && mesh.planes(v) == 0);
      Quadric point;
      point.add_point(1.0);
      EXPECT_EQ(mesh.quadric(v).a, point.a);
    }
    ASSERT_EQ(ids.size(), stats.added);
    for (std::size_t k = 0; k < ids.size(); ++k) EXPECT_EQ(ids[k], options.ids.first + k);
    added += stats.added;
  }
  EXPECT_GT(added, 60U);
}

TEST(Codt, LetsAWindowBeWithoutATriangulation) {
  std::mt19937 random(1253);
  for (int i = 0; i < 10; ++i) {
    Sampled sampled(random);
    const Fixed before(sampled.window.mesh);
    const auto tets = sampled.window.mesh.sorted_tets();
    const CodtStats stats = run(sampled, kOptions, [](const Plc&) { return std::nullopt; });
    EXPECT_EQ(stats.fallbacks, 1U);
    EXPECT_EQ(stats.iterations, 1U);
    EXPECT_EQ(sampled.window.mesh.sorted_tets(), tets);
    EXPECT_TRUE(Fixed(sampled.window.mesh) == before);
  }
}

/// Small windows over large tets, all of which other windows own.
TEST(Codt, LetsAnEmptyWindowBe) {
  TetMesh mesh({}, {}, {1024, 1024, 1024});
  CarriedSamples samples;
  const CodtStats stats = codt(mesh, samples, {1024, 1024, 1024}, Metric(), kOptions,
                               [](const Plc&) -> std::optional<Triangulation> {
                                 ADD_FAILURE() << "nothing to triangulate";
                                 return std::nullopt;
                               });
  EXPECT_EQ(stats.windows, 0U);
}

TEST(Codt, StopsWhenThereIsLittleToGain) {
  std::mt19937 random(1254);
  for (double gain : {0.001, 0.01, 0.5}) {
    Sampled sampled(random);
    const TetMesh& mesh = sampled.window.mesh;
    std::vector<double> energies{odt_energy(mesh, sampled.window.metric)};
    CodtOptions options = kOptions;
    options.iterations = 50;
    options.min_gain = gain;
    // The answer is what is there, so the energy is that after the moves.
    const CodtStats stats = run(sampled, options, [&](const Plc&) {
      energies.push_back(odt_energy(mesh, sampled.window.metric));
      return as_triangulation(window_plc(mesh, sampled.window.metric), mesh, mesh);
    });
    ASSERT_EQ(stats.iterations + 1, energies.size());
    for (std::size_t k = 1; k < energies.size(); ++k) {
      const bool gained = energies[k] < (1.0 - gain) * energies[k - 1];
      EXPECT_EQ(gained, k + 1 < energies.size()) << "iteration " << k << ", gain " << gain;
    }
  }
}

TEST(Rebuild, DropsDeadVerticesAndIsCanonical) {
  std::mt19937 random(1255);
  for (int i = 0; i < 20; ++i) {
    Sampled sampled(random);
    TetMesh& mesh = sampled.window.mesh;
    const auto samples = sampled.named();
    std::vector<LocalTet> tets = mesh.tets();
    const auto before = mesh.sorted_tets();
    for (std::size_t n = tets.size(); n > 1; --n) {
      std::swap(tets[n - 1], tets[below(random, static_cast<std::uint32_t>(n))]);
    }
    rebuild(mesh, sampled.samples, tets, {}, far_corner(sampled.window.volume.shape));
    EXPECT_EQ(mesh.sorted_tets(), before);
    EXPECT_TRUE(sampled.named() == samples);
    // Half of the tets: the other vertices go.
    tets = mesh.tets();
    tets.resize(tets.size() / 2);
    std::set<VertexId> used;
    for (const LocalTet& t : tets) {
      for (LocalVertex v : t.vertices) used.insert(mesh.id(v));
    }
    rebuild(mesh, sampled.samples, tets, {}, far_corner(sampled.window.volume.shape));
    ASSERT_EQ(mesh.vertex_count(), used.size());
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) EXPECT_TRUE(used.contains(mesh.id(v)));
  }
}

TEST(SteinerIdsOf, WindowsShareNone) {
  constexpr std::uint64_t kMaxCorners = 1ULL << 60;
  for (std::uint64_t windows : {1ULL, 2ULL, 3ULL, 8ULL, 1000ULL, 1ULL << 40, (1ULL << 51) - 1}) {
    for (std::uint64_t w = 0; w < std::min<std::uint64_t>(windows, 1000); ++w) {
      const SteinerIds ids = steiner_ids(w, windows);
      EXPECT_GE(ids.first, kMaxCorners);
      EXPECT_GE(ids.count, 64U);
      EXPECT_EQ((ids.first + (ids.count - 1)) >> kCopyBits, ids.first >> kCopyBits);
      EXPECT_EQ(ids.first >> kCopyBits, 1ULL << (kSteinerBit - kCopyBits));
      if (w + 1 == windows) break;
      EXPECT_EQ(steiner_ids(w + 1, windows).first, ids.first + ids.count);
    }
    const SteinerIds last = steiner_ids(windows - 1, windows);
    EXPECT_EQ((last.first + (last.count - 1)) >> kCopyBits, last.first >> kCopyBits);
  }
}

/// From the first corner of a tet to its circumcentre: as far from it as from the other three.
Vec3 circumcentre(const TetEdges& e) {
  Eigen::Matrix3d m;
  m << e.a.transpose(), e.b.transpose(), e.c.transpose();
  return m.inverse() * (0.5 * Vec3(e.a.squaredNorm(), e.b.squaredNorm(), e.c.squaredNorm()));
}

TEST(OdtSweep, GoesToTheMeanOfCircumcentres) {
  std::mt19937 random(1241);
  int whole_steps = 0;
  for (int i = 0; i < 40; ++i) {
    const Metric metric = i % 2 == 0 ? Metric() : Metric({1.0, 2.0, 1.0});
    // The one corner inside 2^3 voxels.
    TetMesh mesh = dense_mesh(volume_from({2, 2, 2}, 1, [](auto, auto, auto) { return 0; }));
    disturb(mesh, random);
    constexpr LocalVertex kCentre = 13;
    Vec3 sum = Vec3::Zero();
    double volume = 0.0;
    for (const LocalTet& t : mesh.tets()) {
      if (!has(t, kCentre)) continue;
      const auto& v = t.vertices;
      const TetEdges e = tet_edges(metric, mesh.position(v[0]), mesh.position(v[1]),
                                   mesh.position(v[2]), mesh.position(v[3]));
      const auto weight = static_cast<double>(volume6_of(mesh, t));
      sum +=
          weight * (metric.vector(mesh.position(kCentre), mesh.position(v[0])) + circumcentre(e));
      volume += weight;
    }
    const Point start = mesh.position(kCentre);
    const Point expected = metric.moved(start, sum / volume);
    EXPECT_LE(odt_sweep(mesh, metric, 0.0), 1U);
    const Point end = mesh.position(kCentre);
    const auto near = [](std::int32_t a, std::int32_t b) { return std::abs(a - b) <= 1; };
    whole_steps += near(end.x, expected.x) && near(end.y, expected.y) && near(end.z, expected.z);
  }
  EXPECT_GE(whole_steps, 36) << "the step is halved only where tets would turn over";
}

TEST(OdtSweep, MovesInnerFreeVerticesOnly) {
  std::mt19937 random(1242);
  std::uint64_t moves = 0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    WindowCase window = random_window(random);
    const TetMesh before = window.mesh;
    const double floor = i % 2 == 0 ? 0.0 : 0.3;
    const std::uint64_t moved = odt_sweep(window.mesh, window.metric, floor);
    std::uint64_t elsewhere = 0;
    for (LocalVertex v = 0; v < before.vertex_count(); ++v) {
      const bool inner = before.is_free(v) && before.planes(v) == 0 && !before.on_interface(v);
      const Vec3 way = window.metric.vector(before.position(v), window.mesh.position(v));
      EXPECT_TRUE(inner || way.norm() == 0.0);
      elsewhere += way.norm() > 0.0 ? 1U : 0U;
      const double error = before.quadric(v).value(way);
      EXPECT_NEAR(window.mesh.quadric(v).c, error, 1e-9 * (1.0 + error));
    }
    EXPECT_EQ(elsewhere, moved);
    double worst = 1.0, worst_before = 1.0;
    for (const LocalTet& t : window.mesh.tets()) {
      ASSERT_GT(volume6_of(window.mesh, t), 0);
      worst = std::min(worst, radius_ratio(window.mesh, window.metric, t));
      worst_before = std::min(worst_before, radius_ratio(before, window.metric, t));
    }
    EXPECT_GE(worst, std::min(floor, worst_before) - 1e-12);
    moves += moved;
  }
  EXPECT_GT(moves, 200U);
}

// Facets and regions against brute force; points there and back.

/// Number of classes of tets under "same label and a common triangle", by repeated relabelling.
std::size_t count_regions(const std::vector<LocalTet>& tets) {
  std::vector<std::size_t> group(tets.size());
  for (std::size_t i = 0; i < tets.size(); ++i) group[i] = i;
  const auto touch = [&](const LocalTet& a, const LocalTet& b) {
    return a.label == b.label &&
           std::ranges::count_if(a.vertices, [&](LocalVertex v) { return has(b, v); }) == 3;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < tets.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (group[i] == group[j] || !touch(tets[i], tets[j])) continue;
        group[i] = group[j] = std::min(group[i], group[j]);
        changed = true;
      }
    }
  }
  return std::set(group.begin(), group.end()).size();
}

TEST(WindowPlc, HasHullAndInterfacesAsFacets) {
  std::mt19937 random(1201);
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    const WindowCase window = random_window(random);
    const WindowPlc made = window_plc(window.mesh, window.metric);
    FaceLabels expected = borders(face_labels(window.mesh.tets(), positions(window.mesh)));
    EXPECT_EQ(made.plc.facets.size(), expected.size());
    for (const auto& facet : made.plc.facets) EXPECT_TRUE(expected.contains(facet));
    EXPECT_TRUE(tet_keys(made.content.tets) == tet_keys(window.mesh.tets()));
  }
}

TEST(WindowPlc, HasOneSeedInEachRegion) {
  std::mt19937 random(1202);
  for (int i = 0; i < 12 && !HasFailure(); ++i) {
    const WindowCase window = random_window(random);
    const WindowPlc made = window_plc(window.mesh, window.metric);
    ASSERT_EQ(made.plc.seeds.size(), count_regions(made.content.tets));
    ASSERT_EQ(made.content.labels.size(), made.plc.seeds.size());
    const auto edges = [&](std::size_t corner, const LocalTet& t, const PlcPoint& seed) {
      std::array<Vec3, 4> p;
      for (std::size_t k = 0; k < 4; ++k) {
        const PlcPoint& x = made.plc.points[t.vertices[k]];
        p[k] = k == corner ? Vec3(seed[0], seed[1], seed[2]) : Vec3(x[0], x[1], x[2]);
      }
      return (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]));
    };
    for (std::size_t r = 0; r < made.plc.seeds.size(); ++r) {
      int inside = 0;
      for (std::size_t t = 0; t < made.content.tets.size(); ++t) {
        bool in = true;
        for (std::size_t k = 0; k < 4; ++k) {
          in = in && edges(k, made.content.tets[t], made.plc.seeds[r]) > 0;
        }
        if (!in) continue;
        ++inside;
        EXPECT_EQ(made.content.regions[t], r);
        EXPECT_EQ(made.content.tets[t].label, made.content.labels[r]);
      }
      EXPECT_EQ(inside, 1);
    }
  }
}

TEST(WindowPlc, PointsComeBack) {
  std::mt19937 random(1203);
  for (int i = 0; i < 30; ++i) {
    const WindowCase window = random_window(random);
    const WindowPlc made = window_plc(window.mesh, window.metric);
    for (LocalVertex v = 0; v < window.mesh.vertex_count(); ++v) {
      EXPECT_EQ(made.frame.to_lattice(made.plc.points[v]), window.mesh.position(v));
    }
  }
  const PlcFrame frame({5, 6, 7}, Metric());
  EXPECT_EQ(frame.to_lattice({0.4, 1.6, 2.0}), (Point{5, 8, 9}));
  EXPECT_FALSE(frame.to_lattice({-1.0, 0.0, 0.0}));
  EXPECT_FALSE(frame.to_lattice({0.0, 3e9, 0.0}));
  EXPECT_FALSE(frame.to_lattice({0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}));
}

}  // namespace
}  // namespace mw::test
