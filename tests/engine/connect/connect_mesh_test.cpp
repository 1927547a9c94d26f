// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts, hinges and doubled vertices of random meshes, against floods over the whole mesh.
#include "engine/connect/connect_mesh.h"

#include "engine/connect/tet_chunk.h"
#include "io/mesh/digest.h"
#include "io/mesh/merged_vertices.h"
#include "kernels/core/error.h"
#include "tests/engine/connect/random_mesh.h"
#include "tests/engine/memory_run.h"
#include "tests/expect_error.h"
#include "tests/oracle/hanging_parts.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

/// Tets by the number of their part.
std::map<std::size_t, std::set<std::size_t>> parts_of(const io::MeshData& mesh) {
  std::set<std::size_t> all;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) all.insert(t);
  std::map<std::size_t, std::set<std::size_t>> out;
  for (const auto& [tet, part] : sets_joined_by_faces(mesh.tets, all, {})) out[part].insert(tet);
  return out;
}

/// Returns the largest part, of several the one with the first tet.
const std::set<std::size_t>& largest(const std::map<std::size_t, std::set<std::size_t>>& parts) {
  auto best = parts.begin();
  for (auto at = parts.begin(); at != parts.end(); ++at) {
    if (at->second.size() > best->second.size()) best = at;
  }
  return best->second;
}

/// How many parts vertices join to the largest one, itself left out.
std::size_t count_hanging(const io::MeshData& mesh,
                          const std::map<std::size_t, std::set<std::size_t>>& parts) {
  std::set<std::uint64_t> reached;
  std::set<std::size_t> joined;
  const auto take = [&](std::size_t part) {
    joined.insert(part);
    for (const std::size_t t : parts.at(part)) {
      reached.insert(mesh.tets[t].begin(), mesh.tets[t].end());
    }
  };
  take(*largest(parts).begin());
  for (std::size_t before = 0; before != joined.size();) {
    before = joined.size();
    for (const auto& [part, tets] : parts) {
      const bool touches = std::any_of(tets.begin(), tets.end(), [&](std::size_t t) {
        return std::any_of(mesh.tets[t].begin(), mesh.tets[t].end(),
                           [&](std::uint64_t row) { return reached.contains(row); });
      });
      if (touches) take(part);
    }
  }
  return joined.size() - 1;
}

void expect_same_facts(const ConnectFacts& a, const ConnectFacts& b) {
  EXPECT_EQ(std::tie(a.found, a.parts, a.hanging, a.free, a.small, a.largest_tets, a.tets),
            std::tie(b.found, b.parts, b.hanging, b.free, b.small, b.largest_tets, b.tets));
  EXPECT_EQ(std::tie(a.vertices, a.hinge_vertices, a.hinge_edges, a.doubled, a.copies),
            std::tie(b.vertices, b.hinge_vertices, b.hinge_edges, b.doubled, b.copies));
  EXPECT_EQ(std::tie(a.parts_after, a.facets, a.held, a.closed, a.wedges),
            std::tie(b.parts_after, b.facets, b.held, b.closed, b.wedges));
  EXPECT_EQ(a.unmet, b.unmet);
  ASSERT_EQ(a.hinges.size(), b.hinges.size());
  for (std::size_t h = 0; h < a.hinges.size(); ++h) EXPECT_EQ(a.hinges[h].rows, b.hinges[h].rows);
}

TEST(Connect, TellsWhichWatchedLabelsShareNoFace) {
  const std::vector<LabelPair> watched{{0, 1}, {0, 9}, {1, 2}, {1, 3}, {2, 3}, {7, 8}};
  std::size_t met = 0, unmet = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const io::MeshData mesh = random_mesh(seed);
    if (mesh.tets.empty()) continue;
    std::map<std::set<std::uint64_t>, std::vector<RawLabel>> faces;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      for (const std::uint64_t left_out : mesh.tets[t]) {
        std::set<std::uint64_t> face(mesh.tets[t].begin(), mesh.tets[t].end());
        face.erase(left_out);
        faces[face].push_back(mesh.labels[t]);
      }
    }
    std::vector<LabelPair> expected = watched;
    for (const auto& [face, labels] : faces) {
      if (labels.size() == 2) std::erase(expected, LabelPair(std::minmax(labels[0], labels[1])));
    }
    EXPECT_EQ(connect(mesh, {.watched = watched}).facts.unmet, expected) << seed;
    met += watched.size() - expected.size();
    unmet += expected.size();
  }
  EXPECT_GT(std::min(met, unmet), 50U);
}

