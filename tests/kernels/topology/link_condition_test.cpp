// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 1 at its root: no contraction that the collapse test accepts changes a Betti number.
#include "kernels/topology/link_condition.h"

#include "kernels/simplify/simplify.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

/// Contractions with all survivors positive, by what the oracle and the test say about them.
struct Counts {
  int accepted = 0;            ///< all of them kept by the oracle, or the test fails
  int refused_but_kept = 0;    ///< Betti numbers would not change, still refused
  int refused_and_broken = 0;  ///< Betti numbers would change
  int of_many_labels = 0;      ///< judged with more than four labels at the two ends

  Counts& operator+=(const Counts& o) {
    accepted += o.accepted;
    refused_but_kept += o.refused_but_kept;
    refused_and_broken += o.refused_and_broken;
    of_many_labels += o.of_many_labels;
    return *this;
  }
};

std::size_t labels_at(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
  std::set<Label> labels;
  for (const LinkTriangle& t : mesh.star(p)) labels.insert(t.label);
  for (const LinkTriangle& t : mesh.star(q)) labels.insert(t.label);
  return labels.size();
}

/// Judges random edges of one mesh and contracts those that are accepted, one after the other.
class Trial {
 public:
  Trial(const SmallVolume& volume, TetMesh& mesh, std::mt19937& random)
      : mesh_(mesh),
        random_(random),
        label_count_(volume.label_count),
        expected_(betti(volume)),
        long_lived_(mesh) {}

  Counts run(int tries) {
    for (int i = 0; i < tries && !::testing::Test::HasFailure(); ++i) judge_random_edge();
    return counts_;
  }

 private:
  void judge_random_edge() {
    const auto [p, q] = random_edge(mesh_, random_);
    if (p == q) return;
    const bool one_inner = mesh_.order(p) == 1 || mesh_.order(q) == 1;
    const auto x = contraction_target(mesh_, p, q, below(random_, 3));
    if (!x || !stays_positive(mesh_, p, q, *x)) return;
    const bool accepted = verdict(p, q);
    if (one_inner) {
      EXPECT_TRUE(accepted) << "Cases 1 and 2 keep every region as a point set";
    } else {
      count(p, q, accepted);
    }
    if (accepted) contract(p, q, *x);
  }

  /// Asks a LinkCondition that was used before and a new one, in both directions.
  bool verdict(LocalVertex p, LocalVertex q) {
    LinkCondition fresh(mesh_);
    const bool accepted = fresh.keeps_topology(mesh_, p, q);
    EXPECT_EQ(LinkCondition(mesh_).keeps_topology(mesh_, q, p), accepted);
    EXPECT_EQ(long_lived_.keeps_topology(mesh_, p, q), accepted);
    EXPECT_EQ(long_lived_.keeps_topology(mesh_, q, p), accepted);
    return accepted;
  }

  void count(LocalVertex p, LocalVertex q, bool accepted) {
    const bool kept = betti(mesh_, contracted(mesh_.tets(), p, q), label_count_) == expected_;
    EXPECT_TRUE(kept || !accepted) << "accepted, but a Betti number changes";
    counts_.accepted += accepted ? 1 : 0;
    counts_.refused_but_kept += kept && !accepted ? 1 : 0;
    counts_.refused_and_broken += kept ? 0 : 1;
    counts_.of_many_labels += labels_at(mesh_, p, q) > 4 ? 1 : 0;
  }

  void contract(LocalVertex keep, LocalVertex drop, Point x) {
    const bool inner = mesh_.order(keep) == 1 || mesh_.order(drop) == 1;
    std::set<TetKey> expected, actual;
    for (const LocalTet& t : contracted(mesh_.tets(), keep, drop)) expected.insert(tet_key(t));
    mesh_.contract(keep, drop, x, mesh_.quadric(keep));
    for (const LocalTet& t : mesh_.tets()) actual.insert(tet_key(t));
    EXPECT_TRUE(actual == expected);
    EXPECT_TRUE(!inner || betti(mesh_, label_count_) == expected_);
  }

  TetMesh& mesh_;
  std::mt19937& random_;
  std::size_t label_count_;
  std::vector<RegionBetti> expected_;
  LinkCondition long_lived_;
  Counts counts_;
};

