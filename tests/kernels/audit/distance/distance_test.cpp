// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// P4: both directions against every sample times every face and triangle, and known answers.
#include "kernels/audit/distance/distance.h"

#include "kernels/audit/audit.h"
#include "kernels/audit/distance/input.h"
#include "kernels/audit/distance/mesh.h"
#include "kernels/audit/distance/tile.h"
#include "tests/kernels/audit/points.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_audit.h"

namespace mw::audit {
namespace {

using namespace test;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// From the distance to the plane and to the edges.
double plain_distance(const Point& p, const std::array<Point, 3>& t) {
  const auto minus = [](const Point& a, const Point& b) {
    return Point{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto cross = [](const Point& a, const Point& b) {
    return Point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto dot = [](const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const Point normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const double height = dot(minus(p, t[0]), normal) / std::sqrt(dot(normal, normal));
  bool inside = true;
  double nearest = kInfinite;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& a = t[i];
    const Point way = minus(t[(i + 1) % 3], a);
    inside = inside && dot(cross(way, minus(p, a)), normal) >= 0;
    const double u = std::clamp(dot(minus(p, a), way) / dot(way, way), 0.0, 1.0);
    nearest = std::min(nearest, distance(p, along(a, t[(i + 1) % 3], u)));
  }
  return inside ? std::abs(height) : nearest;
}

struct PlainFace {
  Point lo;
  Point hi;
  Label a = 0;
  Label b = 0;
};

struct PlainTriangle {
  std::array<Point, 3> corners;
  Label a = 0;
  Label b = 0;
};

std::vector<PlainFace> plain_faces(const SmallVolume& volume) {
  std::vector<PlainFace> faces;
  const Index3 s = volume.shape;
  const auto at = [&](const std::array<std::int64_t, 3>& v) {
    return volume.labels[static_cast<std::size_t>((v[2] * s.y + v[1]) * s.x + v[0])];
  };
  for (std::int64_t i = 0; i < s.product(); ++i) {
    const std::array<std::int64_t, 3> v{i % s.x, i / s.x % s.y, i / s.x / s.y};
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<std::int64_t, 3> other = v;
      if (--other[k] < 0 || at(other) == at(v)) continue;
      PlainFace face{{}, {}, at(other), at(v)};
      for (std::size_t n = 0; n < 3; ++n) {
        face.lo[n] = static_cast<double>(v[n]);
        face.hi[n] = face.lo[n] + (n == k ? 0 : 1);
      }
      faces.push_back(face);
    }
  }
  return faces;
}

std::vector<PlainTriangle> plain_triangles(const SmallMesh& mesh, const Frame& frame) {
  std::map<std::array<std::uint64_t, 3>, std::vector<Label>> sides;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<std::uint64_t, 3> face{};
      for (std::size_t i = 0; i < 3; ++i) face[i] = mesh.tets[t][(left_out + 1 + i) % 4];
      std::sort(face.begin(), face.end());
      sides[face].push_back(mesh.labels[t]);
    }
  }
  std::vector<PlainTriangle> triangles;
  for (const auto& [face, labels] : sides) {
    if (labels.size() != 2 || labels[0] == labels[1]) continue;
    PlainTriangle triangle{{}, labels[0], labels[1]};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.corners[i][k] = (mesh.vertices[face[i]][k] - frame.origin[k]) / frame.spacing[k];
      }
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

struct PlainTally {
  double max = 0;
  double sum = 0;
  double weight = 0;

  /// w: 0 for a sample that means do not count.
  void add(double value, double w) {
    max = std::max(max, value);
    sum += w * value;
    weight += w;
  }
  [[nodiscard]] double mean() const { return weight > 0 ? sum / weight : 0; }
};

/// All faces and triangles of one label, all samples of one side against all of the other.
struct PlainLabel {
  PlainLabel(const std::vector<PlainFace>& all_faces,
             const std::vector<PlainTriangle>& all_triangles, Label label) {
    for (const PlainFace& f : all_faces) {
      if (f.a == label || f.b == label) faces.push_back(f);
    }
    for (const PlainTriangle& t : all_triangles) {
      if (t.a == label || t.b == label) triangles.push_back(t);
    }
    if (faces.empty() || triangles.empty()) return;
    for (const PlainFace& f : faces) measure(f);
    for (const PlainTriangle& t : triangles) measure(t);
  }

  void measure(const PlainFace& f) {
    for (int i = 0; i < 9; ++i) {
      const int row = i / 3;
      const std::array<double, 2> step{(i % 3) / 2.0, row / 2.0};
      Point p = f.lo;
      for (std::size_t k = 0, used = 0; k < 3; ++k) {
        if (f.hi[k] > f.lo[k]) p[k] += step[used++];
      }
      double nearest = kInfinite;
      for (const PlainTriangle& t : triangles) {
        nearest = std::min(nearest, plain_distance(p, t.corners));
      }
      const bool is_weighed = std::fmod(f.lo[0] + f.lo[1] + f.lo[2], 4) == 0;
      to_mesh.add(nearest, i == 4 && is_weighed ? 1 : 0);
    }
  }

  void measure(const PlainTriangle& t) {
    const auto& c = t.corners;
    const double longest =
        std::max({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
    const int parts = std::max(1, static_cast<int>(std::ceil(longest / std::sqrt(3.0) / 0.25)));
    std::vector<double> found;
    for (int i = 0; i <= parts; ++i) {
      for (int k = 0; k <= i; ++k) {
        const Point side = along(c[0], c[1], static_cast<double>(i) / parts);
        const Point other = along(c[0], c[2], static_cast<double>(i) / parts);
        found.push_back(to_faces(along(side, other, i == 0 ? 0 : static_cast<double>(k) / i)));
      }
    }
    const double half = (distance(c[0], c[1]) + distance(c[1], c[2]) + distance(c[2], c[0])) / 2;
    const double area = std::sqrt(half * (half - distance(c[0], c[1])) *
                                  (half - distance(c[1], c[2])) * (half - distance(c[2], c[0])));
    for (const double d : found) to_input.add(d, 0);
    const Point middle = along(along(c[0], c[1], 0.5), c[2], 1.0 / 3);
    to_input.add(to_faces(middle), area);
    for (const Point& corner : c) is_whole = is_whole && distance(corner, middle) <= kPieceRadius;
  }

  [[nodiscard]] double to_faces(const Point& p) const {
    double nearest = kInfinite;
    for (const PlainFace& f : faces) {
      Point q{};
      for (std::size_t k = 0; k < 3; ++k) q[k] = std::clamp(p[k], f.lo[k], f.hi[k]);
      nearest = std::min(nearest, distance(p, q));
    }
    return nearest;
  }

  std::vector<PlainFace> faces;
  std::vector<PlainTriangle> triangles;
  PlainTally to_mesh;
  PlainTally to_input;
  bool is_whole = true;  ///< no triangle has more than one piece
};

/// Both are the largest of samples that are no farther than that from any point.
void expect_near(double found, double expected) {
  EXPECT_LE(found, expected + 0.354);
  EXPECT_GE(found, expected - kCoveringRadius - 1e-9);
}

void expect_same_as_plain(const SmallVolume& volume, const SmallMesh& mesh, const Frame& frame) {
  constexpr double kRounding = 1e-9;
  const DistanceReport report =
      measure_distance(volume.view(), volume.label_count, mesh.view(), frame, {}, 0);
  const auto faces = plain_faces(volume);
  const auto triangles = plain_triangles(mesh, frame);
  std::size_t row = 0;
  bool is_whole = true;
  PlainTally all;
  for (Label label = 0; label < volume.label_count; ++label) {
    const PlainLabel plain(faces, triangles, label);
    if (plain.faces.empty() && plain.triangles.empty()) continue;
    ASSERT_LT(row, report.per_label.size());
    const auto& found = report.per_label[row++];
    ASSERT_EQ(found.label, label);
    ASSERT_EQ(found.is_finite(), !plain.faces.empty() && !plain.triangles.empty());
    if (!found.is_finite()) continue;
    expect_near(found.input_to_mesh_max, plain.to_mesh.max);
    expect_near(found.mesh_to_input_max, plain.to_input.max);
    EXPECT_NEAR(found.input_to_mesh_mean, plain.to_mesh.mean(), kRounding);
    is_whole = is_whole && plain.is_whole;
    if (plain.is_whole) {
      EXPECT_NEAR(found.mesh_to_input_mean, plain.to_input.sum / plain.to_input.weight, 1e-6);
    }
    for (const PlainTally& tally : {plain.to_mesh, plain.to_input}) {
      all.max = std::max(all.max, tally.max);
      all.sum += tally.sum;
      all.weight += tally.weight;
    }
  }
  EXPECT_EQ(row, report.per_label.size());
  if (!report.is_finite()) return;
  expect_near(report.max_voxels, all.max);
  if (!is_whole) return;
  EXPECT_NEAR(report.mean_voxels, all.weight > 0 ? all.sum / all.weight : 0, 1e-6);
}

/// Moves every vertex by less than `reach` voxels along each axis; the mesh need not stay valid.
void shake(std::mt19937& random, const Frame& frame, double reach, SmallMesh& mesh) {
  for (Position& p : mesh.vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] += frame.spacing[k] * reach * (below(random, 2001) / 1000.0 - 1);
    }
  }
}

/// Two labels with a plane between them at x = 3, in a box of 6 x 4 x 5.
SmallVolume halves() {
  return volume_from({6, 4, 5}, 2, [](auto x, auto, auto) { return x >= 3 ? 1 : 0; });
}

/// Moves the inner plane x = 3 by `shift` voxels.
SmallMesh shifted_halves(double shift, const Frame& frame = {}) {
  SmallMesh mesh = five_tet_mesh(halves(), frame);
  const double plane = frame.origin[0] + 3 * frame.spacing[0];
  for (Position& p : mesh.vertices) {
    if (std::abs(p[0] - plane) < 1e-9) p[0] += shift * frame.spacing[0];
  }
  return mesh;
}

const Check* distance_check(const AuditReport& report) {
  const auto found = std::find_if(report.checks.begin(), report.checks.end(),
                                  [](const Check& c) { return c.name == "P4 distance"; });
  return found == report.checks.end() ? nullptr : &*found;
}

TEST(Distance, OfTheUnchangedMeshIsZero) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 60; ++trial) {
    const SmallVolume v = random_volume(random);
    const SmallMesh mesh = five_tet_mesh(v);
    const DistanceReport report = measure_distance(v.view(), v.label_count, mesh.view(), {});
    ASSERT_EQ(report.max_voxels, 0) << v.text();
    ASSERT_EQ(report.mean_voxels, 0) << v.text();
    ASSERT_TRUE(report.is_finite());
  }
}

TEST(Distance, IsThatOfBruteForce) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 60; ++trial) {
    const SmallVolume v = random_volume(random);
    SmallMesh mesh = five_tet_mesh(v);
    shake(random, {}, trial % 3 == 0 ? 2.0 : 0.4, mesh);
    expect_same_as_plain(v, mesh, {});
    if (HasFailure()) FAIL() << v.text();
  }
}

