// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Contraction and optimisation of small meshes: tets stay positive and fill the box, labels keep
// their Betti numbers, fixed vertices stay where they are.
#include <cmath>
#include <optional>

#include "kernels/optimise/optimise.h"
#include "kernels/quality/quality.h"
#include "kernels/simplify/simplify.h"
#include "kernels/topology/link_condition.h"
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/small_inputs.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::fuzz {
namespace {

using test::SmallVolume;
using test::worst_ratio;

std::int64_t positive_volume6(const TetMesh& mesh) {
  std::int64_t sum = 0;
  for (const LocalTet& t : mesh.tets()) {
    require(test::volume6_of(mesh, t) > 0, "tets are positive");
    sum += test::volume6_of(mesh, t);
  }
  return sum;
}

void check_fixed(const TetMesh& before, const TetMesh& mesh) {
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (before.is_free(v)) continue;
    require(mesh.is_alive(v) && mesh.vertex(v) == before.vertex(v), "fixed vertices stay");
  }
}

/// The Betti numbers of the places where labels meet, with the exterior as a label.
audit::test::JunctionsBetti positions(const TetMesh& mesh, std::size_t label_count) {
  const test::SmallMesh rows = test::small_mesh(mesh, mesh.tets());
  return audit::test::junctions_of(audit::test::complex_of(rows.view(), label_count));
}

/// A vertex of the star of p, by two choices.
LocalVertex choose_neighbour(const TetMesh& mesh, LocalVertex p, Choices& choices) {
  const auto star = mesh.star(p);
  const LinkTriangle t = star[choices.below(static_cast<std::uint32_t>(star.size()))];
  return std::array{t.a, t.b, t.c}[choices.below(3)];
}

/// Tries one contraction; none when the choice is no free edge.
void try_contraction(TetMesh& mesh, LinkCondition& link_condition, Choices& choices) {
  const LocalVertex p = choices.below(mesh.vertex_count());
  if (!mesh.is_alive(p) || !mesh.is_free(p)) return;
  const LocalVertex q = choose_neighbour(mesh, p, choices);
  if (q == mesh.infinity() || !mesh.is_free(q)) return;
  const std::uint32_t at = choices.below(3);
  const std::optional<Point> x = test::contraction_target(mesh, p, q, at);
  if (!x || !test::stays_positive(mesh, p, q, *x)) return;
  const bool kept = link_condition.keeps_topology(mesh, p, q);
  require(kept == link_condition.keeps_topology(mesh, q, p), "the verdict is the same both ways");
  // Who survives must be on all planes of the box that the place is on.
  const LocalVertex keep = at == 1 ? q : p;
  if (kept) mesh.contract(keep, p + q - keep, *x, mesh.quadric(keep));
}

/// A mesh with samples, contracted by some options.
struct Subject {
  SmallVolume volume;
  Metric metric;
  test::GuardedMesh guarded;
  bool is_guarded;

  explicit Subject(Choices& choices)
      : volume(choose_volume(choices, 4)),
        metric(choose_metric(choices)),
        guarded(volume, 1.5),
        is_guarded(choices.below(2) == 0) {}

  DistanceGuard* guard() { return is_guarded ? &guarded.guard : nullptr; }
};

SimplifyOptions choose_simplify(Choices& choices) {
  SimplifyOptions out;
  out.quality_floor = 0.02 * choices.below(20);
  out.inner_quality = 0.05 * choices.below(20);
  if (choices.below(4) == 0) out.edge_variance = 0.02 * (1 + choices.below(20));
  if (choices.below(3) == 0) out.topology = KeptTopology::kInterfaces;
  out.keep_smooth = choices.below(2) == 0;
  return out;
}

OptimiseOptions choose_optimise(Choices& choices) {
  OptimiseOptions out;
  out.sweeps = static_cast<int>(1 + choices.below(2));
  out.flip_below = 0.1 * choices.below(11);
  out.smooth_below = 0.1 * choices.below(11);
  out.quality_floor = 0.02 * choices.below(20);
  return out;
}

}  // namespace

/// Any contractions, in any order, of those that the collapse test accepts.
void fuzz_collapse(Bytes bytes) {
  Choices choices(bytes);
  const bool interfaces = choices.below(2) == 0;
  const SmallVolume volume = choose_volume(choices, 3);
  TetMesh mesh = test::dense_mesh(volume);
  const std::int64_t before = positive_volume6(mesh);
  const audit::test::JunctionsBetti junctions_before = positions(mesh, volume.label_count);
  LinkCondition link_condition(mesh,
                               interfaces ? KeptTopology::kInterfaces : KeptTopology::kLabels);
  for (int i = 0; i < 200 && !choices.at_end(); ++i) try_contraction(mesh, link_condition, choices);
  require(positive_volume6(mesh) == before, "tets fill the box");
  require(test::betti(mesh, volume.label_count) == test::betti(volume), "Betti numbers stay");
  require(!interfaces || positions(mesh, volume.label_count) == junctions_before,
          "interfaces keep theirs");
}

void fuzz_simplify(Bytes bytes) {
  Choices choices(bytes);
  Subject subject(choices);
  TetMesh& mesh = subject.guarded.mesh;
  const TetMesh before = mesh;
  const SimplifyOptions options = choose_simplify(choices);
  const double promised = std::min(options.quality_floor, worst_ratio(mesh, subject.metric));
  simplify(mesh, subject.metric, options, subject.guard());
  require(positive_volume6(mesh) == positive_volume6(before), "tets fill the box");
  require(worst_ratio(mesh, subject.metric) >= promised - 1e-12, "no tet below the floor");
  const std::size_t labels = subject.volume.label_count;
  require(test::betti(mesh, labels) == test::betti(subject.volume), "Betti numbers stay");
  require(options.topology == KeptTopology::kLabels ||
              positions(mesh, labels) == positions(before, labels),
          "interfaces keep theirs");
}

/// Optimises a mesh that was disturbed or contracted, whole or cut out of a larger one.
void fuzz_optimise(Bytes bytes) {
  Choices choices(bytes);
  const SmallVolume volume = choose_volume(choices, 4);
  const Metric metric = choose_metric(choices);
  const bool whole = volume.shape.x < 3 || choices.below(2) == 0;
  TetMesh mesh =
      whole ? test::dense_mesh(volume) : test::dense_cutout(volume, {{1, 0, 0}, volume.shape});
  const bool contracts = choices.below(2) == 0;
  const SimplifyOptions first = choose_simplify(choices);
  if (contracts) simplify(mesh, metric, first);
  std::mt19937 random(choices.below(1 << 16));
  test::disturb(mesh, random);
  const TetMesh before = mesh;
  optimise(mesh, metric, choose_optimise(choices));
  require(positive_volume6(mesh) == positive_volume6(before), "tets fill the box");
  check_fixed(before, mesh);
  require(!whole || test::betti(mesh, volume.label_count) == test::betti(volume),
          "Betti numbers stay");
}

}  // namespace mw::fuzz