Counts judge(const SmallVolume& volume, std::mt19937& random, int tries) {
  SCOPED_TRACE(volume.text());
  TetMesh mesh = dense_mesh(volume);
  if (below(random, 2) == 0) disturb(mesh, random);
  return Trial(volume, mesh, random).run(tries);
}

TEST(Sec533Case3, AcceptedContractionsKeepBettiNumbers) {
  std::mt19937 random(301);
  Counts counts;
  for (int i = 0; i < 400 && !HasFailure(); ++i) counts += judge(random_volume(random), random, 50);
  EXPECT_GT(counts.refused_and_broken, 100);
  // Link equality is sufficient, not necessary: when this was written, 98 % of those that keep the
  // numbers were accepted (4728 of 4830 on 400 volumes).
  EXPECT_GT(counts.accepted, 19 * counts.refused_but_kept);
}

/// With more than four labels around an edge the label list of the test outgrows its first
/// allocation; an index taken from an iterator after that was wrong once.
TEST(Sec533Case3, AcceptedContractionsKeepBettiNumbersOfManyLabels) {
  std::mt19937 random(302);
  Counts counts;
  for (int i = 0; i < 400 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 2, 3);
    counts += judge(random_volume_of(random, VolumeKind::kNoise, shape, 8), random, 50);
  }
  EXPECT_GT(counts.of_many_labels, 500);
  EXPECT_GT(counts.refused_and_broken, 100);
  // 96 % when this was written (1683 of 1746).
  EXPECT_GT(counts.accepted, 9 * counts.refused_but_kept);
}

/// Other numbers in the same order.
std::vector<Label> sparse_names(std::size_t count, std::mt19937& random) {
  std::vector<Label> out;
  for (Label next = 0; out.size() < count; next += 1 + below(random, 1000)) out.push_back(next);
  return out;
}

TEST(LinkCondition, VerdictDoesNotDependOnWhatLabelsAreCalled) {
  std::mt19937 random(303);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 60; ++i) {
    const std::vector<Label> names = sparse_names(5, random);
    const SmallVolume volume = random_volume_of(random, VolumeKind::kNoise, {3, 3, 2}, 5);
    SmallVolume renamed = volume;
    for (Label& l : renamed.labels) l = names[l];
    const TetMesh mesh = dense_mesh(volume), other = dense_mesh(renamed);
    LinkCondition test(mesh), other_test(other);
    for (int k = 0; k < 50; ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p == q) continue;
      const bool verdict = test.keeps_topology(mesh, p, q);
      ASSERT_EQ(other_test.keeps_topology(other, p, q), verdict) << volume.text();
      (verdict ? accepted : refused) += 1;
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 100);
}

/// More labels than there are bits: signatures decide early in simplify(), and labels that they
/// confuse must not be confused in the end, whatever numbers they have.
TEST(Promise1Topology, HoldsInAWindowOfLabelsThatShareBits) {
  std::mt19937 random(304);
  std::uint64_t contracted_edges = 0;
  for (int i = 0; i < 12 && !HasFailure(); ++i) {
    const SmallVolume volume = random_volume_of(random, VolumeKind::kNoise, {5, 5, 5}, 90);
    SCOPED_TRACE(volume.text());
    const std::vector<Label> names = sparse_names(volume.label_count, random);
    SmallVolume renamed = volume;
    for (Label& l : renamed.labels) l = names[l];
    TetMesh mesh = dense_mesh(volume), other = dense_mesh(renamed);
    contracted_edges += simplify(mesh, Metric(), {}).contracted;
    simplify(other, Metric(), {});
    std::vector<LocalTet> tets = mesh.tets(), other_tets = other.tets();
    EXPECT_TRUE(betti(mesh, tets, volume.label_count) == betti(volume));
    ASSERT_EQ(other_tets.size(), tets.size());
    for (std::size_t t = 0; t < tets.size(); ++t) {
      EXPECT_EQ(other_tets[t].vertices, tets[t].vertices);
      EXPECT_EQ(other_tets[t].label, names[tets[t].label]);
    }
  }
  EXPECT_GT(contracted_edges, 100U);
}

