// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Curved interfaces: a ball whose corners lie on a sphere, flat layers, cells full of noise; and
// how files with them are read.
#include "io/mesh/grouped/curved_nodes.h"

#include <Eigen/Geometry>

#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/open_mesh.h"
#include "kernels/curve/quadratic.h"
#include "tests/expect_error.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kCubes = 8;
constexpr double kMiddle = 4, kRadius = 2;

double distance_of(const Position& p, const Position& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// Cubes within two of the middle are label 1, and become a ball; the others are stretched along.
MeshData ball_mesh() {
  MeshData mesh = grid_mesh({kCubes, kCubes, kCubes}, 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const std::uint64_t cube = t / 6;
    bool inside = true;
    for (const std::uint64_t c : {cube % kCubes, cube / kCubes % kCubes, cube / kCubes / kCubes}) {
      inside = inside && c >= 2 && c < 6;
    }
    mesh.labels[t] = inside ? 1 : 0;
  }
  for (Position& p : mesh.vertices) {
    const Position d{p[0] - kMiddle, p[1] - kMiddle, p[2] - kMiddle};
    const double shell = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    if (shell == 0) continue;
    const double onto_sphere = shell / std::hypot(d[0], d[1], d[2]);
    const double out = std::max(0.0, (shell - kRadius) / (kMiddle - kRadius));
    for (std::size_t k = 0; k < 3; ++k) p[k] = kMiddle + d[k] * (onto_sphere * (1 - out) + out);
  }
  mesh.record.box = MeshBox{.edges = {{{8, 0, 0}, {0, 8, 0}, {0, 0, 8}}}};
  return mesh;
}

GroupedMesh& finished(GroupedSink& sink, const MeshData& mesh) {
  write_mesh(mesh, sink);
  return sink.mesh();
}

/// A mesh with straight edges and with curved ones.
struct BothMeshes {
  explicit BothMeshes(const MeshData& data)
      : straight(finished(straight_sink, data)), curved(finished(curved_sink, data)) {}

  TempDir dir;
  GroupedSink straight_sink{dir.path(), nullptr, Element::kTet10};
  GroupedSink curved_sink{dir.path(), nullptr, Element::kCurvedTet10};
  GroupedMesh& straight;
  GroupedMesh& curved;
};

QuadraticTet nodes_of(GroupedMesh& mesh, std::uint64_t tet) {
  QuadraticTet out;
  const NodeRows rows = mesh.tet_nodes(tet);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Position p = mesh.node(rows.begin()[i]);
    out[i] = {p[0], p[1], p[2]};
  }
  return out;
}

double volume_of(const QuadraticTet& t) {
  double out = 0;
  for (const auto& part : kTetParts) {
    const Vec3& a = t[part[0]];
    out += (t[part[1]] - a).cross(t[part[2]] - a).dot(t[part[3]] - a) / 6;
  }
  return out;
}

/// The volume of a label by tets that are cut into eight `levels` times, along the curves.
double volume_of(const QuadraticTet& t, int levels) {
  if (levels == 1) return volume_of(t);
  const auto at = [&](const std::array<double, 4>& l) {
    Vec3 out = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) out += l[i] * (2 * l[i] - 1) * t[i];
    for (std::size_t e = 0; e < 6; ++e) {
      out += 4 * l[kTetEdges[e][0]] * l[kTetEdges[e][1]] * t[4 + e];
    }
    return out;
  };
  std::array<std::array<double, 4>, 10> places{};
  for (std::size_t i = 0; i < 4; ++i) places[i][i] = 1;
  for (std::size_t e = 0; e < 6; ++e) {
    places[4 + e][kTetEdges[e][0]] = places[4 + e][kTetEdges[e][1]] = 0.5;
  }
  double sum = 0;
  for (const auto& part : kTetParts) {
    std::array<std::array<double, 4>, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = places[part[i]];
    QuadraticTet child;
    for (std::size_t i = 0; i < 4; ++i) child[i] = at(corners[i]);
    for (std::size_t e = 0; e < 6; ++e) {
      std::array<double, 4> middle{};
      for (std::size_t k = 0; k < 4; ++k) {
        middle[k] = (corners[kTetEdges[e][0]][k] + corners[kTetEdges[e][1]][k]) / 2;
      }
      child[4 + e] = at(middle);
    }
    sum += volume_of(child, levels - 1);
  }
  return sum;
}