TEST(Connect, CountsPartsAndHinges) {
  std::size_t hanging = 0, free = 0, hinge_vertices = 0, hinge_edges = 0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const io::MeshData mesh = random_mesh(seed);
    if (mesh.tets.empty()) continue;
    const auto [same, facts] = connect(mesh, {});
    EXPECT_EQ(same.tets, mesh.tets);
    EXPECT_EQ(same.vertices, mesh.vertices);
    EXPECT_EQ(same.record, mesh.record);
    const auto parts = parts_of(mesh);
    EXPECT_EQ(facts.found, parts.size());
    EXPECT_EQ(facts.parts, parts.size());
    EXPECT_EQ(facts.parts_after, parts.size());
    EXPECT_EQ(facts.largest_tets, largest(parts).size());
    EXPECT_EQ(facts.hanging, count_hanging(mesh, parts));
    EXPECT_EQ(facts.hanging + facts.free + 1, parts.size());
    std::size_t small = 0;
    for (const auto& [first, tets] : parts) small += tets.size() < kSmallPartTets ? 1U : 0U;
    EXPECT_EQ(facts.small, small);
    std::set<std::size_t> all;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) all.insert(t);
    const Hinges hinges = hinges_of(mesh.tets, all);
    EXPECT_EQ(facts.hinge_vertices, hinges.vertices.size());
    EXPECT_EQ(facts.hinge_edges, hinges.edges.size());
    for (const HingePlace& hinge : facts.hinges) {
      EXPECT_EQ(hinge.is_edge ? hinges.edges.count({hinge.rows[0], hinge.rows[1]})
                              : hinges.vertices.count(hinge.rows[0]),
                1U);
      for (std::size_t end = 0; end < 2; ++end) {
        EXPECT_EQ(hinge.places[end], mesh.vertices[hinge.rows[end]]);
      }
    }
    hanging += facts.hanging;
    free += facts.free;
    hinge_vertices += facts.hinge_vertices;
    hinge_edges += facts.hinge_edges;
  }
  EXPECT_GT(std::min({hanging, free, hinge_vertices, hinge_edges}), 20U);
}

/// The mesh has several chunks of tets and batches of stars.
TEST(Connect, FindsTheSameOnAnyNumberOfThreads) {
  const std::array<ConnectOptions, 3> rules{
      ConnectOptions{.watched = {{0, 1}, {1, 2}, {7, 8}}},
      {.parts = {.least_tets = 9}, .open_hinges = true},
      {.split = {.all = true, .pairs = {}}, .cohesive = {.all = false, .pairs = {{{1, 2}}}}}};
  for (unsigned seed = 0; seed < kVolumeKinds; ++seed) {
    std::mt19937 random(seed);
    const auto kind = static_cast<VolumeKind>(seed);
    const io::MeshData mesh = mesh_without(random_volume_of(random, kind, {14, 13, 12}, 4), 1);
    for (const ConnectOptions& options : rules) {
      SCOPED_TRACE(seed);
      if (mesh.tets.size() < 4 * TetChunk::kTets) continue;
      const Connected alone = connect(mesh, options);
      for (const std::size_t memory :
           {std::size_t{1} << 16U, std::size_t{2} << 20U, std::size_t{8} << 20U}) {
        const Connected many = connect(mesh, options, memory, 4);
        expect_same_facts(many.facts, alone.facts);
        EXPECT_EQ(many.facts.stiff, alone.facts.stiff);
        EXPECT_EQ(many.mesh.tets, alone.mesh.tets);
        EXPECT_EQ(many.mesh.vertices, alone.mesh.vertices);
      }
    }
  }
}

