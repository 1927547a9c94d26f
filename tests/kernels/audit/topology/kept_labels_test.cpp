// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Audits of meshes from which labels were left out: sound ones pass, broken ones do not.
#include "kernels/audit/audit.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_audit.h"
#include "tests/testing.h"

namespace mw::audit {
namespace {

using namespace test;

using Names = std::vector<std::string>;

/// Some of the labels that the volume has, but not all; empty when it has only one.
KeptLabels random_choice(const SmallVolume& v, std::mt19937& random) {
  KeptLabels kept(v.label_count);
  std::vector<Label> there = v.labels;
  std::sort(there.begin(), there.end());
  there.erase(std::unique(there.begin(), there.end()), there.end());
  if (there.size() < 2) return {};
  for (const Label label : there) kept[label] = below(random, 2) == 0;
  const Label one = there[below(random, static_cast<std::uint32_t>(there.size()))];
  kept[one] = true;
  Label other = one;
  while (other == one) other = there[below(random, static_cast<std::uint32_t>(there.size()))];
  kept[other] = false;
  return kept;
}

TEST(KeptLabels, SoundMeshesPass) {
  std::mt19937 random(21);
  int audited = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const SmallVolume v = random_volume(random);
    const KeptLabels kept = random_choice(v, random);
    if (kept.empty()) continue;
    ++audited;
    const Frame frame{{0.3, 0.3, 0.4}, {1e3, -7, 0.1}};
    const SmallMesh mesh = kept_part(five_tet_mesh(v, frame), kept);
    AuditOptions options{.max_distance = 1e-5};
    options.kept = kept;
    const AuditReport report = audit(v.view(), v.label_count, mesh.view(), frame, options);
    ASSERT_EQ(failures(report), Names{}) << v.text();
    // Without a word about what was left out the same mesh is no partition of the box.
    const AuditReport strict = audit(v.view(), v.label_count, mesh.view(), frame);
    ASSERT_FALSE(strict.passed()) << v.text();
    // A label of which nothing is there is lost, and one that should not be there is found.
    options.kept.flip();
    const AuditReport flipped = audit(v.view(), v.label_count, mesh.view(), frame, options);
    const Names failed = failures(flipped);
    ASSERT_NE(std::find(failed.begin(), failed.end(), "P2 labels"), failed.end()) << v.text();
  }
  EXPECT_GT(audited, 200);
}

/// A box of 8 x 8 x 8: label 0 around a block of label 1, in which a bar of label 2 ends.
class BrokenKeptMesh : public ::testing::Test {
 protected:
  BrokenKeptMesh() { options_.kept = {false, true, true}; }

  [[nodiscard]] AuditReport run() const {
    return audit(volume_.view(), 3, mesh_.view(), frame_, options_);
  }
  [[nodiscard]] Names failed() const { return failures(run()); }

  /// Returns a tet of the label whose vertices are all at least `depth` voxels inside the block.
  [[nodiscard]] std::size_t inner_tet(Label label, double depth) const {
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      const bool is_inside = std::all_of(mesh_.tets[t].begin(), mesh_.tets[t].end(), [&](auto v) {
        const Position& p = mesh_.vertices[v];
        return std::all_of(p.begin(), p.end(),
                           [&](double x) { return x >= 1 + depth && x <= 7 - depth; });
      });
      if (mesh_.labels[t] == label && is_inside) return t;
    }
    throw std::out_of_range("no such tet");
  }
  void remove(std::size_t tet) {
    mesh_.tets.erase(mesh_.tets.begin() + static_cast<std::ptrdiff_t>(tet));
    mesh_.labels.erase(mesh_.labels.begin() + static_cast<std::ptrdiff_t>(tet));
  }

  Frame frame_;
  AuditOptions options_;
  SmallVolume volume_ = volume_from({8, 8, 8}, 3, [](auto x, auto y, auto z) {
    if (std::min({x, y, z}) < 1 || std::max({x, y, z}) > 6) return 0;
    return x == 5 && y == 5 && z > 2 ? 2 : 1;
  });
  SmallMesh mesh_ = kept_part(five_tet_mesh(volume_, frame_), {false, true, true});
};

