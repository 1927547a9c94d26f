// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The whole audit: sound meshes pass, and each way to break one is caught by the check meant for
// it.
#include "kernels/audit/audit.h"

#include <gmock/gmock.h>

#include "kernels/core/error.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_audit.h"
#include "tests/testing.h"

namespace mw::audit {
namespace {

using namespace test;
using testing::HasSubstr;

const Check& check(const AuditReport& report, const std::string& name) {
  const auto found = std::find_if(report.checks.begin(), report.checks.end(),
                                  [&](const Check& c) { return c.name == name; });
  if (found == report.checks.end()) throw std::out_of_range(name);
  return *found;
}

using Names = std::vector<std::string>;

/// A 4 x 4 x 4 box of label 0 with a bar of label 1 through it, off the origin.
class BrokenMesh : public ::testing::Test {
 protected:
  [[nodiscard]] AuditReport run() const { return audit(volume_.view(), 2, mesh_.view(), frame_); }

  /// A vertex inside the box.
  [[nodiscard]] static std::uint64_t inner_vertex() { return (2 * 5 + 2) * 5 + 2; }

  Frame frame_{{0.7, 0.7, 0.7}, {-3, 11, 0.1}};
  SmallVolume volume_ =
      volume_from({4, 4, 4}, 2, [](auto x, auto y, auto) { return x == 1 && y == 1 ? 1 : 0; });
  SmallMesh mesh_ = five_tet_mesh(volume_, frame_);
};

TEST(Audit, SoundMeshesPass) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 300; ++trial) {
    const SmallVolume v = random_volume(random);
    const Frame frame{{0.3, 0.3, 0.4}, {1e3, -7, 0.1}};
    const AuditReport report =
        audit(v.view(), v.label_count, five_tet_mesh(v, frame).view(), frame);
    ASSERT_EQ(failures(report), Names{}) << v.text();
    ASSERT_TRUE(report.passed() && !report.topology_is_indicative);
  }
}

/// Far from the origin, as EM in metres is, coordinates have few digits for the box.
TEST(Audit, SoundMeshesPassWhereCoordinatesAreCoarse) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 100; ++trial) {
    const SmallVolume v = random_volume(random);
    const Frame frame{{4e-9, 4e-9, 4e-9}, {0.5, -0.5, 0.5}};
    const AuditReport report =
        audit(v.view(), v.label_count, five_tet_mesh(v, frame).view(), frame);
    ASSERT_EQ(failures(report), Names{}) << v.text();
  }
}

/// A lost tet is more than rounding there, too.
TEST(Audit, RoundingHidesNoTet) {
  const SmallVolume v = volume_from({4, 4, 4}, 1, [](auto, auto, auto) { return 0; });
  const Frame frame{{4e-9, 4e-9, 4e-9}, {0.5, -0.5, 0.5}};
  SmallMesh mesh = five_tet_mesh(v, frame);
  mesh.tets.erase(mesh.tets.begin() + 100);
  mesh.labels.erase(mesh.labels.begin() + 100);
  EXPECT_FALSE(check(audit(v.view(), 1, mesh.view(), frame), "P2 volume").passed);
}

TEST(Audit, ChangeOfTheOpenRegionAloneIsAChange) {
  const SmallVolume pinched =
      volume_from({2, 2, 1}, 2, [](auto x, auto y, auto) { return (x + y) % 2; });
  const SmallVolume halves = volume_from({2, 2, 1}, 2, [](auto x, auto, auto) { return x; });
  const AuditReport report = audit(pinched.view(), 2, five_tet_mesh(halves).view(), {});
  EXPECT_EQ(failures(report), (Names{"P4 place", "P1 topology"}));
  EXPECT_EQ(report.labels_changed, (std::vector<Label>{0, 1}));
  EXPECT_EQ(report.voxels[0].closed, report.mesh[0].closed);
}