/// An edge (0, 1) in the axis of a ring of n vertices, each ring tet of its own label.
class Fan {
 public:
  explicit Fan(LocalVertex n) : n_(n) {
    add_vertex({0, 0, -50000});
    add_vertex({0, 0, 50000});
    for (LocalVertex i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * i / n;
      add_vertex({static_cast<std::int32_t>(100000 * std::cos(angle)),
                  static_cast<std::int32_t>(100000 * std::sin(angle)), 0});
      tets_.push_back({{0, 1, 2 + i, 2 + (i + 1) % n}, i});
    }
  }
  /// Another tet below each of the ring's, all of new labels: now vertex 0 has 2 n of them.
  void add_labels_at_one_end() {
    add_vertex({0, 0, -200000});
    for (LocalVertex i = 0; i < n_; ++i) {
      tets_.push_back({{0, 2 + i, 2 + (i + 1) % n_, n_ + 2}, n_ + i});
    }
  }
  [[nodiscard]] TetMesh mesh() const { return {vertices_, tets_, {1 << 30, 1 << 30, 1 << 30}}; }

 private:
  void add_vertex(Point p) {
    vertices_.push_back({vertices_.size(), {p.x + 500000, p.y + 500000, p.z + 500000}, {}});
  }

  LocalVertex n_;
  std::vector<BlockVertex> vertices_;
  std::vector<BlockTet> tets_;
};

TEST(LinkCondition, RefusesRingsLongerThanItsMasks) {
  const TetMesh mesh = Fan(70).mesh();
  LinkCondition test(mesh);
  EXPECT_FALSE(test.keeps_topology(mesh, 0, 1));
  EXPECT_FALSE(test.keeps_topology(mesh, 1, 0));
}

TEST(LinkCondition, RefusesMoreLabelsThanItsMasks) {
  Fan fan(40);
  fan.add_labels_at_one_end();
  const TetMesh mesh = fan.mesh();
  LinkCondition test(mesh);
  EXPECT_FALSE(test.keeps_topology(mesh, 0, 1));
  EXPECT_FALSE(test.keeps_topology(mesh, 1, 0));
}

/// What the links of two vertices have in common: sets of up to three vertices.
std::set<std::vector<LocalVertex>> common_link(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
  const auto link = [&mesh](LocalVertex v) {
    std::set<std::vector<LocalVertex>> out;
    for (const LinkTriangle& t : mesh.star(v)) {
      std::vector<LocalVertex> all{t.a, t.b, t.c};
      std::sort(all.begin(), all.end());
      out.insert(all);
      for (std::size_t i = 0; i < 3; ++i) {
        out.insert({all[i]});
        if (i < 2) out.insert({all[i], all[i + 1]});
      }
      out.insert({all[0], all[2]});
    }
    return out;
  };
  const auto of_p = link(p), of_q = link(q);
  std::set<std::vector<LocalVertex>> both;
  std::set_intersection(of_p.begin(), of_p.end(), of_q.begin(), of_q.end(),
                        std::inserter(both, both.end()));
  return both;
}

std::set<std::vector<LocalVertex>> simplices_of(const EdgeRing& ring) {
  std::set<std::vector<LocalVertex>> out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    out.insert({ring.vertices[i]});
    out.insert(
        {std::min(ring.vertices[i], ring.ends[i]), std::max(ring.vertices[i], ring.ends[i])});
  }
  return out;
}

/// Why masks over the ring are enough.  Meshes coarsen as they are looked at, as dense ones have no
/// edge whose ends share more than its ring.
TEST(LinkCondition, PositiveSurvivorsShareOnlyTheRing) {
  std::mt19937 random(305);
  int positive = 0, others = 0;
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    TetMesh mesh = dense_mesh(random_volume(random));
    disturb(mesh, random);
    EdgeRing ring;
    for (int k = 0; k < 60; ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p == q || !collect_ring(mesh, p, q, ring)) continue;
      const auto x = contraction_target(mesh, p, q, below(random, 3));
      const bool only_ring = common_link(mesh, p, q) == simplices_of(ring);
      others += only_ring ? 0 : 1;
      if (!x || !stays_positive(mesh, p, q, *x)) continue;
      ++positive;
      ASSERT_TRUE(only_ring) << p << " " << q;
      const bool q_stays = (mesh.planes(p) & mesh.planes(q)) == mesh.planes(p);
      mesh.contract(q_stays ? q : p, q_stays ? p : q, *x, {});
    }
  }
  EXPECT_GT(positive, 1000);
  EXPECT_GT(others, 10);
}