/// Rows of the nodes of the facets between the labels.
std::set<std::uint64_t> interface_nodes(GroupedMesh& mesh) {
  std::set<std::uint64_t> out;
  for (const FacetGroup& group : mesh.facet_groups()) {
    if (group.side != Side::kInterface) continue;
    for (std::uint64_t f = group.facets.begin; f < group.facets.end; ++f) {
      const NodeRows rows = mesh.facet_nodes(mesh.facet(f));
      out.insert(rows.begin(), rows.end());
    }
  }
  return out;
}

/// The standard deviation of the distances of nodes from the middle.
double spread_of_radii(GroupedMesh& mesh, const std::set<std::uint64_t>& rows) {
  double sum = 0, squares = 0;
  for (const std::uint64_t row : rows) {
    const double r = distance_of(mesh.node(row), {kMiddle, kMiddle, kMiddle});
    sum += r;
    squares += r * r;
  }
  const auto count = static_cast<double>(rows.size());
  return std::sqrt(squares / count - sum / count * (sum / count));
}

TEST(CurvedNodes, ABallIsRoundAndKeepsItsVolume) {
  const MeshData data = ball_mesh();
  BothMeshes both(data);
  GroupedMesh &straight = both.straight, &curved = both.curved;
  const std::set<std::uint64_t> rows = interface_nodes(straight);
  EXPECT_LT(spread_of_radii(curved, rows), 0.6 * spread_of_radii(straight, rows));
  const RowRange ball = curved.label_tets()[1];
  double straight_volume = 0, curved_volume = 0;
  for (std::uint64_t t = ball.begin; t < ball.end; ++t) {
    straight_volume += volume_of(nodes_of(straight, t));
    const QuadraticTet tet = nodes_of(curved, t);
    // The error of straight parts falls with the square of their size.
    curved_volume += (4 * volume_of(tet, 3) - volume_of(tet, 2)) / 3;
  }
  EXPECT_NEAR(curved_volume / straight_volume, 1, 2e-4);
}

TEST(CurvedNodes, StraightPartsOfABallAreRoundAndKeepItsVolume) {
  const MeshData data = ball_mesh();
  const TempDir dir;
  GroupedSink straight_sink(dir.path(), nullptr, Element::kTet10);
  GroupedSink curved_sink(dir.path(), nullptr, Element::kTet10,
                          CurveRule{.has_straight_parts = true});
  GroupedMesh &straight = finished(straight_sink, data), &curved = finished(curved_sink, data);
  const std::set<std::uint64_t> rows = interface_nodes(straight);
  EXPECT_LT(spread_of_radii(curved, rows), 0.65 * spread_of_radii(straight, rows));
  const RowRange ball = curved.label_tets()[1];
  double before = 0, after = 0;
  for (std::uint64_t t = ball.begin; t < ball.end; ++t) {
    before += volume_of(nodes_of(straight, t));
    after += volume_of(nodes_of(curved, t));
  }
  // Some nodes are held back, as tets would become worse, and the others do not make up for it.
  EXPECT_NEAR(after / before, 1, 5e-3);
  EXPECT_FALSE(curved.header().record.curved);
}

/// Groups the mesh of a ball that is known to be a sphere of another radius.
GroupedMesh& known_ball(GroupedSink& sink, double radius) {
  const MeshData data = ball_mesh();
  MeshHeader header{.tets = data.tets.size(), .record = data.record};
  header.interface_place = [radius](const Position& near, RawLabel one, RawLabel other) {
    EXPECT_EQ(one + other, 1U);
    const double far = distance_of(near, {kMiddle, kMiddle, kMiddle});
    Position out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = kMiddle + (near[k] - kMiddle) * (radius / far);
    return std::optional(out);
  };
  sink.begin(header);
  sink.write_vertices(data.vertices);
  sink.write_tets(data.tets, data.labels);
  sink.finish();
  return sink.mesh();
}