/// Parts that were left out hide no hinge of those that are left, and make none.
/// Labels of the mesh, each with whether a vertex has tets of that label alone and lies on no face
/// of a single tet.
std::map<RawLabel, bool> labels_with_insides(const io::MeshData& mesh) {
  std::map<std::set<std::uint64_t>, int> faces;
  std::map<std::uint64_t, std::set<RawLabel>> around;
  std::map<RawLabel, bool> out;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    out.try_emplace(mesh.labels[t], false);
    for (const std::uint64_t row : mesh.tets[t]) {
      around[row].insert(mesh.labels[t]);
      std::set<std::uint64_t> face(mesh.tets[t].begin(), mesh.tets[t].end());
      face.erase(row);
      ++faces[face];
    }
  }
  std::set<std::uint64_t> outside;
  for (const auto& [face, tets] : faces) {
    if (tets == 1) outside.insert(face.begin(), face.end());
  }
  for (const auto& [row, labels] : around) {
    if (labels.size() == 1 && !outside.contains(row)) out[*labels.begin()] = true;
  }
  return out;
}

TEST(Connect, CountsLabelsWithoutAVertexInside) {
  std::size_t all = 0, stiff = 0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const io::MeshData mesh = random_mesh(seed);
    if (mesh.tets.empty()) continue;
    std::vector<RawLabel> expected;
    const std::map<RawLabel, bool> labels = labels_with_insides(mesh);
    for (const auto& [label, has_inside] : labels) {
      if (!has_inside) expected.push_back(label);
    }
    const ConnectFacts facts = connect(mesh, {}).facts;
    EXPECT_EQ(facts.labels, labels.size());
    EXPECT_EQ(facts.stiff_labels, expected.size());
    EXPECT_EQ(facts.stiff, expected);
    all += labels.size();
    stiff += expected.size();
  }
  EXPECT_GT(stiff, 50U);
  EXPECT_GT(all - stiff, 50U);
}

TEST(Connect, LeavesPartsOut) {
  std::size_t left_out = 0;
  for (unsigned seed = 0; seed < 80; ++seed) {
    SCOPED_TRACE(seed);
    const io::MeshData mesh = random_mesh(seed);
    if (mesh.tets.empty()) continue;
    const auto parts = parts_of(mesh);
    const std::uint64_t least = largest(parts).size() / 2 + 1;
    for (const PartsRule& rule :
         {PartsRule{.only_largest = true}, PartsRule{.least_tets = least}}) {
      const auto [found, facts] = connect(mesh, {.parts = rule});
      std::set<std::size_t> kept;
      std::set<RawLabel> partial;
      for (const auto& [first, tets] : parts) {
        const bool keeps = rule.only_largest ? &tets == &largest(parts) : tets.size() >= least;
        if (keeps) kept.insert(tets.begin(), tets.end());
        for (const std::size_t t : tets) {
          if (!keeps) partial.insert(mesh.labels[t]);
        }
      }
      std::vector<std::array<io::Position, 4>> expected, got;
      for (const std::size_t t : kept) {
        expected.emplace_back();
        for (std::size_t i = 0; i < 4; ++i) expected.back()[i] = mesh.vertices[mesh.tets[t][i]];
      }
      std::set<std::uint64_t> used;
      for (const io::TetRows& tet : found.tets) {
        got.emplace_back();
        for (std::size_t i = 0; i < 4; ++i) got.back()[i] = found.vertices.at(tet[i]);
        used.insert(tet.begin(), tet.end());
      }
      EXPECT_EQ(got, expected);
      EXPECT_EQ(used.size(), found.vertices.size());
      EXPECT_EQ(facts.vertices, found.vertices.size());
      EXPECT_EQ(facts.tets, found.tets.size());
      EXPECT_EQ(std::set(found.record.partial_labels.begin(), found.record.partial_labels.end()),
                partial);
      left_out += mesh.tets.size() - kept.size();
      // All that is told of the rest is what would be told of it alone.
      ConnectFacts alone = connect(found, {}).facts;
      alone.found = facts.found;
      EXPECT_EQ(alone.hinges.size(), facts.hinges.size());
      alone.hinges = facts.hinges;
      expect_same_facts(alone, facts);
    }
  }
  EXPECT_GT(left_out, 1000U);
}

