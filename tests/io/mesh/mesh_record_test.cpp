// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Records come back to the bit, through text and through every format that keeps them.
#include "io/mesh/mesh_record.h"
#include "io/codec/hasher.h"
#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/mesh_digest.h"
#include "tests/io/mesh/read_back.h"
#include "tests/io/mesh/sample_mesh.h"

namespace mw::io {
namespace {

/// Numbers of all sizes.
MeshRecord random_record(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto number = [&] {
    return std::ldexp(static_cast<double>(random()) - 0x1p63, static_cast<int>(random() % 80) - 90);
  };
  MeshRecord record;
  if (seed % 4 != 0) {
    record.box.emplace();
    for (double& x : record.box->origin) x = number();
    for (Position& edge : record.box->edges) {
      for (double& x : edge) x = number();
    }
  }
  record.frame = std::array{WorldFrame::kOwn, WorldFrame::kRas, WorldFrame::kLps}[seed / 3 % 3];
  record.unit = std::array{"", "nm", "um", "mm", "m"}[seed % 5];
  const std::vector<RawLabel> labels{random(), random() % 9, ~RawLabel{0} - random() % 9};
  if (seed % 5 == 1) record.only_labels = labels;
  if (seed % 5 == 2) record.without_labels = labels;
  if (seed % 7 == 1) record.partial_labels = labels;
  record.has_doubles = seed % 7 == 2;
  record.curved = seed % 5 == 3;
  if (seed % 11 == 6) record.cohesive.pairs = {{labels[0], labels[1]}, {labels[2], labels[0]}};
  if (seed % 11 == 7) record.cohesive.all = true;
  if (seed % 5 == 4) record.masks = {{"Leber \xc3\xa4 \"x\"", {1, 7}}, {"cohesive", {0}}};
  if (seed % 3 == 0) return record;
  record.promises = MeshPromises{.quality_floor = std::abs(number()),
                                 .interfaces = random() % 2 == 0,
                                 .smooth = random() % 2 == 0,
                                 .optimised = random() % 2 == 0};
  record.promises->halvings = static_cast<int>(seed % 3) % (kMostHalvings + 1);
  if (random() % 2 == 0) record.promises->max_distance = std::abs(number());
  return record;
}

TEST(MeshRecord, ComesBackThroughText) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const MeshRecord record = random_record(seed);
    const std::string text = record_text(record);
    EXPECT_EQ(parse_record(text, "m"), record) << text;
    EXPECT_EQ(text.empty(), record == MeshRecord{});
  }
}

TEST(MeshRecord, ComesBackThroughFilesAndIsNoPartOfTheDigest) {
  const TempDir dir;
  MeshData mesh = sample_mesh(20, false);
  const std::string digest = mesh_digest(mesh);
  for (unsigned seed = 1; seed < 6; ++seed) {
    mesh.record = random_record(seed);
    mesh.record.curved = false;  // these tets have four nodes
    mesh.names = seed % 2 == 0 ? LabelNames() : LabelNames({{1, "a", {}}});
    for (const char* name : {"m.vtkhdf", "m.vtu", "m.mesh", "m.xdmf"}) {
      write_mesh(mesh, *open_mesh_sink(dir.path() / name));
      const MeshData back = read_back(dir.path() / name);
      EXPECT_EQ(back.record, mesh.record) << name;
      EXPECT_EQ(back.names.rows().size(), mesh.names.rows().size()) << name;
      EXPECT_EQ(mesh_digest(back), digest) << name;
    }
  }
}