TEST(Distance, IsThatOfBruteForceOnLargerVolumes) {
  std::mt19937 random(5);
  for (std::uint32_t kind = 0; kind < kVolumeKinds; ++kind) {
    const SmallVolume v =
        random_volume_of(random, static_cast<VolumeKind>(kind), {7, 6, 8}, 2 + kind);
    SmallMesh mesh = five_tet_mesh(v);
    shake(random, {}, 0.4, mesh);
    expect_same_as_plain(v, mesh, {});
    if (HasFailure()) FAIL() << v.text();
  }
}

TEST(Distance, IsThatOfBruteForceWhenLabelsAreFarAway) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 20; ++trial) {
    const SmallVolume v = random_volume_of(random, VolumeKind::kSpecks, {9, 6, 7}, 5);
    SmallMesh mesh = five_tet_mesh(v);
    std::shuffle(mesh.labels.begin(), mesh.labels.end(), random);
    expect_same_as_plain(v, mesh, {});
    if (HasFailure()) FAIL() << v.text();
  }
}

TEST(Distance, IsMeasuredInVoxelsOfTheFrame) {
  std::mt19937 random(7);
  const Frame frame{{0.5, 2, 30}, {-100, 7, 0.25}};
  for (int trial = 0; trial < 20; ++trial) {
    const SmallVolume v = random_volume(random);
    SmallMesh mesh = five_tet_mesh(v, frame);
    EXPECT_NEAR(measure_distance(v.view(), v.label_count, mesh.view(), frame).max_voxels, 0, 1e-9);
    shake(random, frame, 0.4, mesh);
    expect_same_as_plain(v, mesh, frame);
    if (HasFailure()) FAIL() << v.text();
  }
}