/// Two numbers that tell a tet from others, as long as its corners stay where they are.
std::array<double, 2> values_of(const io::MeshData& mesh, std::size_t tet) {
  double sum = 0.0, weighted = 0.0;
  for (const std::uint64_t row : mesh.tets[tet]) {
    for (std::size_t i = 0; i < 3; ++i) {
      sum += mesh.vertices.at(row)[i];
      weighted += mesh.vertices.at(row)[i] * std::pow(10.0, static_cast<double>(i));
    }
  }
  return {sum, weighted + static_cast<double>(mesh.labels[tet])};
}

TEST(Connect, PassesTheValuesOfTheTetsThatAreLeft) {
  const std::array<ConnectOptions, 4> rules{ConnectOptions{},
                                            {.parts = {.only_largest = true}},
                                            {.split = {.all = true, .pairs = {}}},
                                            {.parts = {.least_tets = 3}, .open_hinges = true}};
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    io::MeshData mesh = random_mesh(seed);
    if (parts_of(mesh).empty() || largest(parts_of(mesh)).size() < 3) continue;
    mesh.values = {{"sum", {}}, {"weighted", {}}};
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      for (std::size_t k = 0; k < 2; ++k) mesh.values[k].numbers.push_back(values_of(mesh, t)[k]);
    }
    const io::MeshData left = connect(mesh, rules[seed % rules.size()]).mesh;
    ASSERT_EQ(left.values.size(), 2U);
    for (std::size_t t = 0; t < left.tets.size(); ++t) {
      const std::array<double, 2> expected = values_of(left, t);
      EXPECT_EQ(left.values[0].numbers.at(t), expected[0]);
      EXPECT_EQ(left.values[1].numbers.at(t), expected[1]);
    }
  }
}

TEST(Connect, SaysHowLargeTheLargestPartIs) {
  const io::MeshData mesh = random_mesh(1);
  try {
    static_cast<void>(connect(mesh, {.parts = {.least_tets = 1'000'000}}));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    const std::string largest_tets = std::to_string(largest(parts_of(mesh)).size());
    EXPECT_NE(std::string(error.what()).find(largest_tets), std::string::npos) << error.what();
  }
}

/// Corners of tets at one vertex have one row exactly when faces that are not split join the tets
/// there, where the vertex is one that is doubled; else all have one row.
TEST(Connect, DoublesVerticesByTheSetsOfTheirStars) {
  std::size_t copies = 0, junctions = 0, opened = 0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const io::MeshData mesh = random_mesh(seed);
    if (mesh.tets.empty()) continue;
    ConnectOptions options;
    options.open_hinges = seed % 3 == 0 || seed % 5 == 0;
    if (seed % 3 == 1) options.split.pairs = {{1, 2}, {2, 3}};
    if (seed % 3 == 2) options.split.all = true;
    const auto [found, facts] = connect(mesh, options);
    ASSERT_EQ(found.tets.size(), mesh.tets.size());
    EXPECT_EQ(found.labels, mesh.labels);
    EXPECT_EQ(found.vertices.size(), mesh.vertices.size() + facts.copies);
    EXPECT_EQ(found.record.has_doubles, facts.copies > 0);
    std::set<std::size_t> all;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) all.insert(t);
    const auto joins = [&](std::size_t one, std::size_t other) {
      return !options.split.cuts(mesh.labels[one], mesh.labels[other]);
    };
    std::size_t doubled = 0;
    for (const auto& [row, star] : stars_of(mesh.tets, all)) {
      bool is_cut = false;
      static_cast<void>(sets_joined_by_faces(mesh.tets, star, {row}, [&](auto one, auto other) {
        is_cut = is_cut || !joins(one, other);
        return true;
      }));
      auto sets = sets_joined_by_faces(mesh.tets, star, {row}, joins);
      if (!is_cut && !options.open_hinges) {
        for (auto& [tet, set] : sets) set = 0;
      }
      std::map<std::size_t, std::uint64_t> row_of;
      std::set<std::uint64_t> rows;
      for (const auto& [tet, set] : sets) {
        const auto& corners = mesh.tets[tet];
        const auto corner = std::find(corners.begin(), corners.end(), row) - corners.begin();
        const std::uint64_t now = found.tets[tet][static_cast<std::size_t>(corner)];
        EXPECT_EQ(found.vertices.at(now), mesh.vertices[row]);
        EXPECT_EQ(row_of.try_emplace(set, now).first->second, now);
        rows.insert(now);
      }
      EXPECT_EQ(rows.size(), row_of.size());
      EXPECT_TRUE(rows.contains(row)) << "one set keeps the vertex";
      doubled += rows.size() > 1 ? 1U : 0U;
      junctions += rows.size() > 2 ? 1U : 0U;
    }
    EXPECT_EQ(facts.doubled, doubled);
    EXPECT_EQ(facts.parts_after, parts_of(found).size());
    copies += facts.copies;
    opened += options.open_hinges && !options.split.any() ? facts.copies : 0;
    // Merged by position it is the mesh that it was.
    const ::mw::test::TempFolder folder;
    io::MeshDataSink back;
    io::MergedVertices merged(back, folder.path());
    io::write_mesh(found, merged);
    EXPECT_EQ(merged.merged(), facts.copies);
    EXPECT_EQ(back.mesh().vertices, mesh.vertices);
    EXPECT_EQ(back.mesh().tets, mesh.tets);
  }
  EXPECT_GT(std::min({copies, junctions, opened}), 50U);
}