TEST(MeshRecord, LongOnesComeBackThroughFiles) {
  const TempDir dir;
  MeshData mesh = sample_mesh(20, false);
  for (RawLabel label = 0; label < 10'000; ++label)
    mesh.record.without_labels.push_back(label << 9U);
  for (const char* name : {"m.vtkhdf", "m.vtu", "m.mesh"}) {
    write_mesh(mesh, *open_mesh_sink(dir.path() / name));
    EXPECT_EQ(read_mesh(dir.path() / name).record, mesh.record) << name;
  }
}

TEST(MeshRecord, DamageIsTold) {
  for (
      const char* text :
      {"{",
       "[]",
       R"({"box": 3})",
       R"({"box": {"origin": [0, 0]}})",
       R"({"box": {"origin": [0, 0, 0], "x": [0, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}})",
       R"({"promises": {"quality_floor": -1}})",
       R"({"promises": {"quality_floor": "x"}})",
       R"({"promises": {"max_distance": -1, "quality_floor": 0.1}})",
       R"({"promises": {"quality_floor": 0.1, "topology": 5}})",
       R"({"promises": {"quality_floor": 0.1, "topology": "labels", "surface": "voxel", "halvings": 3}})",
       R"({"promises": {"quality_floor": 0.1, "topology": "labels", "surface": "voxel", "halvings": -1}})",
       R"({"promises": {"quality_floor": 0.1, "topology": "all", "surface": "voxel"}})",
       R"({"promises": {"quality_floor": 0.1, "topology": "labels", "surface": "none"}})",
       R"({"promises": {"quality_floor": 0.1, "topology": "labels", "surface": "voxel",
                         "optimizer": "local"}})",
       R"({"without_labels": [0.5]})",
       R"({"frame": "own"})",
       R"({"unit": "ft"})",
       R"({"frame": 1})",
       R"({"only_labels": 0})",
       R"({"only_labels": [1], "without_labels": [2]})"}) {
    expect_error(ErrorKind::kInput, {"m.vtu"},
                 [&] { static_cast<void>(parse_record(text, "m.vtu")); });
  }
}

// The digest by external sorting is that of sorting in memory.

/// Computes the digest as the header of digest.h says, with containers of everything.
std::string digest_in_memory(const MeshData& mesh) {
  Hasher hasher;
  hasher.add(std::string_view("mwmesh-digest-1"));
  hasher.add(std::uint64_t{mesh.vertices.size()});
  hasher.add(std::uint64_t{mesh.tets.size()});
  std::vector<Position> sorted = mesh.vertices;
  for (Position& p : sorted) {
    for (double& x : p) x += 0.0;
  }
  std::sort(sorted.begin(), sorted.end());
  std::map<Position, std::uint64_t> rank;
  for (std::size_t i = 0; i < sorted.size(); ++i) rank.try_emplace(sorted[i], i);
  for (const Position& p : sorted) {
    for (const double x : p) hasher.add(std::bit_cast<std::uint64_t>(x));
  }
  std::vector<std::array<std::uint64_t, 5>> tets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<std::uint64_t, 5> key{};
    for (std::size_t i = 0; i < 4; ++i) key[i] = rank.at(mesh.vertices[mesh.tets[t][i]]);
    std::sort(key.begin(), key.begin() + 4);
    key[4] = mesh.labels[t];
    tets.push_back(key);
  }
  std::sort(tets.begin(), tets.end());
  for (const auto& key : tets) {
    for (const std::uint64_t number : key) hasher.add(number);
  }
  return "sha256:" + hasher.finish();
}

MeshData random_mesh(std::mt19937& random, std::size_t vertices, std::size_t tets) {
  const auto below = [&](std::size_t count) { return random() % count; };
  MeshData mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    const auto coordinate = [&] { return (static_cast<double>(below(21)) - 10) / 3; };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    mesh.vertices.push_back({x, y, below(2) == 0 ? z : -z});
  }
  for (std::size_t i = 0; i < tets; ++i) {
    const std::uint64_t a = below(vertices), b = below(vertices), c = below(vertices);
    mesh.tets.push_back({a, b, c, below(vertices)});
    mesh.labels.push_back(below(4) == 0 ? ~std::uint64_t{0} : below(5));
  }
  return mesh;
}

TEST(DigestSink, IsTheDigestInMemoryForEveryBudget) {
  const TempDir dir;
  std::mt19937 random(331);
  for (std::size_t i = 0; i < 60; ++i) {
    const MeshData mesh = random_mesh(random, 1 + i * i, i * 40);
    const std::string expected = digest_in_memory(mesh);
    EXPECT_EQ(mesh_digest(mesh), expected);
    for (const std::size_t memory : {1U, 300U, 5000U}) {
      DigestSink sink(dir.path(), memory);
      write_mesh(mesh, sink);
      EXPECT_EQ(sink.digest(), expected) << i << " with " << memory << " bytes";
    }
  }
  EXPECT_EQ(dir.entries(), 0U);
}

TEST(DigestSink, RefusesARowThatNeverCame) {
  const TempDir dir;
  expect_error(ErrorKind::kInternal, {"vertex 4 of 4"}, [&] {
    DigestSink sink(dir.path());
    write_mesh({.vertices = {{}, {}, {}, {}}, .tets = {{0, 1, 2, 4}}, .labels = {1}}, sink);
    static_cast<void>(sink.digest());
  });
}

}  // namespace
}  // namespace mw::io