/// The mesh of a volume that goes on beyond the plane x = `voxels`.
TetMesh mesh_through(const SmallVolume& volume, std::int64_t voxels) {
  const BlockMesh block = dense_block(volume, {{0, 0, 0}, volume.shape});
  Point box = far_corner(volume.shape);
  box.x = static_cast<std::int32_t>(voxels * kUnitsPerVoxel);
  return {block.vertices, block.tets, box, BoxPlanes{2}};
}

/// Betti numbers of the parts of labels before and beyond the plane, and of labels as a whole.
std::array<std::vector<RegionBetti>, 3> betti_through(const TetMesh& mesh,
                                                      const std::vector<LocalTet>& tets,
                                                      std::size_t labels) {
  std::array<std::vector<LocalTet>, 3> parts;
  for (LocalTet t : tets) {
    const std::size_t side = side_of(t.label) == 0 ? 0 : 1;
    t.label = without_side(t.label);
    parts[side].push_back(t);
    parts[2].push_back(t);
  }
  return {betti(mesh, parts[0], labels), betti(mesh, parts[1], labels),
          betti(mesh, parts[2], labels)};
}

TEST(LinkCondition, KeepsThePartsAndTheWholeOfLabelsOnBothSides) {
  std::mt19937 random(307);
  int accepted = 0, refused_and_broken = 0, refused_but_kept = 0;
  for (int i = 0; i < 250 && !HasFailure(); ++i) {
    const Index3 shape{4, 2 + below(random, 2), 2 + below(random, 2)};
    const std::uint32_t labels = 2 + below(random, 3);
    TetMesh mesh = mesh_through(random_volume_of(random, random_kind(random), shape, labels), 2);
    disturb(mesh, random);
    LinkCondition whole(mesh, KeptTopology::kLabels, LinkCondition::Sides::kTogether), parts(mesh);
    for (int k = 0; k < 60 && !HasFailure(); ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p == q || !mesh.is_in_inner_plane(p, q)) continue;
      const auto x = contraction_target(mesh, p, q, below(random, 3));
      if (!x || !stays_positive(mesh, p, q, *x)) continue;
      const std::vector<LocalTet> before = mesh.tets();
      const bool kept = betti_through(mesh, contracted(before, p, q), labels) ==
                        betti_through(mesh, before, labels);
      const bool is_accepted = whole.keeps_topology(mesh, p, q) && parts.keeps_topology(mesh, p, q);
      EXPECT_TRUE(kept || !is_accepted);
      accepted += is_accepted ? 1 : 0;
      refused_and_broken += kept ? 0 : 1;
      refused_but_kept += kept && !is_accepted ? 1 : 0;
      if (is_accepted) mesh.contract(p, q, *x, mesh.quadric(p));
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused_and_broken, 20);
  EXPECT_GT(accepted, refused_but_kept);
}

/// A case by hand, so that a reader sees what is refused and why.
TEST(LinkCondition, RefusesToCutATunnelOpen) {
  // A bar of label 1 through a 3 x 3 x 3 box: label 0 is the ring around it.
  const SmallVolume bar =
      volume_from({3, 3, 3}, 2, [](auto x, auto y, auto) { return x == 1 && y == 1 ? 1 : 0; });
  const TetMesh mesh = dense_mesh(bar);
  const auto corner = [](LocalVertex x, LocalVertex y, LocalVertex z) {
    return (z * 4 + y) * 4 + x;
  };
  LinkCondition test(mesh);
  EXPECT_TRUE(test.keeps_topology(mesh, corner(1, 1, 1), corner(1, 1, 2)));
  // From the bar to the box: label 0 would no longer be a ring.
  EXPECT_FALSE(test.keeps_topology(mesh, corner(1, 1, 1), corner(0, 1, 1)));
}

}  // namespace
}  // namespace mw::test
