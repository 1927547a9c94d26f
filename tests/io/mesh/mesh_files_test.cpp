// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes survive every format; their digest does not depend on it.
#include <sys/resource.h>

#include <csignal>

#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/mesh_digest.h"
#include "tests/io/mesh/sample_mesh.h"
#include "tests/io/names/random_names.h"

namespace mw::io {
namespace {

const char* const kNames[] = {"m.vtkhdf", "m.vtu", "m.mesh"};

void save(const MeshData& mesh, const std::filesystem::path& path) {
  write_mesh(mesh, *open_mesh_sink(path));
}

TEST(MeshFiles, RoundTripAndSameDigest) {
  const TempDir dir;
  for (const bool labels_signed : {false, true}) {
    // The large one fills the sinks' buffers several times.
    for (const std::size_t tets : {1U, 2U, 50000U}) {
      const MeshData mesh = sample_mesh(tets, labels_signed);
      for (const char* name : kNames) {
        save(mesh, dir.path() / name);
        const MeshData back = read_mesh(dir.path() / name);
        expect_same(back, mesh);
        EXPECT_EQ(mesh_digest(back), mesh_digest(mesh));
      }
    }
  }
  EXPECT_EQ(dir.entries(), 3U);
}

/// Saves a mesh as blocks come: vertices and tets by turns, in batches of any size.
void save_by_turns(const MeshData& mesh, const std::filesystem::path& path) {
  const auto sink = open_mesh_sink(path);
  sink->begin({.tets = mesh.tets.size(), .labels_signed = mesh.labels_signed});
  std::size_t vertices = 0;
  std::size_t tets = 0;
  for (std::size_t step = 1; tets < mesh.tets.size(); step = step * 3 % 1009) {
    const std::size_t more = std::min(step, mesh.vertices.size() - vertices);
    sink->write_vertices(std::span(mesh.vertices).subspan(vertices, more));
    vertices += more;
    const std::size_t ready = vertices < 4 ? 0 : vertices - 3 - tets;
    sink->write_tets(std::span(mesh.tets).subspan(tets, ready),
                     std::span(mesh.labels).subspan(tets, ready));
    tets += ready;
  }
  sink->finish();
}

TEST(MeshFiles, SameBytesEveryTimeHoweverRowsArrive) {
  const TempDir dir;
  for (const std::size_t tets : {1U, 7U, 70000U}) {
    const MeshData mesh = sample_mesh(tets, false);
    for (const char* name : kNames) {
      save(mesh, dir.path() / name);
      const std::string first = content_of(dir.path() / name);
      save(mesh, dir.path() / name);
      EXPECT_TRUE(content_of(dir.path() / name) == first) << name;
      save_by_turns(mesh, dir.path() / name);
      EXPECT_TRUE(content_of(dir.path() / name) == first) << name;
    }
  }
}

TEST(MeshFiles, CopyThroughEveryPairOfFormats) {
  const TempDir dir;
  MeshData mesh = sample_mesh(3000, true);
  std::mt19937 random(52);
  mesh.names = random_names(random, 20);
  for (const char* from : kNames) {
    save(mesh, dir.path() / from);
    for (const char* to : kNames) {
      const auto path = dir.path() / (std::string("copy_") + to);
      copy_mesh(dir.path() / from, *open_mesh_sink(path));
      const MeshData copy = read_mesh(path);
      expect_same(copy, mesh);
      expect_same_names(copy.names, mesh.names);
    }
  }
}

/// The limit on the size of files stands in for a full disk.
TEST(MeshFiles, OutOfRoomIsAResourceErrorAndLeavesNothing) {
  const TempDir dir;
  const MeshData mesh = sample_mesh(200000, false);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  for (const rlim_t room : {rlim_t{100}, rlim_t{5000}, rlim_t{1 << 21}, rlim_t{9 << 20}}) {
    const rlimit small{.rlim_cur = room, .rlim_max = old.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    for (const char* name : kNames) {
      expect_error(ErrorKind::kResource, {dir.path().string()},
                   [&] { save(mesh, dir.path() / name); });
    }
    setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_EQ(dir.entries(), 0U);
  }
  static_cast<void>(std::signal(SIGXFSZ, old_handler));
  // The library that wrote into the full disk is none the worse for it.
  save(sample_mesh(100, false), dir.path() / "m.vtkhdf");
  EXPECT_EQ(read_mesh(dir.path() / "m.vtkhdf").tets.size(), 100U);
}

TEST(MeshFiles, NothingIsLeftWhenTetsAreMissing) {
  const TempDir dir;
  const MeshData mesh = sample_mesh(10, false);
  for (const char* name : kNames) {
    expect_error(ErrorKind::kInternal, {name, "0 tets were written, 10"}, [&] {
      const auto sink = open_mesh_sink(dir.path() / name);
      sink->begin({.tets = 10});
      sink->write_vertices(mesh.vertices);
      sink->finish();
    });
  }
  EXPECT_EQ(dir.entries(), 0U);
}

/// Cuts the file at every length; in a .vtkhdf, which is read in a process of its own each time, at
/// some.  The closing tags of a .vtu hold nothing, nor do the last letters of a .mesh.  Of a .vtu
/// that can be told for one, the message says what is wrong.
void expect_cuts_refused(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  const std::size_t tail = extension == ".vtkhdf" ? 1 : extension == ".vtu" ? 34 : 4;
  const std::size_t step = extension == ".vtkhdf" ? 13 : 1;
  for (std::size_t size = std::filesystem::file_size(path) - tail + 1; size > 0;) {
    size -= std::min(size, step);
    std::filesystem::resize_file(path, size);
    std::vector<std::string> pieces{path.string()};
    if (extension == ".vtu" && size >= 64) pieces.emplace_back("truncated");
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(read_mesh(path)); });
  }
}

TEST(MeshFiles, EveryTruncationIsRefused) {
  const TempDir dir;
  MeshData mesh = sample_mesh(3, false);
  for (const bool named : {false, true}) {
    if (named) mesh.names = LabelNames({{1, "one", Colour{1, 2, 3, 4}}, {7, "sieben", {}}});
    for (const char* name : kNames) {
      save(mesh, dir.path() / name);
      expect_cuts_refused(dir.path() / name);
    }
  }
}

TEST(MeshFiles, UnknownExtensions) {
  for (const char* name : {"m.stl", "m"}) {
    expect_error(ErrorKind::kUsage, {name, ".vtkhdf, .vtu, .mesh", ".pvtu"},
                 [&] { static_cast<void>(read_mesh(name)); });
    expect_error(ErrorKind::kUsage, {name, ".vtkhdf, .vtu, .mesh"},
                 [&] { static_cast<void>(open_mesh_sink(name)); });
  }
  expect_error(ErrorKind::kInput, {"gone.vtu"}, [] { static_cast<void>(read_mesh("gone.vtu")); });
}

TEST(Medit, ToleratesOtherSectionsCommentsAndLineEnds) {
  const TempDir dir;
  const auto path =
      dir.file("a.mesh",
               "MeshVersionFormatted 1\r\n# comment 1 2 3\r\nDimension\r\n3\r\n"
               "Vertices 4\r\n0 0 0 1\r\n+1 0 0 1 # here too\r\n0 1e0 0 1\r\n0 0 1. 1"
               "\r\nEdges\n1\n1 2 0\nTriangles\n1\n1 2 3 7\nTetrahedra\n1\n1 2 3 4 -9\n"
               "Corners\n1\n1\nEnd\n");
  const MeshData mesh = read_mesh(path);
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[3], (Position{0, 0, 1}));
  EXPECT_EQ(mesh.tets, (std::vector<TetRows>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh.labels, (std::vector<RawLabel>{static_cast<RawLabel>(-9)}));
  EXPECT_TRUE(mesh.labels_signed);
}

TEST(Medit, RefusesBrokenFiles) {
  const TempDir dir;
  const std::string head = "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n";
  const std::string points = "0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
  const auto refuse = [&](const std::string& content, std::vector<std::string> pieces) {
    const auto path = dir.file("a.mesh", content);
    pieces.push_back(path.string());
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(read_mesh(path)); });
  };
  refuse("solid stl\n", {"not a MEDIT file"});
  refuse(std::string(5000, 'x'), {"not an ASCII"});
  refuse("MeshVersionFormatted 2\nDimension 2\n", {"line 2", "dimension"});
  refuse(head + points + "Tetrahedra\n1\n1 2 3 5 0\nEnd\n", {"line 11", "vertex 5"});
  refuse(head + points + "Tetrahedra\n1\n0 2 3 4 0\nEnd\n", {"line 11", "vertex 0"});
  refuse(head + points + "Tetrahedra\n999999999999\n1 2 3 4 0\nEnd\n", {"999999999999 rows"});
  refuse(head + "0 0 nan 0\n", {"line 5", "nan"});
  refuse(head + points + "Tetrahedra\n1\n1 2 3 4 0.5\nEnd\n", {"0.5"});
  refuse(head + points + "End\n", {"Tetrahedra"});
}

/// Pins the byte layout that the header documents: sha256 of "mwmesh-digest-1" and 16 zero bytes.
TEST(Digest, OfTheEmptyMesh) {
  EXPECT_EQ(mesh_digest({}),
            "sha256:e4621f1bd13ad7312e8bd78d6dc6450af2d63b074e938138dd3f53165c8f6c4b");
}

}  // namespace
}  // namespace mw::io