TEST_F(BrokenKeptMesh, IsSoundAsItIs) {
  const AuditReport report = run();
  EXPECT_EQ(failures(report), Names{});
  ASSERT_EQ(report.volumes.per_label.size(), 2U);
  EXPECT_EQ(report.volumes.per_label[0].error, 0);
  ASSERT_TRUE(report.distance);
  EXPECT_EQ(report.distance->per_label.back().label, kLeftOut);
  EXPECT_NEAR(report.distance->max_voxels, 0, 1e-9);
}

TEST_F(BrokenKeptMesh, MissingTet) {
  remove(inner_tet(1, 1));
  EXPECT_EQ(failed(), Names{"P1 topology"});
}

/// Far from all that was left out there may be none, whatever the topology.
TEST_F(BrokenKeptMesh, HoleBetweenKeptLabels) {
  remove(inner_tet(2, 1));
  options_.max_distance = 0.3;
  const Names names = failed();
  EXPECT_NE(std::find(names.begin(), names.end(), "P4 distance"), names.end());
}

TEST_F(BrokenKeptMesh, HoleAroundAVertex) {
  const std::uint64_t v = mesh_.tets[inner_tet(1, 2)][0];
  for (std::size_t t = mesh_.tets.size(); t-- > 0;) {
    const TetRow& tet = mesh_.tets[t];
    if (std::find(tet.begin(), tet.end(), v) != tet.end()) remove(t);
  }
  EXPECT_EQ(failed(), (Names{"P2 vertices", "P1 topology"}));
}

TEST_F(BrokenKeptMesh, SwappedLabel) {
  mesh_.labels[inner_tet(1, 1)] = 2;
  EXPECT_EQ(failed(), Names{"P1 topology"});
}

TEST_F(BrokenKeptMesh, LabelThatWasLeftOut) {
  mesh_.labels[inner_tet(1, 1)] = 0;
  const Names names = failed();
  EXPECT_NE(std::find(names.begin(), names.end(), "P2 labels"), names.end());
}

TEST_F(BrokenKeptMesh, TetTurnedOver) {
  TetRow& tet = mesh_.tets[inner_tet(1, 1)];
  std::swap(tet[0], tet[1]);
  const Names names = failed();
  EXPECT_NE(std::find(names.begin(), names.end(), "P2 orientation"), names.end());
}

/// The bar, once more and half a voxel aside, on vertices of its own.
TEST_F(BrokenKeptMesh, TetsThatOverlap) {
  const std::size_t tets = mesh_.tets.size();
  for (std::size_t t = 0; t < tets; ++t) {
    if (mesh_.labels[t] != 2) continue;
    TetRow tet = mesh_.tets[t];
    for (std::uint64_t& v : tet) {
      const Position p = mesh_.vertices[v];
      const Position moved{p[0] - 2.5, p[1] - 2, p[2] - 0.25};
      const auto found = std::find(mesh_.vertices.begin(), mesh_.vertices.end(), moved);
      v = static_cast<std::uint64_t>(found - mesh_.vertices.begin());
      if (found == mesh_.vertices.end()) mesh_.vertices.push_back(moved);
    }
    mesh_.tets.push_back(tet);
    mesh_.labels.push_back(2);
  }
  const Names names = failed();
  EXPECT_NE(std::find(names.begin(), names.end(), "P2 overlap"), names.end());
}

TEST_F(BrokenKeptMesh, LabelThatIsFarAwayFromWhereItWas) {
  for (Position& p : mesh_.vertices) p[0] += 0.5;
  options_.max_distance = 0.4;
  const Names names = failed();
  EXPECT_EQ(names, Names{"P4 distance"});
}

TEST_F(BrokenKeptMesh, LostVolume) {
  volume_ = volume_from({12, 12, 12}, 2, [](auto x, auto, auto) { return x < 9 ? 1 : 0; });
  mesh_ = kept_part(five_tet_mesh(volume_, frame_), {false, true});
  options_.kept = {false, true};
  const auto failed_now = [&] {
    return failures(audit(volume_.view(), 2, mesh_.view(), frame_, options_));
  };
  EXPECT_EQ(failed_now(), Names{});
  for (Position& p : mesh_.vertices) p[0] *= 8.4 / 9;
  EXPECT_EQ(failed_now(), Names{"P8 volumes"});
}

}  // namespace
}  // namespace mw::audit
