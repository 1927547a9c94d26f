// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The digest by external sorting is that of sorting in memory.
#include "io/mesh/digest.h"

#include <map>
#include <random>

#include "io/mesh/hasher.h"
#include "tests/io/mesh/sample_mesh.h"

namespace mw::io {
namespace {

/// Computes the digest as the header of digest.h describes it, with containers of everything.
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
    const auto coordinate = [&] { return (static_cast<double>(below(21)) - 10) / 4; };
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