TEST(CurvedNodes, GoToWhereTheInterfaceIsKnownToLie) {
  const double radius = 0.99 * kRadius;
  const double volume = 4.0 / 3.0 * std::acos(-1.0) * radius * radius * radius;
  const TempDir dir;
  for (const bool has_straight_parts : {false, true}) {
    GroupedSink sink(dir.path(), nullptr,
                     has_straight_parts ? Element::kTet10 : Element::kCurvedTet10,
                     CurveRule{.has_straight_parts = has_straight_parts});
    GroupedMesh& curved = known_ball(sink, radius);
    const std::set<std::uint64_t> rows = interface_nodes(curved);
    std::size_t off = 0;
    double mean = 0;
    for (const std::uint64_t row : rows) {
      const double r = distance_of(curved.node(row), {kMiddle, kMiddle, kMiddle});
      mean += r / static_cast<double>(rows.size());
      if (std::abs(r - radius) > 0.02) ++off;
    }
    // Nodes that would spoil tets stay behind; there are more of them where tets have straight
    // parts, and others lie a little outside of the sphere, as the volume asks for.
    EXPECT_LT(off, rows.size() / (has_straight_parts ? 5 : 10));
    EXPECT_NEAR(mean, radius, 0.015);
    const RowRange ball = curved.label_tets()[1];
    double found = 0;
    for (std::uint64_t t = ball.begin; t < ball.end; ++t) {
      const QuadraticTet tet = nodes_of(curved, t);
      found +=
          has_straight_parts ? volume_of(tet) : (4 * volume_of(tet, 3) - volume_of(tet, 2)) / 3;
    }
    EXPECT_NEAR(found / volume, 1, has_straight_parts ? 1.5e-2 : 5e-3);
  }
}

/// The guarantees of curve_nodes() for any mesh.
void expect_sound(GroupedMesh& straight, GroupedMesh& curved) {
  for (std::uint64_t t = 0; t < curved.tet_count(); ++t) {
    const QuadraticTet before = nodes_of(straight, t), after = nodes_of(curved, t);
    const double volume6 = least_jacobian(before);
    EXPECT_GE(least_jacobian(after), kLeastJacobian * volume6 * (1 - 1e-9));
    EXPECT_GE(least_part(after), kLeastJacobian / 8 * volume6 * (1 - 1e-9));
  }
  const std::set<std::uint64_t> on_interfaces = interface_nodes(curved);
  for (std::uint64_t t = 0; t < curved.tet_count(); ++t) {
    const NodeRows rows = curved.tet_nodes(t);
    const QuadraticTet nodes = nodes_of(curved, t);
    for (std::size_t e = 0; e < 6; ++e) {
      if (on_interfaces.contains(rows.begin()[4 + e])) continue;
      const Vec3 middle = 0.5 * (nodes[kTetEdges[e][0]] + nodes[kTetEdges[e][1]]);
      EXPECT_LT((nodes[4 + e] - middle).norm(), 1e-14);
    }
  }
  for (std::uint64_t row = 0; row < curved.vertex_count(); ++row) {
    if (on_interfaces.contains(row)) continue;
    EXPECT_EQ(curved.node(row), straight.node(row));
  }
}

/// Nodes in a side of the box stay in it.
void expect_in_box(GroupedMesh& straight, GroupedMesh& curved) {
  for (std::uint64_t row = 0; row < curved.node_count(); ++row) {
    const Position before = straight.node(row), after = curved.node(row);
    for (std::size_t k = 0; k < 3; ++k) {
      const double far = straight.box().edges[k][k];
      const bool is_on_side = before[k] == 0 || before[k] == far;
      EXPECT_TRUE(!is_on_side || after[k] == before[k]) << row;
    }
  }
}

TEST(CurvedNodes, NoiseIsHeldBackUntilAllTetsAreSound) {
  std::size_t moved = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    MeshData data = grid_mesh({5, 5, 5}, seed);
    shake(data, 5, seed);
    // Half of the meshes are of two labels, whose interfaces have more room to bend.
    for (RawLabel& label : data.labels) label = seed % 2 == 0 ? label : label / 2;
    data.record.box = MeshBox{.edges = {{{5, 0, 0}, {0, 5, 0}, {0, 0, 5}}}};
    data.record.promises = MeshPromises{.max_distance = 1.5, .quality_floor = 0.3};
    BothMeshes both(data);
    GroupedMesh &straight = both.straight, &curved = both.curved;
    expect_sound(straight, curved);
    expect_in_box(straight, curved);
    EXPECT_TRUE(curved.header().record.curved);
    EXPECT_EQ(curved.header().record.promises->quality_floor, 0.15);
    EXPECT_EQ(curved.header().record.promises->max_distance, std::nullopt);
    for (std::uint64_t row = 0; row < curved.node_count(); ++row) {
      moved += curved.node(row) != straight.node(row) ? 1U : 0U;
    }
  }
  EXPECT_GT(moved, 300U);
}

