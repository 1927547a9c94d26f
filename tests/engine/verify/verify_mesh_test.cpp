// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Verification by tiles against the audit of the whole, whatever the tiles and threads.
#include "engine/verify/verify_mesh.h"

#include <regex>

#include "engine/system/in_order.h"
#include "kernels/core/lattice.h"
#include "tests/engine/memory_run.h"
#include "tests/oracle/whole_audit.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using audit::AuditOptions;
using audit::AuditReport;
using namespace audit::test;
using test::MemoryVolume;

/// A volume and a mesh that need not be good.
struct Case {
  SmallVolume volume;  ///< every label occurs
  SmallMesh mesh;
  audit::Frame frame;
  AuditOptions options;
};

/// Labels without gaps.
void close_ranks(SmallVolume& volume) {
  std::vector<Label> seen = volume.labels;
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  for (Label& label : volume.labels) {
    label = static_cast<Label>(std::lower_bound(seen.begin(), seen.end(), label) - seen.begin());
  }
  volume.label_count = seen.size();
}

/// Something that a mesh must not do, or nothing.
void damage(std::mt19937& random, SmallMesh& mesh, const audit::Frame& frame) {
  const auto some = [&](std::size_t count) {
    return below(random, static_cast<std::uint32_t>(count));
  };
  switch (some(9)) {
    case 0:
      mesh.labels[some(mesh.labels.size())] = some(6) == 0 ? audit::kUnknown : 0;
      break;
    case 1:
      for (audit::Position& p : mesh.vertices) {
        for (std::size_t k = 0; k < 3; ++k) p[k] += frame.spacing[k] * (some(2001) - 1000.0) / 2000;
      }
      break;
    case 2: {
      audit::TetRow& tet = mesh.tets[some(mesh.tets.size())];
      std::swap(tet[0], tet[1]);
      break;
    }
    case 3:
      mesh.tets.push_back(mesh.tets[some(mesh.tets.size())]);
      mesh.labels.push_back(mesh.labels.back());
      break;
    case 4:
      mesh.tets.pop_back();
      mesh.labels.pop_back();
      break;
    case 5:
      mesh.vertices[some(mesh.vertices.size())] = mesh.vertices[some(mesh.vertices.size())];
      break;
    case 6:
      mesh.vertices.push_back(mesh.vertices[some(mesh.vertices.size())]);
      break;
    default:
      break;
  }
}

Case random_case(std::mt19937& random) {
  Case out;
  const auto edge = [&] { return std::int64_t{1 + below(random, 9)}; };
  const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
  out.volume = random_volume_of(random, kind, {edge(), edge(), edge()}, 1 + below(random, 6));
  close_ranks(out.volume);
  if (below(random, 3) == 0) out.frame = {{1, 1, 0.5 + 0.5 * below(random, 6)}, {-3, 5.5, 100}};
  out.mesh = five_tet_mesh(out.volume, out.frame);
  damage(random, out.mesh, out.frame);
  if (below(random, 2) == 0) out.options.layers = layers_of(out.frame.spacing);
  if (below(random, 2) == 0) out.options.max_distance = 0.3 * below(random, 5);
  out.options.count_junctions = below(random, 4) == 0;
  if (!out.options.count_junctions && below(random, 4) == 0) {
    for (Label l = 0; l < out.volume.label_count; ++l) out.options.kept.push_back(l % 2 == 0);
    SmallMesh rest{out.mesh.vertices, {}, {}};
    for (std::size_t t = 0; t < out.mesh.tets.size(); ++t) {
      if (out.mesh.labels[t] % 2 != 0) continue;
      rest.tets.push_back(out.mesh.tets[t]);
      rest.labels.push_back(out.mesh.labels[t]);
    }
    out.mesh = rest;
  }
  return out;
}

/// Gives a mesh to tiles, a few tets at a time, on several threads.
void write_by_ranges(const io::MeshData& mesh, MeshTiles& tiles, int threads) {
  constexpr std::size_t kTets = 7;
  tiles.begin({.tets = mesh.tets.size()});
  tiles.write_vertices(mesh.vertices);
  each_in_order<MeshTiles::TetShare>(
      {threads}, (mesh.tets.size() + kTets - 1) / kTets,
      [&](std::size_t range) {
        const std::size_t first = range * kTets, count = std::min(kTets, mesh.tets.size() - first);
        return tiles.look_at(first, std::span(mesh.tets).subspan(first, count),
                             std::span(mesh.labels).subspan(first, count));
      },
      [&](std::size_t, MeshTiles::TetShare&& found) { tiles.add(found); });
  tiles.finish();
}