/// Labels 0 and 1 change places: each is a ball as before, but 1 no longer touches 2.
/// Closed regions may change where parts that touched them are gone.
TEST(Audit, MoreInALabelThatIsThereInPartIsAChange) {
  const RegionBetti voxels{.closed = {1, 2, 0}, .open = {3, 1, 1}};
  const auto topology_of = [&](const Betti& open, bool is_part) {
    AuditFindings findings{.voxels = {{}, voxels, {}},
                           .mesh = {{}, {.closed = {2, 3, 0}, .open = open}, {}}};
    findings.validity.checks = {{"P2 input", true, ""}};
    AuditOptions options{.kept = {false, true}};
    if (is_part) options.partial = {false, true};
    return check(judge(std::move(findings), options), "P1 topology").passed;
  };
  EXPECT_TRUE(topology_of({3, 1, 1}, true));
  EXPECT_TRUE(topology_of({1, 0, 0}, true));
  EXPECT_FALSE(topology_of({1, 0, 0}, false));
  for (const Betti& more : {Betti{4, 1, 1}, Betti{1, 2, 0}, Betti{1, 0, 2}}) {
    EXPECT_FALSE(topology_of(more, true));
  }
}

TEST(Audit, ChangeOfAnInterfaceAloneFailsOnlyWhenAskedFor) {
  const auto row = [](std::array<Label, 4> labels) {
    return volume_from({4, 1, 1}, 3,
                       [&](auto x, auto, auto) { return labels[static_cast<std::size_t>(x)]; });
  };
  const SmallVolume volume = row({0, 1, 2, 2}), other = row({1, 0, 2, 2});
  const SmallMesh mesh = five_tet_mesh(other);
  const AuditOptions labels{.measure_distance = false};
  const AuditOptions junctions{.count_junctions = true, .measure_distance = false};
  EXPECT_EQ(failures(audit(volume.view(), 3, mesh.view(), {}, labels)), Names{"P4 place"});
  const AuditReport report = audit(volume.view(), 3, mesh.view(), {}, junctions);
  EXPECT_EQ(failures(report), (Names{"P4 place", "P1 interfaces", "P1 meetings"}));
  EXPECT_EQ(report.junctions->interfaces, 5U);
  EXPECT_EQ(report.junctions->interfaces_changed.size(), 4U);
  const std::string& detail = check(report, "P1 interfaces").detail;
  for (const char* change :
       {"dense 0, dense 2: (0,0,0) -> (1,0,0)", "dense 1, dense 2: (1,0,0) -> (0,0,0)",
        "dense 0, exterior: (1,0,0) -> (1,1,0)"}) {
    EXPECT_NE(detail.find(change), std::string::npos) << detail;
  }
  EXPECT_TRUE(audit(other.view(), 3, mesh.view(), {}, junctions).passed());
}

TEST_F(BrokenMesh, IsSoundBeforeItIsBroken) {
  const AuditReport report = run();
  EXPECT_EQ(failures(report), Names{});
  EXPECT_EQ(report.voxels[0], (RegionBetti{{1, 1, 0}, {1, 1, 0}}));
}

TEST_F(BrokenMesh, AllTetsTurnedOver) {
  for (TetRow& tet : mesh_.tets) std::swap(tet[2], tet[3]);
  const AuditReport report = run();
  EXPECT_EQ(failures(report), Names{"P2 orientation"});
  EXPECT_THAT(check(report, "P2 orientation").detail, testing::StartsWith("0 positive"));
}

TEST_F(BrokenMesh, FlippedTet) {
  std::swap(mesh_.tets[17][0], mesh_.tets[17][1]);
  const AuditReport report = run();
  EXPECT_EQ(failures(report), Names{"P2 orientation"});
  EXPECT_NE(check(report, "P2 orientation").detail.find("(17)"), std::string::npos);
  EXPECT_TRUE(report.topology_is_indicative);
}

TEST_F(BrokenMesh, VertexMovedThroughItsNeighbour) {
  mesh_.vertices[inner_vertex()][0] += 0.8;
  const Names names = failures(run());
  EXPECT_NE(std::find(names.begin(), names.end(), "P2 orientation"), names.end());
  EXPECT_NE(std::find(names.begin(), names.end(), "P2 faces"), names.end());
}