TEST(Distance, OfAShiftedPlaneIsTheShift) {
  for (const Frame& frame : {Frame{}, Frame{{0.5, 2, 30}, {-100, 7, 0.25}}}) {
    const SmallMesh mesh = shifted_halves(0.3, frame);
    const DistanceReport report = measure_distance(halves().view(), 2, mesh.view(), frame);
    ASSERT_EQ(report.per_label.size(), 2U);
    for (const auto& row : report.per_label) {
      EXPECT_NEAR(row.input_to_mesh_max, 0.3, 1e-12);
      EXPECT_NEAR(row.input_to_mesh_mean, 0.3, 1e-12);
      EXPECT_NEAR(row.mesh_to_input_max, 0.3, 1e-12);
      EXPECT_NEAR(row.mesh_to_input_mean, 0.3, 1e-12);
    }
    EXPECT_NEAR(report.max_voxels, 0.3, 1e-12);
    EXPECT_NEAR(report.mean_voxels, 0.3, 1e-12);
  }
}

TEST(Distance, IsOfEachLabelOnItsOwn) {
  // Where label 1 was, the mesh has label 2 and the other way round: both have the same faces
  // towards 0 in sum, but each is five voxels from its own.
  const auto label_at = [](auto x, auto, auto) { return x < 2 ? 1 : x < 7 ? 0 : 2; };
  const SmallVolume v = volume_from({9, 3, 3}, 3, label_at);
  SmallMesh mesh = five_tet_mesh(v);
  for (Label& label : mesh.labels) label = label == 0 ? 0 : 3 - label;
  const DistanceReport report = measure_distance(v.view(), 3, mesh.view(), {});
  ASSERT_EQ(report.per_label.size(), 3U);
  EXPECT_EQ(report.per_label[0].max(), 0);
  EXPECT_EQ(report.per_label[1].input_to_mesh_max, 5);
  EXPECT_EQ(report.per_label[2].mesh_to_input_max, 5);
  EXPECT_EQ(report.farthest()->label, 1U);
}

