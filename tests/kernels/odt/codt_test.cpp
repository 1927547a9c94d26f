// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Iterations with triangulators that flip, add points, lie or fail.
#include "kernels/odt/codt.h"

#include "kernels/odt/rebuild.h"
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
  for (std::uint64_t windows : {1ULL, 2ULL, 3ULL, 8ULL, 1000ULL, 1ULL << 40, (1ULL << 57) - 1}) {
    for (std::uint64_t w = 0; w < std::min<std::uint64_t>(windows, 1000); ++w) {
      const SteinerIds ids = steiner_ids(w, windows);
      EXPECT_GE(ids.first, kMaxCorners);
      EXPECT_GE(ids.count, 64U);
      EXPECT_GE(ids.first + (ids.count - 1), ids.first) << "no wrap-around";
      if (w + 1 == windows) break;
      EXPECT_EQ(steiner_ids(w + 1, windows).first, ids.first + ids.count);
    }
    const SteinerIds last = steiner_ids(windows - 1, windows);
    EXPECT_GE(last.first + (last.count - 1), last.first);
  }
}

}  // namespace
}  // namespace mw::test