AuditReport by_tiles(const Case& c, std::int64_t edge, int threads) {
  const ::mw::test::TempFolder folder;
  const MemoryVolume volume(c.volume, c.frame);
  const io::LabelTable table = io::collect_labels(volume);
  MeshTiles tiles(volume.info(), table, {folder.path(), 1 << 16, edge});
  io::MeshData mesh;
  mesh.vertices = c.mesh.vertices;
  mesh.tets = c.mesh.tets;
  for (const Label l : c.mesh.labels)
    mesh.labels.push_back(l == audit::kUnknown ? 999 : table.raw(l));
  threads > 1 ? write_by_ranges(mesh, tiles, threads) : io::write_mesh(mesh, tiles);
  return verify_mesh(
      io::DenseVolume(volume, table), tiles,
      {.options = c.options, .threads = threads, .memory_bytes = 1 << 22, .folder = folder.path()});
}

void expect_near(double a, double b) {
  EXPECT_NEAR(a, b, 1e-9 * (1 + std::abs(b)));
}

void expect_same_distance(const audit::DistanceReport& tiled, const audit::DistanceReport& whole) {
  EXPECT_EQ(tiled.only_in_volume, whole.only_in_volume);
  EXPECT_EQ(tiled.only_in_mesh, whole.only_in_mesh);
  ASSERT_EQ(tiled.per_label.size(), whole.per_label.size());
  EXPECT_EQ(tiled.far_samples, 0U);
  if (whole.is_finite() && std::max(tiled.max_voxels, whole.max_voxels) > whole.limit) {
    EXPECT_NEAR(tiled.max_voxels, whole.max_voxels, 1e-9);
  }
  if (whole.is_finite()) {
    EXPECT_NEAR(tiled.mean_voxels, whole.mean_voxels, 1e-9);
  }
  for (std::size_t i = 0; i < whole.per_label.size(); ++i) {
    EXPECT_EQ(tiled.per_label[i].label, whole.per_label[i].label);
    EXPECT_EQ(tiled.per_label[i].is_finite(), whole.per_label[i].is_finite());
  }
}

bool counts_whole_things(const std::string& check) {
  return check == "P2 orientation" || check == "P2 vertices" || check == "P2 tets" ||
         check == "P2 faces" || check == "P2 labels" || check == "P4 place";
}

/// Tiles name other offenders first, and none has a vertex that is in no tet, so that it is not
/// seen to be where another one is.
std::string without_names(const std::string& detail) {
  const std::regex varies(R"(\d+ vertices where another one is[^;]*; | \([^)]*\))");
  return std::regex_replace(detail, varies, "");
}

void expect_same(const AuditReport& tiled, const AuditReport& whole) {
  ASSERT_EQ(tiled.checks.size(), whole.checks.size());
  for (std::size_t i = 0; i < whole.checks.size(); ++i) {
    EXPECT_EQ(tiled.checks[i].name, whole.checks[i].name);
    EXPECT_EQ(tiled.checks[i].passed, whole.checks[i].passed)
        << tiled.checks[i].detail << "\nwhole: " << whole.checks[i].detail;
    if (!counts_whole_things(whole.checks[i].name)) continue;
    EXPECT_EQ(without_names(tiled.checks[i].detail), without_names(whole.checks[i].detail));
  }
  EXPECT_EQ(tiled.voxels, whole.voxels);
  EXPECT_EQ(tiled.mesh, whole.mesh);
  EXPECT_EQ(tiled.labels_changed, whole.labels_changed);
  EXPECT_EQ(tiled.pinches.voxels, whole.pinches.voxels);
  EXPECT_EQ(tiled.pinches.mesh, whole.pinches.mesh);
  if (!whole.checks.front().passed) return;
  expect_near(tiled.validity.volume, whole.validity.volume);
  EXPECT_EQ(tiled.quality.radius_ratio_min, whole.quality.radius_ratio_min);
  EXPECT_EQ(tiled.quality.worst_tet, whole.quality.worst_tet);
  EXPECT_EQ(tiled.quality.dihedral_histogram, whole.quality.dihedral_histogram);
  expect_near(tiled.quality.radius_ratio_mean, whole.quality.radius_ratio_mean);
  EXPECT_EQ(tiled.shape.triangles, whole.shape.triangles);
  expect_near(tiled.shape.area, whole.shape.area);
  expect_near(tiled.shape.sharp_share, whole.shape.sharp_share);
  ASSERT_EQ(tiled.volumes.per_label.size(), whole.volumes.per_label.size());
  EXPECT_EQ(tiled.volumes.exact, whole.volumes.exact);
  for (std::size_t i = 0; i < whole.volumes.per_label.size(); ++i) {
    EXPECT_EQ(tiled.volumes.per_label[i].voxels, whole.volumes.per_label[i].voxels);
    expect_near(tiled.volumes.per_label[i].error, whole.volumes.per_label[i].error);
  }
  ASSERT_EQ(tiled.distance.has_value(), whole.distance.has_value());
  if (whole.distance) expect_same_distance(*tiled.distance, *whole.distance);
  ASSERT_EQ(tiled.junctions.has_value(), whole.junctions.has_value());
  if (whole.junctions) {
    EXPECT_EQ(tiled.junctions->interfaces, whole.junctions->interfaces);
    EXPECT_EQ(tiled.junctions->meetings, whole.junctions->meetings);
    EXPECT_EQ(tiled.junctions->interfaces_changed, whole.junctions->interfaces_changed);
    EXPECT_EQ(tiled.junctions->meetings_changed, whole.junctions->meetings_changed);
  }
}