TEST(Distance, OneWayIsNotTheOther) {
  // A speck that the mesh has lost while a larger part of its label is still there.
  const SmallVolume v = volume_from({9, 3, 3}, 2, [](auto x, auto y, auto z) {
    return x == 0 || (x == 6 && y == 1 && z == 1) ? 1 : 0;
  });
  SmallMesh mesh = five_tet_mesh(v);
  for (std::size_t t = 0; t < mesh.labels.size(); ++t) {
    if (t / 5 % 9 == 6) mesh.labels[t] = 0;
  }
  const DistanceReport report = measure_distance(v.view(), 2, mesh.view(), {});
  for (const auto& row : report.per_label) {
    EXPECT_EQ(row.input_to_mesh_max, 6);
    EXPECT_EQ(row.mesh_to_input_max, 0);
  }
}

TEST(Distance, OfALostLabelIsInfiniteAndFails) {
  const SmallVolume v = volume_from({6, 3, 3}, 3, [](auto x, auto, auto) { return x / 2; });
  SmallMesh mesh = five_tet_mesh(v);
  std::replace(mesh.labels.begin(), mesh.labels.end(), Label{2}, Label{1});
  const AuditReport report = audit(v.view(), 3, mesh.view(), {});
  EXPECT_EQ(report.distance->only_in_volume, std::vector<Label>{2});
  EXPECT_EQ(report.distance->max_voxels, kInfinite);
  EXPECT_FALSE(report.distance->per_label[2].is_finite());
  EXPECT_EQ(report.distance->farthest()->max(), 2);  // label 1 lost its face at 4
  ASSERT_NE(distance_check(report), nullptr);
  EXPECT_FALSE(distance_check(report)->passed);
  EXPECT_NE(distance_check(report)->detail.find("(dense 2)"), std::string::npos)
      << distance_check(report)->detail;
}

TEST(Distance, OfALabelThatTheVolumeDoesNotHaveIsInfinite) {
  const SmallVolume v = halves();
  SmallMesh mesh = five_tet_mesh(v);
  mesh.labels[4] = kUnknown;
  const DistanceReport report = measure_distance(v.view(), 2, mesh.view(), {});
  EXPECT_EQ(report.only_in_mesh, std::vector<Label>{kUnknown});
  EXPECT_EQ(report.per_label.back().label, kUnknown);
}