TEST_F(BrokenMesh, VertexMovedALittleIsStillSound) {
  mesh_.vertices[inner_vertex()][0] += 0.1;
  EXPECT_EQ(failures(run()), Names{});
}

TEST_F(BrokenMesh, FlatTet) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& t = mesh_.tets[4 * 5];
    mesh_.vertices[t[0]][k] = (mesh_.vertices[t[1]][k] + mesh_.vertices[t[2]][k]) / 2;
  }
  const Check found = check(run(), "P2 orientation");
  EXPECT_FALSE(found.passed);
  EXPECT_THAT(found.detail, testing::Not(HasSubstr(" 0 flat")));
}

TEST_F(BrokenMesh, RemovedTet) {
  for (const std::size_t tet : {std::size_t{0}, std::size_t{4}, mesh_.tets.size() / 2}) {
    SmallMesh whole = mesh_;
    mesh_.tets.erase(mesh_.tets.begin() + static_cast<std::ptrdiff_t>(tet));
    mesh_.labels.erase(mesh_.labels.begin() + static_cast<std::ptrdiff_t>(tet));
    const AuditReport report = run();
    EXPECT_FALSE(check(report, "P2 faces").passed);
    EXPECT_FALSE(check(report, "P2 volume").passed);
    mesh_ = whole;
  }
}

TEST_F(BrokenMesh, RelabelledTetsThatCutTheBar) {
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    const bool second_layer = t / 5 / 16 == 1;
    if (second_layer) mesh_.labels[t] = 0;
  }
  const AuditReport report = run();
  EXPECT_EQ(failures(report), Names{"P1 topology"});
  EXPECT_EQ(report.labels_changed, (std::vector<Label>{0, 1}));
  EXPECT_FALSE(report.topology_is_indicative);
}

TEST_F(BrokenMesh, OneRelabelledTet) {
  mesh_.labels[5 * 63 + 4] = 1;  // the inner tet of the last voxel, away from the bar
  const AuditReport report = run();
  EXPECT_EQ(failures(report), (Names{"P1 topology", "P1 pinches"}));
  EXPECT_NE(check(report, "P1 topology").detail.find("dense 1 closed (1,0,0) -> (2,0,0)"),
            std::string::npos)
      << check(report, "P1 topology").detail;
}

TEST_F(BrokenMesh, DuplicatedTet) {
  constexpr std::size_t kInside = 5 * 42 + 4;
  mesh_.tets.push_back(mesh_.tets[kInside]);
  mesh_.labels.push_back(mesh_.labels[kInside]);
  std::swap(mesh_.tets.back()[1], mesh_.tets.back()[2]);
  std::swap(mesh_.tets.back()[0], mesh_.tets.back()[2]);
  const AuditReport report = run();
  EXPECT_FALSE(check(report, "P2 tets").passed);
  EXPECT_NE(check(report, "P2 faces").detail.find("4 triangles of three"), std::string::npos);
  EXPECT_FALSE(check(report, "P2 faces").passed);
  EXPECT_FALSE(check(report, "P2 volume").passed);
}

TEST_F(BrokenMesh, TetThatNamesAVertexTwice) {
  mesh_.tets[9][2] = mesh_.tets[9][1];
  const AuditReport report = run();
  EXPECT_THAT(check(report, "P2 orientation").detail, HasSubstr(" 1 flat"));
  EXPECT_FALSE(check(report, "P2 orientation").passed);
  EXPECT_FALSE(check(report, "P2 faces").passed);
}

TEST_F(BrokenMesh, Crack) {
  mesh_.vertices.push_back(mesh_.vertices[inner_vertex()]);
  const auto used = std::find_if(mesh_.tets.begin(), mesh_.tets.end(), [](const TetRow& t) {
    return std::find(t.begin(), t.end(), inner_vertex()) != t.end();
  });
  std::replace(used->begin(), used->end(), inner_vertex(),
               std::uint64_t{mesh_.vertices.size() - 1});
  const AuditReport report = run();
  EXPECT_EQ(failures(report).size(), 2U + (report.labels_changed.empty() ? 0 : 1));
  EXPECT_FALSE(check(report, "P2 vertices").passed);
  EXPECT_FALSE(check(report, "P2 faces").passed);
}

