// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers of meetings and interfaces against ranks of boundary matrices.
#include "kernels/audit/topology/junctions.h"

#include <gtest/gtest.h>

#include "kernels/core/error.h"
#include "tests/oracle/cell_complex.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_junctions.h"

namespace mw::audit {
namespace {

using test::below;
using test::BettiOfJunctions;
using test::complex_of;
using test::five_tet_mesh;
using test::JunctionBetti;
using test::junctions_of;
using test::junctions_of_mesh;
using test::junctions_of_volume;
using test::JunctionsBetti;
using test::Places;
using test::random_volume;
using test::random_volume_of;
using test::SmallMesh;
using test::SmallVolume;
using test::volume_from;
using test::VolumeKind;

BettiOfJunctions by_set(const std::vector<JunctionBetti>& junctions) {
  BettiOfJunctions out;
  for (const JunctionBetti& p : junctions) {
    std::set<Label> labels(p.labels.begin(), p.labels.end());
    labels.erase(kNoLabel);
    EXPECT_TRUE(out.emplace(labels, p.betti).second);
  }
  return out;
}

void expect_equal(const Places& junctions, const JunctionsBetti& oracle, const std::string& text) {
  EXPECT_TRUE(by_set(junctions.interfaces) == oracle.interfaces) << text;
  EXPECT_TRUE(by_set(junctions.meetings) == oracle.meetings) << text;
}

/// Volumes and five-tet meshes, and meshes whose tets bear any labels.
TEST(Places, AreThoseOfTheOracle) {
  std::mt19937 random(21);
  std::size_t cavities = 0, tunnels = 0;
  for (int trial = 0; trial < 400 && !HasFailure(); ++trial) {
    const SmallVolume v = random_volume(random);
    SmallMesh mesh = five_tet_mesh(v);
    const Places junctions = junctions_of_volume(v.view(), v.label_count);
    expect_equal(junctions, junctions_of(complex_of(v.view(), v.label_count)), v.text());
    expect_equal(junctions_of_mesh(mesh.view(), v.label_count),
                 junctions_of(complex_of(mesh.view(), v.label_count)), v.text());
    for (Label& l : mesh.labels) {
      if (below(random, 8) == 0) l = below(random, static_cast<std::uint32_t>(v.label_count));
    }
    expect_equal(junctions_of_mesh(mesh.view(), v.label_count),
                 junctions_of(complex_of(mesh.view(), v.label_count)), v.text());
    for (const JunctionBetti& p : junctions.interfaces) {
      cavities += p.betti.b2 > 0 ? 1 : 0;
      tunnels += p.betti.b1 > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(cavities, 100U);
  EXPECT_GT(tunnels, 100U);
}

TEST(Places, AreThoseOfTheOracleForManyLabels) {
  std::mt19937 random(22);
  for (int trial = 0; trial < 40 && !HasFailure(); ++trial) {
    const SmallVolume v = random_volume_of(random, VolumeKind::kNoise, {3, 4, 3}, 12);
    expect_equal(junctions_of_volume(v.view(), v.label_count),
                 junctions_of(complex_of(v.view(), v.label_count)), v.text());
    const SmallMesh mesh = five_tet_mesh(v);
    expect_equal(junctions_of_mesh(mesh.view(), v.label_count),
                 junctions_of(complex_of(mesh.view(), v.label_count)), v.text());
  }
}

/// Two voxels that share an edge meet there, with no interface; the exterior wraps everything.
TEST(Places, ContactThroughAnEdgeIsAMeetingButNoInterface) {
  const SmallVolume v =
      volume_from({2, 2, 1}, 3, [](auto x, auto y, auto) { return x != y ? 0 : 1 + x; });
  const Places junctions = junctions_of_volume(v.view(), 3);
  const JunctionLabels one_two{1, 2, kNoLabel, kNoLabel};
  const auto is = [&](const JunctionBetti& p) { return p.labels == one_two; };
  EXPECT_EQ(std::count_if(junctions.interfaces.begin(), junctions.interfaces.end(), is), 0);
  const auto met = std::find_if(junctions.meetings.begin(), junctions.meetings.end(), is);
  ASSERT_NE(met, junctions.meetings.end());
  EXPECT_EQ(met->betti, (Betti{1, 0, 0}));
}

TEST(Places, RefuseUnsoundInput) {
  const std::vector<Label> labels{0, 1};
  EXPECT_THROW((void)junctions_of_volume({{1, 1, 1}, labels}, 2), Error);
  const std::vector<Position> vertices(4);
  const std::vector<TetRow> tets{{0, 1, 2, 4}};
  EXPECT_THROW((void)junctions_of_mesh({vertices, tets, std::span(labels).first(1)}, 1), Error);
}

}  // namespace
}  // namespace mw::audit
