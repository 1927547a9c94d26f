// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Good triangulations replace, and every kind of wrong one is refused where it is wrong.
#include "kernels/odt/replacement.h"

#include "kernels/quality/quality.h"
#include "tests/kernels/odt/window_meshes.h"

namespace mw::test {
namespace {

/// A window, and another triangulation of its regions.
struct Trial {
  explicit Trial(std::mt19937& random)
      : window(random_window(random)),
        asked(window_plc(window.mesh, window.metric)),
        other(window.mesh) {
    flips = flip_some(other, window.metric, random, 200);
    made = as_triangulation(asked, window.mesh, other);
  }

  [[nodiscard]] Replacement replace(std::vector<std::optional<Point>> added = {},
                                    double floor = 0.0) const {
    return replace_proved(window.mesh, window.metric, asked.content, added, made, floor);
  }

  WindowCase window;
  WindowPlc asked;
  TetMesh other;
  Triangulation made;
  int flips = 0;
};

TEST(Replacement, SameTetsChangeNothing) {
  std::mt19937 random(1211);
  for (int i = 0; i < 20; ++i) {
    Trial trial(random);
    trial.made = as_triangulation(trial.asked, trial.window.mesh, trial.window.mesh);
    const Replacement out = trial.replace();
    EXPECT_TRUE(tet_keys(out.tets) == tet_keys(trial.window.mesh.tets()));
    EXPECT_EQ(out.stats.patches, 0U);
  }
}

TEST(Replacement, TakesAnotherTriangulation) {
  std::mt19937 random(1212);
  int flips = 0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    const Trial trial(random);
    const Replacement out = trial.replace();
    EXPECT_TRUE(tet_keys(out.tets) == tet_keys(trial.other.tets()));
    EXPECT_EQ(out.stats.unproved + out.stats.unimproved, 0U);
    EXPECT_EQ(out.stats.patches > 0, trial.flips > 0);
    expect_same_regions(out.tets, trial.window.mesh);
    flips += trial.flips;
  }
  EXPECT_GT(flips, 100);
}

TEST(Replacement, KeepsPatchesThatWouldSinkBelowTheFloor) {
  std::mt19937 random(1213);
  std::uint64_t refused = 0, taken = 0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    Trial trial(random);
    // Back from the better one: many patches get worse.
    std::swap(trial.window.mesh, trial.other);
    trial.asked = window_plc(trial.window.mesh, trial.window.metric);
    trial.made = as_triangulation(trial.asked, trial.window.mesh, trial.other);
    const Replacement out = trial.replace({}, 0.25);
    expect_same_regions(out.tets, trial.window.mesh);
    refused += out.stats.unimproved;
    taken += out.stats.patches - out.stats.unimproved - out.stats.unproved;
    const auto worst = [&](const std::vector<LocalTet>& tets) {
      double min = 1.0;
      for (const LocalTet& t : tets) {
        min = std::min(min, radius_ratio(trial.window.mesh, trial.window.metric, t));
      }
      return min;
    };
    EXPECT_GE(worst(out.tets), std::min(0.25, worst(trial.window.mesh.tets())) - 1e-12);
  }
  EXPECT_GT(refused, 20U);
  EXPECT_GT(taken, 5U);
}

/// Spoils an answer; gets the position of a tet in it.
using Spoil = std::function<void(Trial&, std::mt19937&, std::size_t tet)>;

void expect_refused(std::uint32_t seed, const Spoil& spoil) {
  std::mt19937 random(seed);
  for (int i = 0; i < 30 && !testing::Test::HasFailure(); ++i) {
    Trial trial(random);
    const auto tets = static_cast<std::uint32_t>(trial.made.tets.size());
    spoil(trial, random, below(random, tets));
    const Replacement out = trial.replace();
    EXPECT_GE(out.stats.unproved, 1U);
    expect_same_regions(out.tets, trial.window.mesh);
  }
}

TEST(Replacement, RefusesAHole) {
  expect_refused(1221, [](Trial& trial, std::mt19937&, std::size_t tet) {
    trial.made.tets.erase(trial.made.tets.begin() + static_cast<std::ptrdiff_t>(tet));
    trial.made.regions.erase(trial.made.regions.begin() + static_cast<std::ptrdiff_t>(tet));
  });
}

TEST(Replacement, RefusesATetTwice) {
  expect_refused(1222, [](Trial& trial, std::mt19937&, std::size_t tet) {
    trial.made.tets.push_back(trial.made.tets[tet]);
    trial.made.regions.push_back(trial.made.regions[tet]);
  });
}

TEST(Replacement, RefusesAWrongRegion) {
  expect_refused(1223, [](Trial& trial, std::mt19937& random, std::size_t tet) {
    const auto regions = static_cast<std::uint32_t>(trial.asked.content.labels.size());
    trial.made.regions[tet] += 1 + below(random, regions);
  });
}

TEST(Replacement, RefusesAWrongCorner) {
  expect_refused(1224, [](Trial& trial, std::mt19937& random, std::size_t tet) {
    auto& corners = trial.made.tets[tet];
    std::uint32_t other = corners[0];
    while (std::ranges::count(corners, other) != 0) {
      other = below(random, trial.window.mesh.vertex_count());
    }
    corners[below(random, 4)] = other;
  });
}

TEST(Replacement, RefusesRowsThatDoNotExist) {
  expect_refused(1225, [](Trial& trial, std::mt19937& random, std::size_t tet) {
    const bool far = below(random, 2) == 0;
    trial.made.tets[tet][below(random, 4)] = far ? 0xffffffffU : trial.window.mesh.vertex_count();
  });
}

