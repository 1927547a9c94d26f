// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes end to end: limits on edges, gradation and inner vertices of whole runs, all promises kept.
#include "engine/labels/voxel_lattice.h"
#include "engine/store/journal/identity.h"
#include "kernels/core/index.h"
#include "kernels/core/lattice.h"
#include "tests/engine/memory_run.h"
#include "tests/expect_error.h"
#include "tests/promises/whole_runs.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

std::vector<Label> labels_of(const SmallVolume& volume) {
  const std::set<Label> all(volume.labels.begin(), volume.labels.end());
  return {all.begin(), all.end()};
}

double diagonal_of(const Trial& trial) {
  const MemoryVolume volume(trial.volume, trial.frame);
  const Index3 layers = layers_of(volume.info().space.spacing);
  const auto& s = trial.frame.spacing;
  return std::hypot(s[0] / static_cast<double>(layers.x), s[1] / static_cast<double>(layers.y),
                    s[2] / static_cast<double>(layers.z));
}

/// Two labels that touch along an axis; none: {0, 0}.
std::pair<Label, Label> some_interface(std::mt19937& random, const SmallVolume& volume) {
  const auto& labels = volume.labels;
  for (int i = 0; i < 200; ++i) {
    const auto at = below(random, static_cast<std::uint32_t>(labels.size()));
    const bool has_next = (static_cast<std::int64_t>(at) + 1) % volume.shape.x != 0;
    if (has_next && labels[at] != labels[at + 1]) return std::minmax({labels[at], labels[at + 1]});
  }
  return {0, 0};
}

/// Sizes from the least that can be kept to six times that: of some labels, of all others at times,
/// and of interfaces: of two labels, of a label with any other, and of all.
void add_sizes(std::mt19937& random, Trial& trial) {
  const double min = diagonal_of(trial) / SizeRules::kContracted;
  SizeRules& rules = trial.settings.sizes.rules;
  const auto size = [&] { return min * (1.0 + 0.05 * below(random, 100)); };
  if (below(random, 4) == 0) rules.others = size();
  const auto [low, high] = some_interface(random, trial.volume);
  if (below(random, 4) == 0) rules.interfaces.push_back({{}, {}, size()});
  if (low != high && below(random, 4) == 0)
    rules.interfaces.push_back({{}, raw_label(low), size()});
  if (low != high && below(random, 4) == 0) {
    rules.interfaces.push_back({raw_label(low), raw_label(high), size()});
  }
  for (const Label label : labels_of(trial.volume)) {
    if (below(random, 2) == 0) continue;
    rules.labels.push_back({raw_label(label), size()});
  }
  const double gradation = 0.25 * below(random, 5);
  if (rules.any()) trial.settings.sizes.gradation = gradation;
}

Trial random_sized(std::mt19937& random, int i) {
  constexpr std::array<std::array<double, 3>, 3> kSpacings{
      {{1, 1, 1}, {0.5, 0.5, 1.25}, {0.7, 0.5, 0.5}}};
  constexpr std::array<StartMesh, 4> kStarts{StartMesh::kCoarse, StartMesh::kCoarse,
                                             StartMesh::kOctree, StartMesh::kDense};
  const VolumeKind kind = random_kind(random);
  const Index3 shape = random_shape(random, 6, 27);
  Trial trial{.volume = random_volume_of(random, kind, shape, 2 + below(random, 3)),
              .settings = {.window = below(random, 2) == 0 ? 8 : 16,
                           .order = i % 2 == 0 ? Order::kRaster : Order::kColour,
                           .start = kStarts[below(random, 4)],
                           .quality_floor = 0.1},
              .frame = {.spacing = kSpacings[below(random, 3)], .origin = {3, -1, 0}}};
  if (below(random, 3) == 0) trial.settings.surface = Surface::kVoxel;
  add_sizes(random, trial);
  trial.settings.sizes.inner_vertices = below(random, 2) == 0;
  return trial;
}

/// How far a place is from a box of voxels, which may be flat.
double distance_to(const Trial& trial, Index3 low, Index3 high, const audit::Position& p) {
  const std::array<std::int64_t, 3> lo{low.x, low.y, low.z}, hi{high.x, high.y, high.z};
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = [&](std::int64_t corner) {
      return trial.frame.origin[axis] + trial.frame.spacing[axis] * static_cast<double>(corner);
    };
    const double way = std::max({at(lo[axis]) - p[axis], p[axis] - at(hi[axis]), 0.0});
    squared += way * way;
  }
  return std::sqrt(squared);
}