TEST_F(BrokenMesh, UnusedVertexFails) {
  mesh_.vertices.push_back({-2.9, 11.1, 0.2});
  const AuditReport report = run();
  EXPECT_EQ(failures(report), Names{"P2 vertices"});
  EXPECT_THAT(check(report, "P2 vertices").detail, HasSubstr("1 vertices in no tet"));
}

TEST_F(BrokenMesh, LabelThatIsNotInTheVolume) {
  mesh_.labels[3] = kUnknown;
  const AuditReport report = run();
  EXPECT_FALSE(check(report, "P2 labels").passed);
}

TEST_F(BrokenMesh, LostLabel) {
  std::fill(mesh_.labels.begin(), mesh_.labels.end(), 0);
  const AuditReport report = run();
  EXPECT_EQ(failures(report), (Names{"P2 labels", "P1 topology", "P4 distance"}));
  EXPECT_NE(check(report, "P2 labels").detail.find("dense 1"), std::string::npos);
}

TEST_F(BrokenMesh, VertexOffTheBox) {
  mesh_.vertices[2][2] += 1e-6;  // inwards, inside an edge of the box
  EXPECT_EQ(failures(run()), (Names{"P2 faces", "P2 volume"}));
  mesh_.vertices[2][2] -= 2e-6;  // outwards
  EXPECT_EQ(failures(run()), (Names{"P2 faces", "P2 box", "P2 volume"}));
}

TEST_F(BrokenMesh, VertexOffTheBoxByRounding) {
  mesh_.vertices[2][2] += 1e-12;
  EXPECT_EQ(failures(run()), Names{});
}

TEST_F(BrokenMesh, WrongSpacing) {
  frame_.spacing[1] = 0.71;
  EXPECT_EQ(failures(run()), (Names{"P2 faces", "P2 box", "P2 volume"}));
}

TEST_F(BrokenMesh, WrongOrigin) {
  frame_.origin[0] += 0.01;
  const AuditReport report = run();
  EXPECT_EQ(failures(report), (Names{"P2 faces", "P2 box"}));
}

TEST_F(BrokenMesh, MissingHalf) {
  mesh_.tets.resize(mesh_.tets.size() / 2);
  mesh_.labels.resize(mesh_.tets.size());
  const AuditReport report = run();
  EXPECT_FALSE(check(report, "P2 faces").passed);
  EXPECT_FALSE(check(report, "P2 volume").passed);
}

TEST_F(BrokenMesh, RowOutOfRangeStopsTheAudit) {
  mesh_.tets[5][1] = mesh_.vertices.size();
  const AuditReport report = run();
  EXPECT_EQ(failures(report), (Names{"P2 input", "P4 place", "P1 topology", "P1 pinches",
                                     "P3 radius ratio", "P8 volumes"}));
  EXPECT_NE(check(report, "P2 input").detail.find("tet 5"), std::string::npos);
}

TEST_F(BrokenMesh, EndlessCoordinateStopsTheAudit) {
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    mesh_.vertices[9][1] = bad;
    EXPECT_FALSE(check(run(), "P2 input").passed);
  }
}

TEST_F(BrokenMesh, EmptyMesh) {
  mesh_ = {};
  EXPECT_FALSE(run().passed());
}

TEST_F(BrokenMesh, QualityFloor) {
  AuditOptions strict;
  strict.radius_ratio_floor = 0.8;
  const AuditReport report = audit(volume_.view(), 2, mesh_.view(), frame_, strict);
  EXPECT_EQ(failures(report), Names{"P3 radius ratio"});
}

TEST_F(BrokenMesh, UnusableVolumeIsAnError) {
  EXPECT_THROW((void)audit(volume_.view(), 1, mesh_.view(), frame_), Error);
}

}  // namespace
}  // namespace mw::audit