TEST(Distance, OfOneLabelAloneIsNothing) {
  const SmallVolume v = volume_from({3, 2, 1}, 1, [](auto, auto, auto) { return 0; });
  const AuditReport report = audit(v.view(), 1, five_tet_mesh(v).view(), {}, {.max_distance = 0});
  EXPECT_TRUE(report.passed());
  EXPECT_TRUE(report.distance->per_label.empty());
  EXPECT_EQ(report.distance->max_voxels, 0);
}

TEST(Distance, BoundFailsAboveIt) {
  const SmallMesh mesh = shifted_halves(0.3);
  const auto check_with = [&](std::optional<double> bound) {
    return audit(halves().view(), 2, mesh.view(), {}, {.max_distance = bound});
  };
  EXPECT_EQ(distance_check(check_with({})), nullptr);
  EXPECT_TRUE(check_with({}).passed());
  EXPECT_TRUE(distance_check(check_with(0.3))->passed);
  EXPECT_TRUE(distance_check(check_with(0.2999995))->passed);
  EXPECT_FALSE(distance_check(check_with(0.299998))->passed);
  EXPECT_FALSE(distance_check(check_with(0))->passed);
}

TEST(Distance, IsLeftOutOnRequest) {
  AuditOptions options;
  options.measure_distance = false;
  const SmallMesh mesh = shifted_halves(0.3);
  EXPECT_FALSE(audit(halves().view(), 2, mesh.view(), {}, options).distance.has_value());
  EXPECT_TRUE(audit(halves().view(), 2, mesh.view(), {}).distance.has_value());
}

TEST(Distance, IsNotLookedAtWhenTheInputIsNoMesh) {
  SmallMesh mesh = shifted_halves(0.3);
  mesh.tets[5][1] = mesh.vertices.size();
  const AuditReport report = audit(halves().view(), 2, mesh.view(), {}, {.max_distance = 1});
  EXPECT_FALSE(report.distance.has_value());
  ASSERT_NE(distance_check(report), nullptr);
  EXPECT_FALSE(distance_check(report)->passed);
}

TEST(Distance, OfAMeshThatLeavesTheWorldComesToAnEnd) {
  SmallMesh mesh = shifted_halves(0.3);
  mesh.vertices[3][0] = 1e300;
  mesh.vertices[10][1] = -1e300;
  mesh.vertices[17][2] = 1e200;
  const DistanceReport report = measure_distance(halves().view(), 2, mesh.view(), {});
  EXPECT_GT(report.max_voxels, 1);
  EXPECT_TRUE(report.is_finite());
}

TEST(Distance, FacesAreThoseBetweenLabels) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 20; ++trial) {
    const SmallVolume v = random_volume(random);
    std::map<std::pair<Point, Point>, LabelPair> expected, found;
    for (const PlainFace& f : plain_faces(v)) expected[{f.lo, f.hi}] = {f.a, f.b};
    visit_interface_faces(v.view(), {{0, 0, 0}, v.shape},
                          [&](const VoxelFace& face, const LabelPair& labels) {
                            const Extent at = extent_of(face);
                            EXPECT_TRUE(found.emplace(std::pair(at.lo, at.hi), labels).second);
                          });
    EXPECT_EQ(found, expected) << v.text();
  }
}

/// The largest distances above the limit are those that are found without one.
TEST(Distance, LimitHidesNothingAboveIt) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 60; ++trial) {
    const SmallVolume v = random_volume(random);
    SmallMesh mesh = five_tet_mesh(v);
    shake(random, {}, trial % 3 == 0 ? 2.0 : 0.6, mesh);
    const auto fine = measure_distance(v.view(), v.label_count, mesh.view(), {}, {}, 0);
    const auto report = measure_distance(v.view(), v.label_count, mesh.view(), {}, {}, 0.5);
    EXPECT_LE(report.max_voxels, fine.max_voxels);
    EXPECT_EQ(report.mean_voxels, fine.mean_voxels);
    if (fine.max_voxels > 0.5) {
      EXPECT_EQ(report.max_voxels, fine.max_voxels);
    }
  }
}

}  // namespace
}  // namespace mw::audit
