// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Line edges and touches, against rings of tets in their order.
#include "kernels/surface/line_edges.h"

#include <set>
#include <vector>

#include "kernels/topology/edge_ring.h"
#include "tests/kernels/surface/interface_triangles.h"
#include "tests/oracle/small_volumes.h"

namespace mw::test {
namespace {

using audit::test::below;

/// How many labels there are around an edge, and how many stretches they make.
struct Around {
  std::size_t labels = 0;
  std::size_t stretches = 0;
};

Around around(const TetMesh& mesh, LocalVertex v, LocalVertex w) {
  EdgeRing ring;
  EXPECT_TRUE(collect_ring(mesh, v, w, ring));
  Around out{.labels = std::set<Label>(ring.labels.begin(), ring.labels.end()).size()};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring.labels[i] != ring.labels[(i + 1) % ring.size()]) ++out.stretches;
  }
  return out;
}

std::set<LocalVertex> neighbours(const TetMesh& mesh, LocalVertex v) {
  std::set<LocalVertex> out;
  for (const LinkTriangle& t : mesh.star(v)) out.insert({t.a, t.b, t.c});
  out.erase(mesh.infinity());
  return out;
}

TEST(LineEdges, HaveThreeLabelsAndAreTouchesWhereOneComesTwice) {
  std::mt19937 random(1213);
  int lines = 0, touches = 0, others = 0;
  LineEdges edges;
  for (std::uint32_t i = 0; i < 40 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    TetMesh mesh = dense_mesh(random_volume_of(random, kind, {7, 6, 7}, 3 + below(random, 3)));
    disturb(mesh, random);
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (!mesh.is_free(v)) continue;
      std::vector<LocalVertex> expected;
      for (const LocalVertex w : neighbours(mesh, v)) {
        const Around found = around(mesh, v, w);
        const bool on_line = found.labels >= 3, touch = on_line && found.stretches > found.labels;
        if (on_line) expected.push_back(w);
        ASSERT_EQ(edges.is_touch(mesh, v, w), touch) << v << ' ' << w;
        ++(touch ? touches : on_line ? lines : others);
      }
      const auto ends = edges.at(mesh, v);
      ASSERT_EQ(std::vector<LocalVertex>(ends.begin(), ends.end()), expected) << v;
    }
  }
  EXPECT_GT(lines, 1000);
  EXPECT_GT(touches, 100);
  EXPECT_GT(others, 1000);
}

}  // namespace
}  // namespace mw::test