TEST(Replacement, RefusesACornerTwice) {
  expect_refused(1226, [](Trial& trial, std::mt19937&, std::size_t tet) {
    trial.made.tets[tet][1] = trial.made.tets[tet][0];
  });
}

TEST(Replacement, RefusesTetsWithoutRegion) {
  expect_refused(
      1227, [](Trial& trial, std::mt19937&, std::size_t tet) { trial.made.regions.resize(tet); });
}

TEST(Replacement, RefusesAnEmptyAnswer) {
  expect_refused(1228, [](Trial& trial, std::mt19937&, std::size_t) { trial.made = {}; });
}

/// With two points exchanged, tets at them are turned over or do not meet.
TEST(Replacement, RefusesATetTurnedOver) {
  expect_refused(1229, [](Trial& trial, std::mt19937&, std::size_t tet) {
    const auto corners = trial.made.tets[tet];
    for (auto& t : trial.made.tets) {
      for (auto& v : t) v = v == corners[0] ? corners[1] : v == corners[1] ? corners[0] : v;
    }
  });
}

TEST(Replacement, RefusesAnotherInterface) {
  std::mt19937 random(1230);
  int flips = 0;
  for (int i = 0; i < 150 && !HasFailure(); ++i) {
    Trial trial(random);
    trial.other = trial.window.mesh;
    if (flip_some(trial.other, trial.window.metric, random, 300, false) == 0) continue;
    const std::vector<Point> at = positions(trial.other);
    if (borders(face_labels(trial.other.tets(), at)) ==
        borders(face_labels(trial.window.mesh.tets(), at))) {
      continue;  // flipped back
    }
    ++flips;
    trial.made = as_triangulation(trial.asked, trial.window.mesh, trial.other);
    const Replacement out = trial.replace();
    EXPECT_GE(out.stats.unproved, 1U);
    expect_same_regions(out.tets, trial.window.mesh);
  }
  EXPECT_GT(flips, 10);
}

/// Cuts tets of the answer at a point of theirs, given by weights of the corners.
void split(Triangulation& made, std::size_t tet, std::uint32_t point) {
  const auto corners = made.tets[tet];
  for (std::size_t i = 0; i < 4; ++i) {
    auto part = corners;
    part[i] = point;
    if (i == 0) {
      made.tets[tet] = part;
    } else {
      made.tets.push_back(part);
      made.regions.push_back(made.regions[tet]);
    }
  }
}

Point middle(const Trial& trial, std::size_t tet, std::size_t corners) {
  std::array<std::int64_t, 3> sum{};
  for (std::size_t i = 0; i < corners; ++i) {
    const Point p = trial.window.mesh.position(trial.made.tets[tet][i]);
    sum[0] += p.x;
    sum[1] += p.y;
    sum[2] += p.z;
  }
  const auto mean = [&](std::size_t k) {
    return static_cast<std::int32_t>(sum[k] / static_cast<std::int64_t>(corners));
  };
  return {mean(0), mean(1), mean(2)};
}

TEST(Replacement, TakesPointsInsideTets) {
  std::mt19937 random(1231);
  int used = 0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    Trial trial(random);
    std::vector<std::optional<Point>> added;
    std::vector<Point> at;
    const auto before = static_cast<std::uint32_t>(trial.made.tets.size());
    for (int k = 0; k < 3; ++k) {
      const std::size_t tet = below(random, before);
      if (std::ranges::any_of(trial.made.tets[tet], [&](std::uint32_t v) {
            return v >= trial.window.mesh.vertex_count();
          })) {
        continue;
      }
      at.push_back(middle(trial, tet, 4));
      added.emplace_back(at.back());
      split(trial.made, tet,
            trial.window.mesh.vertex_count() + static_cast<std::uint32_t>(added.size()) - 1);
    }
    const Replacement out = trial.replace(added);
    expect_same_regions(out.tets, trial.window.mesh, at);
    ASSERT_EQ(out.used.size(), added.size());
    for (std::uint8_t u : out.used) used += u;
    // Without its place on the lattice a point is of no use.
    added.back() = std::nullopt;
    const Replacement without = trial.replace(added);
    EXPECT_EQ(without.used.back(), 0);
    EXPECT_GE(without.stats.unproved, 1U);
    expect_same_regions(without.tets, trial.window.mesh, at);
  }
  EXPECT_GT(used, 60);
}

TEST(Replacement, RefusesPointsOnFacets) {
  std::mt19937 random(1232);
  int tried = 0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    Trial trial(random);
    const std::uint32_t point = trial.window.mesh.vertex_count();
    const auto facet =
        trial.asked.plc
            .facets[below(random, static_cast<std::uint32_t>(trial.asked.plc.facets.size()))];
    const auto tets = trial.made.tets.size();
    Point at{};
    for (std::size_t t = 0; t < tets; ++t) {
      auto& corners = trial.made.tets[t];
      const auto on_facet = [&](std::uint32_t v) { return std::ranges::count(facet, v) != 0; };
      std::stable_partition(corners.begin(), corners.end(), on_facet);
      if (!on_facet(corners[2])) continue;
      at = middle(trial, t, 3);
      const auto whole = corners;
      for (std::size_t k = 0; k < 3; ++k) {
        auto part = whole;
        part[k] = point;
        if (k == 0) {
          trial.made.tets[t] = part;
        } else {
          trial.made.tets.push_back(part);
          trial.made.regions.push_back(trial.made.regions[t]);
        }
      }
      ++tried;
    }
    const Replacement out = trial.replace({at});
    EXPECT_EQ(out.used[0], 0);
    EXPECT_GE(out.stats.unproved, 1U);
    expect_same_regions(out.tets, trial.window.mesh, {at});
  }
  EXPECT_GT(tried, 40);
}

}  // namespace
}  // namespace mw::test