TEST(Connect, Promise5SameBytesWhateverTheMemory) {
  for (unsigned seed = 40; seed < 60; ++seed) {
    const io::MeshData mesh = random_mesh(seed);
    if (mesh.tets.empty()) continue;
    const ConnectOptions options{
        .parts = {.least_tets = 3}, .split = {true, {}}, .open_hinges = true};
    if (largest(parts_of(mesh)).size() < 3) continue;
    const Connected one = connect(mesh, options), other = connect(mesh, options, 2000);
    EXPECT_EQ(one.mesh.tets, other.mesh.tets) << seed;
    EXPECT_EQ(one.mesh.vertices, other.mesh.vertices) << seed;
    expect_same_facts(one.facts, other.facts);
  }
}

TEST(ConnectOptions, OfText) {
  EXPECT_EQ(parse_parts("all"), PartsRule{});
  EXPECT_TRUE(parse_parts("largest").only_largest);
  EXPECT_EQ(parse_parts("20").least_tets, 20U);
  for (const char* text : {"", "0", "-1", "most", "1.5"})
    EXPECT_THROW(static_cast<void>(parse_parts(text)), Error);
  const SplitRule some = parse_split("3|1,2|3");
  for (RawLabel one = 0; one < 5; ++one) {
    for (RawLabel other = 0; other < 5; ++other) {
      const std::pair<RawLabel, RawLabel> pair = std::minmax(one, other);
      const bool is_named = pair == std::pair<RawLabel, RawLabel>{1, 3} ||
                            pair == std::pair<RawLabel, RawLabel>{2, 3};
      EXPECT_EQ(some.cuts(one, other), is_named);
      EXPECT_EQ(parse_split("*").cuts(one, other), one != other);
    }
  }
  for (const char* text : {"", "1", "1|", "1|1", "1|2,", "*|1"}) {
    EXPECT_THROW(static_cast<void>(parse_split(text)), Error) << text;
  }
  EXPECT_THROW(check_interfaces({.split = some}, io::LabelTable({1, 2}, false)), Error);
  check_interfaces({.split = some}, io::LabelTable({1, 2, 3}, false));
}

TEST(ConnectOptions, NameLabelsAsTheVolumeDoes) {
  const SplitRule large = parse_split("18446744073709551615|1");
  for (const bool is_signed : {false, true}) {
    expect_error(ErrorKind::kUsage, {is_signed ? "no label -1" : "no label 18446744073709551615"},
                 [&] { check_interfaces({.split = large}, io::LabelTable({1}, is_signed)); });
  }
}

}  // namespace
}  // namespace mw::engine