/// How far a place is from a label's voxels.
double distance_to(const Trial& trial, Label label, const audit::Position& p) {
  double min = std::numeric_limits<double>::infinity();
  std::size_t i = 0;
  for_each_index(trial.volume.shape, [&](Index3 v) {
    if (trial.volume.labels[i++] != label) return;
    min = std::min(min, distance_to(trial, v, v + Index3{1, 1, 1}, p));
  });
  return min;
}

/// The size of the rule that says most about two labels; infinity if no rule is about them.
double size_between(const SizeRules& rules, Label a, Label b) {
  double out = std::numeric_limits<double>::infinity();
  int most = -1;
  for (const InterfaceSize& s : rules.interfaces) {
    const int said = (s.low ? 1 : 0) + (s.high ? 1 : 0);
    const auto fits = [&](Label x, Label y) {
      return (!s.low || s.low == raw_label(x)) && (!s.high || s.high == raw_label(y));
    };
    if ((!fits(a, b) && !fits(b, a)) || said < most) continue;
    out = said > most ? s.edge : std::min(out, s.edge);
    most = said;
  }
  return out;
}

/// A voxel's face that has a size.
struct SizedFace {
  Index3 lo;
  Index3 hi;
  double size = 0.0;
};

std::vector<SizedFace> sized_faces(const Trial& trial) {
  const Index3 shape = trial.volume.shape;
  const auto label = [&](Index3 v) {
    return trial.volume.labels[static_cast<std::size_t>((v.z * shape.y + v.y) * shape.x + v.x)];
  };
  std::vector<SizedFace> out;
  if (trial.settings.sizes.rules.interfaces.empty()) return out;
  for_each_index(shape, [&](Index3 v) {
    for (const Index3 step : {Index3{1, 0, 0}, Index3{0, 1, 0}, Index3{0, 0, 1}}) {
      const Index3 next = v + step;
      if (next.x == shape.x || next.y == shape.y || next.z == shape.z) continue;
      if (label(v) == label(next)) continue;
      const double size = size_between(trial.settings.sizes.rules, label(v), label(next));
      if (!std::isinf(size)) out.push_back({next, v + Index3{1, 1, 1}, size});
    }
  });
  return out;
}

/// The limit at each vertex: what the gradation allows.
std::vector<double> limits_at_vertices(const Trial& trial, const SmallMesh& mesh) {
  std::vector<double> out;
  const std::vector<SizedFace> faces = sized_faces(trial);
  for (const audit::Position& p : mesh.vertices) {
    double min = std::numeric_limits<double>::infinity();
    for (const SizedFace& face : faces) {
      const double way = distance_to(trial, face.lo, face.hi, p);
      min = std::min(min, face.size + trial.settings.sizes.gradation * way);
    }
    for (const Label label : labels_of(trial.volume)) {
      const auto size = trial.settings.sizes.rules.of_label(raw_label(label));
      if (!size) continue;
      const double way = distance_to(trial, label, p);
      min = std::min(min, *size + trial.settings.sizes.gradation * way);
    }
    out.push_back(SizeRules::kLongest * min);
  }
  return out;
}

/// Calls visit(tet, row, row, length) for the edges of all tets.
template <typename Visit>
void each_edge(const SmallMesh& mesh, Visit visit) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const auto a = mesh.tets[t][i], b = mesh.tets[t][j];
        const auto &p = mesh.vertices[a], &q = mesh.vertices[b];
        visit(t, a, b, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      }
    }
  }
}

/// Every edge by brute force; returns the largest share of a label's limit that is used.
double expect_sizes(const Trial& trial, const SmallMesh& mesh) {
  std::vector<double> of_label(trial.volume.label_count, std::numeric_limits<double>::infinity());
  for (const Label label : labels_of(trial.volume)) {
    const auto size = trial.settings.sizes.rules.of_label(raw_label(label));
    if (size) of_label[label] = SizeRules::kLongest * *size;
  }
  const std::vector<double> at = limits_at_vertices(trial, mesh);
  double max = 0.0;
  each_edge(mesh, [&](std::size_t t, auto a, auto b, double length) {
    const double limit = of_label[mesh.labels[t]];
    EXPECT_LE(length, limit * (1 + kRounding));
    EXPECT_LE(length, std::min(at[a], at[b]) * (1 + kRounding));
    max = std::max(max, length / limit);
  });
  return max;
}

TEST(Sizes, AreKeptByEveryEdgeWithAllPromises) {
  std::mt19937 random(2401);
  int used = 0, listed = 0;
  for (int i = 0; i < 24 && !HasFailure(); ++i) {
    const Trial trial = random_sized(random, i);
    SCOPED_TRACE(trial.text());
    const SmallMesh mesh = small_mesh(run_in_memory(trial));
    expect_promises(trial, mesh, Counter::kAudit);
    const double max = expect_sizes(trial, mesh);
    const SizeRules& rules = trial.settings.sizes.rules;
    listed += rules.labels.empty() && !rules.others ? 0 : 1;
    used += max > 0.8 ? 1 : 0;
  }
  EXPECT_GT(listed, 12);
  EXPECT_GT(used, listed / 2) << "the limits hardly matter";
}

