// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facets of a mesh in columns are those of brute force, and files of such a mesh those of a stream.
#include "io/mesh/scratch_mesh.h"

#include <thread>

#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/mesh/mesh_endings.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

/// A tet that has a triangle, with its opposite corner; true if the triangle's normal points out.
using Side = std::tuple<std::uint64_t, RawLabel, std::uint64_t, bool>;
using Triangles = std::map<std::array<std::uint64_t, 3>, std::vector<Side>>;

void fill(ScratchMesh& out, const MeshData& mesh) {
  ScratchMeshSink into(out);
  write_mesh(mesh, into);
}

Triangles facets_of(const MeshData& mesh) {
  Triangles out;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      std::vector<std::uint64_t> rows(mesh.tets[t].begin(), mesh.tets[t].end());
      rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(opposite));
      std::sort(rows.begin(), rows.end());
      const auto at = [&](std::uint64_t row) { return mesh.vertices[row]; };
      const bool out_of_it =
          volume6_of(at(rows[0]), at(rows[1]), at(rows[2]), at(mesh.tets[t][opposite])) < 0;
      out[{rows[0], rows[1], rows[2]}].emplace_back(t, mesh.labels[t], opposite, out_of_it);
    }
  }
  std::erase_if(out, [](const auto& facet) {
    const std::vector<Side>& sides = facet.second;
    return sides.size() == 2 && std::get<1>(sides[0]) == std::get<1>(sides[1]);
  });
  return out;
}

Triangles facets_of(ScratchMesh& mesh, std::size_t sort_bytes) {
  Triangles out;
  std::array<std::uint64_t, 3> last{};
  mesh.facets(sort_bytes).each_batch<MeshFacet>([&](std::span<const MeshFacet> batch) {
    for (const MeshFacet& facet : batch) {
      EXPECT_TRUE(out.empty() || last < facet.rows);
      last = facet.rows;
      std::vector<Side>& sides = out[facet.rows];
      for (std::size_t i = 0; i < facet.tets; ++i) {
        const auto& [tet, label, opposite, points_out] = facet.sides.at(i);
        sides.emplace_back(tet, label, opposite, points_out == 1);
      }
      std::sort(sides.begin(), sides.end());
    }
  });
  return out;
}

TEST(ScratchMesh, FacetsAreThoseOfBruteForceWithAnyMemory) {
  const TempDir dir;
  for (unsigned seed = 0; seed < 6; ++seed) {
    MeshData mesh = grid_mesh({4, 3, 2 + seed}, seed);
    std::mt19937 random(seed);
    for (TetRows& tet : mesh.tets) std::shuffle(tet.begin(), tet.end(), random);
    const Triangles expected = facets_of(mesh);
    for (const std::size_t sort_bytes : {std::size_t{0}, std::size_t{5000}, std::size_t{1} << 20}) {
      ScratchMesh stored(dir.path());
      fill(stored, mesh);
      EXPECT_EQ(facets_of(stored, sort_bytes), expected);
      EXPECT_EQ(facets_of(stored, 0), expected);  // those that are there
    }
  }
}

TEST(ScratchMesh, SeveralThreadsReadTets) {
  const TempDir dir;
  const MeshData mesh = grid_mesh({6, 6, 6}, 2);
  ScratchMesh stored(dir.path());
  fill(stored, mesh);
  stored.settle();
  std::vector<TetRows> tets(mesh.tets.size());
  std::vector<RawLabel> labels(tets.size());
  std::vector<std::thread> threads;
  for (std::size_t part = 0; part < 4; ++part) {
    threads.emplace_back([&, part] {
      for (std::size_t at = 10 * part; at < tets.size(); at += 40) {
        const std::size_t count = std::min<std::size_t>(10, tets.size() - at);
        stored.read_tets(at, std::span(tets).subspan(at, count),
                         std::span(labels).subspan(at, count));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(tets, mesh.tets);
  EXPECT_EQ(labels, mesh.labels);
}

/// Tets on both sides of doubled vertices share a facet.
TEST(ScratchMesh, FacetsJoinDoubledVertices) {
  const TempDir dir;
  const MeshData mesh = grid_mesh({3, 3, 3}, 9);
  MeshData doubled = mesh;
  doubled.record.has_doubles = true;
  for (std::size_t t = 0; t < doubled.tets.size(); t += 3) {
    for (std::uint64_t& row : doubled.tets[t]) {
      doubled.vertices.push_back(doubled.vertices[row]);
      row = doubled.vertices.size() - 1;
    }
  }
  ScratchMesh stored(dir.path());
  fill(stored, doubled);
  EXPECT_EQ(facets_of(stored, 1 << 20), facets_of(mesh));
  for (std::uint64_t row = 0; row < doubled.vertices.size(); ++row) {
    EXPECT_EQ(doubled.vertices[stored.first_of(row)], doubled.vertices[row]);
    EXPECT_LT(stored.first_of(row), mesh.vertices.size());
  }
}

TEST(ScratchMesh, AFacetTellsOfMoreThanTwoTets) {
  const TempDir dir;
  MeshData mesh{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}},
                .tets = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}},
                .labels = {1, 1, 1}};
  ScratchMesh stored(dir.path());
  fill(stored, mesh);
  std::uint64_t most = 0;
  stored.facets(0).each_batch<MeshFacet>([&](std::span<const MeshFacet> batch) {
    for (const MeshFacet& facet : batch) most = std::max(most, facet.tets);
  });
  EXPECT_EQ(most, 3U);
  mesh.tets[2][3] = 6;
  ScratchMesh wrong(dir.path());
  fill(wrong, mesh);
  expect_error(ErrorKind::kInput, {"a tet names vertex 6 of 6"},
               [&] { static_cast<void>(wrong.facets(0)); });
}

/// Returns the bytes of all files of a mesh by the ends of their names.
std::map<std::string, std::string> files_of(const std::filesystem::path& path) {
  std::map<std::string, std::string> out;
  for (const auto& file : mesh_files(path)) {
    if (std::filesystem::exists(file)) out[file.extension().string()] = content_of(file);
  }
  return out;
}

TEST(ScratchMesh, IsWrittenWhereItLiesAsItIsWhenItComesByRows) {
  const TempDir dir;
  MeshData mesh = grid_mesh({3, 3, 2}, 5);
  mesh.values.push_back({"depth", {}});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.values[0].numbers.push_back(static_cast<double>(t));
  }
  std::size_t tried = 0;
  for (const std::string& ending : mesh_endings()) {
    for (const Element element : {Element::kTet4, Element::kTet10, Element::kCurvedTet10}) {
      if (!why_no_middles("a" + ending, false).empty() && element != Element::kTet4) continue;
      SCOPED_TRACE(ending);
      const auto path = dir.path() / ("a" + ending);
      write_mesh(mesh, *open_mesh_sink(path, element));
      const auto expected = files_of(path);
      ScratchMesh stored(dir.path());
      fill(stored, mesh);
      std::size_t asked = 0;
      stored.copy_to(*open_mesh_sink(path, element), [&] { ++asked; });
      EXPECT_EQ(files_of(path), expected);
      EXPECT_GT(asked, 0U);
      ++tried;
    }
  }
  EXPECT_GE(tried, 30U);
}

}  // namespace
}  // namespace mw::io
