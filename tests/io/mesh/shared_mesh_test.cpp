// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file that several write together is that of one, for any division and order of the rows.
#include "io/mesh/shared_mesh.h"

#include <sys/resource.h>

#include <csignal>

#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/sample_mesh.h"

namespace mw::io {
namespace {

/// Rows that one of the writers has: they begin there, and end where the next piece begins.
struct Piece {
  RowPlace begin;
  RowPlace end;
  std::size_t writer = 0;
};

/// Cuts both kinds of rows at random into as many pieces, some of them empty.
std::vector<Piece> random_pieces(std::mt19937& random, const MeshData& mesh, std::size_t writers) {
  constexpr std::size_t kPieces = 12;
  const auto cuts = [&](std::size_t count) {
    std::vector<std::uint64_t> out{0, count};
    std::uniform_int_distribution<std::uint64_t> anywhere(0, count);
    while (out.size() < kPieces + 1) out.push_back(anywhere(random));
    std::sort(out.begin(), out.end());
    return out;
  };
  const auto vertices = cuts(mesh.vertices.size()), tets = cuts(mesh.tets.size());
  std::uniform_int_distribution<std::size_t> any(0, writers - 1);
  std::vector<Piece> out;
  for (std::size_t i = 0; i < kPieces; ++i) {
    out.push_back({{vertices[i], tets[i]}, {vertices[i + 1], tets[i + 1]}, any(random)});
  }
  return out;
}

using Writers = std::vector<std::unique_ptr<SharedMesh>>;

/// The first is the maker, the others have joined.
Writers open_writers(const std::filesystem::path& path, std::size_t count) {
  Writers out;
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back(open_shared_mesh(path));
    if (i == 0) {
      out[0]->create();
    } else {
      out[i]->join(out[0]->place());
    }
  }
  return out;
}

void write_piece(const MeshData& mesh, const Piece& piece, SharedMesh& writer) {
  writer.go_to(piece.begin);
  const std::size_t tets = piece.end.tet - piece.begin.tet;
  writer.write_vertices(
      std::span(mesh.vertices).subspan(piece.begin.vertex, piece.end.vertex - piece.begin.vertex));
  writer.write_tets(std::span(mesh.tets).subspan(piece.begin.tet, tets),
                    std::span(mesh.labels).subspan(piece.begin.tet, tets));
}

/// Pieces of a writer ascend, as it has them; which writer's turn it is, nobody knows.
void write_all(const MeshData& mesh, std::mt19937& random, Writers& writers) {
  std::vector<Piece> pieces = random_pieces(random, mesh, writers.size());
  std::vector<std::size_t> turns(pieces.size());
  std::iota(turns.begin(), turns.end(), 0U);
  std::shuffle(turns.begin(), turns.end(), random);
  std::sort(turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2), turns.end());
  for (std::size_t turn : turns) write_piece(mesh, pieces[turn], *writers[pieces[turn].writer]);
}

MeshHeader header_of(const MeshData& mesh) {
  MeshHeader header{.tets = mesh.tets.size(), .labels_signed = mesh.labels_signed};
  header.record.promises = MeshPromises{.quality_floor = 0.25};
  return header;
}

void save_alone(const MeshData& mesh, const std::filesystem::path& path) {
  const auto sink = open_mesh_sink(path);
  sink->begin(header_of(mesh));
  sink->write_vertices(mesh.vertices);
  sink->write_tets(mesh.tets, mesh.labels);
  sink->finish();
}

TEST(SharedMesh, IsTheFileOfOneWriterByteForByte) {
  const TempDir dir;
  std::mt19937 random(511);
  for (const std::size_t tets : {0U, 1U, 9U, 3000U, 200000U}) {
    for (const std::size_t count : {1U, 2U, 5U}) {
      MeshData mesh = sample_mesh(tets, count == 2);
      if (count == 5 && tets > 0) mesh.record.masks = {{"first", {mesh.labels.front()}}};
      save_alone(mesh, dir.path() / "alone.vtkhdf");
      {
        Writers writers = open_writers(dir.path() / "shared.vtkhdf", count);
        writers[0]->lay_out(header_of(mesh), mesh.vertices.size());
        for (auto& writer : writers) writer->begin(header_of(mesh));
        write_all(mesh, random, writers);
        for (auto& writer : writers) writer->sync();
        EXPECT_FALSE(std::filesystem::exists(dir.path() / "shared.vtkhdf"));
        writers[0]->finish();
      }
      EXPECT_TRUE(content_of(dir.path() / "shared.vtkhdf") ==
                  content_of(dir.path() / "alone.vtkhdf"))
          << tets << " tets, " << count << " writers";
      if (tets > 0) expect_same(read_mesh(dir.path() / "shared.vtkhdf"), mesh);
      std::filesystem::remove(dir.path() / "shared.vtkhdf");
    }
  }
  EXPECT_EQ(dir.entries(), 1U);
}

TEST(SharedMesh, NothingIsLeftWithoutFinish) {
  const TempDir dir;
  const MeshData mesh = sample_mesh(500, false);
  std::mt19937 random(512);
  {
    Writers writers = open_writers(dir.path() / "m.vtkhdf", 3);
    writers[0]->lay_out(header_of(mesh), mesh.vertices.size());
    for (auto& writer : writers) writer->begin(header_of(mesh));
    write_all(mesh, random, writers);
    for (auto& writer : writers) writer->sync();
    EXPECT_EQ(dir.entries(), 1U);
  }
  EXPECT_EQ(dir.entries(), 0U);
}

TEST(SharedMesh, AFullDiskIsTold) {
  const TempDir dir;
  const MeshData mesh = sample_mesh(100000, false);
  Writers writers = open_writers(dir.path() / "m.vtkhdf", 2);
  writers[0]->lay_out(header_of(mesh), mesh.vertices.size());
  for (auto& writer : writers) writer->begin(header_of(mesh));
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  const rlimit small{.rlim_cur = 1 << 20, .rlim_max = old.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  expect_error(ErrorKind::kResource, {dir.path().string(), "cannot write"}, [&] {
    write_piece(mesh, {.begin = {}, .end = {mesh.vertices.size(), mesh.tets.size()}}, *writers[1]);
    writers[1]->sync();
  });
  setrlimit(RLIMIT_FSIZE, &old);
  static_cast<void>(std::signal(SIGXFSZ, old_handler));
}

TEST(SharedMesh, WhoCannotReachTheFileSaysSo) {
  const TempDir dir;
  const auto other = open_shared_mesh(dir.path() / "m.vtkhdf");
  expect_error(ErrorKind::kUsage, {"elsewhere", "every process writes a part"},
               [&] { other->join((dir.path() / "elsewhere" / "m").string()); });
}

TEST(SharedMesh, OnlyWhereRowsHavePlaces) {
  EXPECT_NE(open_shared_mesh("m.vtkhdf"), nullptr);
  EXPECT_EQ(open_shared_mesh("m.vtkhdf", Element::kTet10), nullptr);
  EXPECT_EQ(open_shared_mesh("m.vtu"), nullptr);
  EXPECT_FALSE(std::filesystem::exists("m.vtkhdf"));
}

}  // namespace
}  // namespace mw::io