TEST(VerifyMesh, IsTheAuditOfTheWholeWhateverTheTiles) {
  std::mt19937 random(4711);
  for (int trial = 0; trial < 400 && !HasFailure(); ++trial) {
    const Case c = random_case(random);
    SCOPED_TRACE("trial " + std::to_string(trial) + "\n" + c.volume.text());
    const AuditReport whole = audit::test::audit(c.volume.view(), c.volume.label_count,
                                                 c.mesh.view(), c.frame, c.options);
    expect_same(by_tiles(c, 1 + trial % 5, 1), whole);
    expect_same(by_tiles(c, 2, 3), whole);
  }
}

TEST(VerifyMesh, SaysWhereAMeshIsNone) {
  Case c;
  c.volume = audit::test::volume_from({5, 4, 3}, 2, [](auto x, auto, auto) { return x > 2; });
  c.mesh = five_tet_mesh(c.volume);
  c.mesh.tets[7][2] = 10'000;
  const AuditReport report = by_tiles(c, 2, 2);
  EXPECT_FALSE(report.checks.front().passed);
  EXPECT_NE(report.checks.front().detail.find("tet 7 names vertex 10000"), std::string::npos);
  c.mesh = five_tet_mesh(c.volume);
  c.mesh.vertices[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(by_tiles(c, 2, 2).checks.front().passed);
  c.mesh = {};
  EXPECT_FALSE(by_tiles(c, 2, 2).checks.front().passed);
}

/// A part of a label that the mesh lost is farther away than a tile and its surroundings.
TEST(VerifyMesh, LooksAsFarAsItMust) {
  Case c;
  c.volume = audit::test::volume_from({60, 3, 3}, 2, [](auto x, auto y, auto z) {
    return x == 0 || (x == 50 && y == 1 && z == 1) ? 1 : 0;
  });
  c.mesh = five_tet_mesh(c.volume);
  for (std::size_t t = 0; t < c.mesh.labels.size(); ++t) {
    if (t / 5 % 60 == 50) c.mesh.labels[t] = 0;
  }
  const AuditReport report = by_tiles(c, 4, 2);
  EXPECT_EQ(report.distance->max_voxels, 50);
  EXPECT_EQ(report.distance->far_samples, 0U);
}

TEST(ReadersOfThread, AreEightTogetherAndFewerWhereMemoryIsLittle) {
  EXPECT_EQ(readers_of_thread(1, 0, 1000), 1);
  EXPECT_EQ(readers_of_thread(1, 10, 1000), 8);
  EXPECT_EQ(readers_of_thread(3, 10, 1000), 3);
  EXPECT_EQ(readers_of_thread(8, 10, 1000), 1);
  EXPECT_EQ(readers_of_thread(1, 10, 59), 5);
  EXPECT_EQ(readers_of_thread(3, 10, 59), 1);
}

}  // namespace
}  // namespace mw::engine