TEST(CurvedNodes, FlatInterfacesStayAsTheyAre) {
  MeshData data = grid_mesh({4, 4, 4}, 1);
  for (std::size_t t = 0; t < data.tets.size(); ++t) data.labels[t] = t / 6 / 16 < 2 ? 5 : 7;
  data.record.box = MeshBox{.edges = {{{4, 0, 0}, {0, 4, 0}, {0, 0, 4}}}};
  BothMeshes both(data);
  GroupedMesh &straight = both.straight, &curved = both.curved;
  for (std::uint64_t row = 0; row < curved.node_count(); ++row) {
    EXPECT_EQ(curved.node(row), straight.node(row));
  }
}

TEST(CurvedNodes, OppositeSidesOfAPeriodicCellStayAlike) {
  MeshData data = ball_mesh();
  for (std::size_t t = 0; t < data.tets.size(); ++t) data.labels[t] = t % 97 == 0 ? 1 : 0;
  data.record.promises = MeshPromises{.periodic = 7};
  BothMeshes both(data);
  GroupedMesh &straight = both.straight, &curved = both.curved;
  for (std::uint64_t row = 0; row < curved.node_count(); ++row) {
    const Position p = straight.node(row);
    if (std::any_of(p.begin(), p.end(), [](double x) { return x == 0 || x == 8; })) {
      EXPECT_EQ(curved.node(row), p);
    }
  }
}

TEST(CurvedNodes, AreNotForDoubledVertices) {
  MeshData data = grid_mesh({2, 1, 1}, 1);
  data.record.has_doubles = true;
  const TempDir dir;
  GroupedSink sink(dir.path(), nullptr, Element::kCurvedTet10);
  expect_error(ErrorKind::kUsage, {"doubled"}, [&] { write_mesh(data, sink); });
}

TEST(CurvedNodes, AreReadAsPartsOfTets) {
  const TempDir dir;
  MeshData data = ball_mesh();
  data.values.push_back({"number", {}});
  for (std::size_t t = 0; t < data.tets.size(); ++t) data.values[0].numbers.push_back(double(t));
  GroupedSink sink(dir.path(), nullptr, Element::kCurvedTet10);
  GroupedMesh& mesh = finished(sink, data);
  for (const char* name : {"m.vtu", "m.vtkhdf"}) {
    const std::filesystem::path path = dir.path() / name;
    write_mesh(data, *open_mesh_sink(path, Element::kCurvedTet10));
    const MeshData read = read_mesh(path);
    EXPECT_TRUE(read.in_parts);
    EXPECT_FALSE(read.record.curved);
    ASSERT_EQ(read.tets.size(), 8 * data.tets.size());
    ASSERT_EQ(read.values.size(), 1U);
    std::size_t next = 0;
    for (std::uint64_t t = 0; t < mesh.tet_count(); ++t) {
      const NodeRows rows = mesh.tet_nodes(t);
      for (const auto& part : kTetParts) {
        for (std::size_t i = 0; i < 4; ++i) {
          EXPECT_EQ(read.vertices[read.tets[next][i]], mesh.node(rows.begin()[part[i]]));
        }
        EXPECT_EQ(read.labels[next], mesh.table().raw(mesh.label_of(t)));
        EXPECT_EQ(read.values[0].numbers[next++], mesh.value(t, 0));
      }
    }
    // What is written of them is a mesh of straight tets.
    write_mesh(read, *open_mesh_sink(dir.path() / "again.vtu"));
    const MeshData again = read_mesh(dir.path() / "again.vtu");
    EXPECT_EQ(again.tets, read.tets);
    EXPECT_FALSE(again.in_parts);
  }
  write_mesh(data, *open_mesh_sink(dir.path() / "m.msh", Element::kCurvedTet10));
  expect_error(ErrorKind::kInput, {"curved"},
               [&] { static_cast<void>(read_mesh(dir.path() / "m.msh")); });
}

}  // namespace
}  // namespace mw::io