TEST(Sizes, MakeTheSameMeshOnAnyNumberOfThreads) {
  std::mt19937 random(2402);
  for (int i = 0; i < 4 && !HasFailure(); ++i) {
    Trial trial = random_sized(random, i);
    trial.settings.sizes.inner_vertices = true;
    SCOPED_TRACE(trial.text());
    expect_same(run_in_memory(trial, {.threads = 3}), run_in_memory(trial));
  }
}

/// Tets of these labels with all corners on interfaces or the box.
std::size_t count_lacking(const SmallMesh& mesh, const Trial& trial) {
  std::vector<std::set<Label>> around(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const auto v : mesh.tets[t]) around[v].insert(mesh.labels[t]);
  }
  const auto on_box = [&](const audit::Position& p) {
    const std::array<std::int64_t, 3> shape{trial.volume.shape.x, trial.volume.shape.y,
                                            trial.volume.shape.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = p[axis] - trial.frame.origin[axis];
      const double end = trial.frame.spacing[axis] * static_cast<double>(shape[axis]);
      if (from < kRounding || from > end - kRounding) return true;
    }
    return false;
  };
  std::size_t lacking = 0;
  for (const auto& tet : mesh.tets) {
    lacking += std::all_of(tet.begin(), tet.end(), [&](auto v) {
      return around[v].size() > 1 || on_box(mesh.vertices[v]);
    });
  }
  return lacking;
}

TEST(InnerVerticesOfARun, AreThereForMostTets) {
  std::mt19937 random(2403);
  std::size_t without = 0, with = 0;
  for (int i = 0; i < 10 && !HasFailure(); ++i) {
    Trial trial{.volume = random_volume_of(random, VolumeKind::kBlobs, {20, 18, 22}, 4),
                .settings = {.window = 16, .quality_floor = 0.1},
                .frame = {}};
    without += count_lacking(small_mesh(run_in_memory(trial)), trial);
    trial.settings.sizes.inner_vertices = true;
    SCOPED_TRACE(trial.text());
    const SmallMesh mesh = small_mesh(run_in_memory(trial));
    expect_promises(trial, mesh, Counter::kAudit);
    with += count_lacking(mesh, trial);
  }
  EXPECT_LT(with, without / 3) << without;
}

TEST(Sizes, AreRefusedWhereTheyCannotBeKept) {
  std::mt19937 random(2404);
  Trial trial{.volume = random_volume_of(random, VolumeKind::kBlobs, {8, 8, 8}, 2),
              .settings = {},
              .frame = {}};
  const auto expect_refused = [&](const std::vector<LabelSize>& labels, const char* piece) {
    trial.settings.sizes.rules.labels = labels;
    expect_error(ErrorKind::kUsage, {piece}, [&] { run_in_memory(trial); });
  };
  const RawLabel known = raw_label(trial.volume.labels[0]);
  expect_refused({{known, 1.38}}, "1.39 can be kept");
  expect_refused({{known, 3.0}, {known, 4.0}}, "once");
  expect_refused({{known, 0.0}}, "positive");
  expect_refused({{5, 3.0}}, "no label 5");
  trial.settings.sizes.gradation = -1;
  expect_refused({{known, 3.0}}, "gradation");
}

TEST(Sizes, BelongToWhatARunIs) {
  const io::VolumeInfo volume;
  std::set<std::string> texts;
  MeshSettings settings;
  texts.insert(identity_text(volume, settings));
  settings.sizes.inner_vertices = true;
  texts.insert(identity_text(volume, settings));
  settings.sizes.rules.labels = {{3, 2.0}};
  texts.insert(identity_text(volume, settings));
  settings.sizes.inner_vertices = false;
  texts.insert(identity_text(volume, settings));
  settings.sizes.rules.labels = {{3, 2.5}};
  texts.insert(identity_text(volume, settings));
  settings.sizes.gradation = 1.0;
  texts.insert(identity_text(volume, settings));
  settings.sizes.rules.others = 2.5;
  texts.insert(identity_text(volume, settings));
  settings.sizes.rules.interfaces = {{3, 4, 2.5}};
  texts.insert(identity_text(volume, settings));
  settings.sizes.rules.image = "f.npy";
  texts.insert(identity_text(volume, settings));
  EXPECT_EQ(texts.size(), 9U);
}

}  // namespace
}  // namespace mw::engine
