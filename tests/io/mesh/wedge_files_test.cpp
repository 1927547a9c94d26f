// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files of meshes with wedges are read as the tets that they follow from.
#include "io/file/errors.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "tests/io/mesh/mesh_digest.h"
#include "tests/io/mesh/mesh_endings.h"
#include "tests/io/mesh/sample_mesh.h"
#include "tests/io/mesh/written_mesh.h"

namespace mw::io {
namespace {

/// Each label has vertices of its own, so that all interfaces are open.
MeshData open_grid(unsigned seed) {
  const MeshData whole = grid_mesh({3, 3, 2}, seed);
  MeshData out;
  std::map<std::pair<std::uint64_t, RawLabel>, std::uint64_t> rows;
  for (std::size_t t = 0; t < whole.tets.size(); ++t) {
    TetRows& tet = out.tets.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const std::pair key(whole.tets[t][i], whole.labels[t]);
      const auto [at, is_new] = rows.try_emplace(key, out.vertices.size());
      if (is_new) out.vertices.push_back(whole.vertices[key.first]);
      tet[i] = at->second;
    }
    out.labels.push_back(whole.labels[t] + 5);
  }
  out.names = LabelNames({{6, "COHESIVE_x", {}}, {7, "a", Colour{1, 2, 3, 4}}});
  out.record.has_doubles = true;
  out.record.cohesive.all = true;
  return out;
}

std::uint64_t wedges_in(const MeshData& mesh) {
  const TempDir dir;
  GroupedSink sink(dir.path(), nullptr);
  write_mesh(mesh, sink);
  return sink.mesh().wedge_count();
}

bool takes_wedges(const std::filesystem::path& path, Element element) {
  try {
    require_place_for_wedges(path, element);
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    return false;
  }
}

TEST(WedgeFiles, AreReadAsTheirTets) {
  const TempDir dir;
  int read = 0;
  for (unsigned seed = 1; seed < 5; ++seed) {
    const MeshData mesh = open_grid(seed);
    ASSERT_GT(wedges_in(mesh), 20U);
    for (const std::string& ending : mesh_endings(read_mesh_extensions())) {
      for (const Element element : {Element::kTet4, Element::kTet10}) {
        SCOPED_TRACE(text(seed, ending, node_count(element)));
        const auto path = dir.path() / ("m" + ending);
        if (ending == kPiecesExtension || !takes_wedges(path, element)) continue;
        save(mesh, path, element);
        const MeshData back = read_mesh(path);
        EXPECT_EQ(mesh_digest(back), mesh_digest(mesh));
        EXPECT_EQ(back.vertices.size(), mesh.vertices.size());
        EXPECT_EQ(back.record, mesh.record);
        EXPECT_EQ(back.names.name(6), "COHESIVE_x");
        EXPECT_EQ(back.names.name(7), "a");
        EXPECT_EQ(wedges_in(back), wedges_in(mesh));
        ++read;
      }
    }
  }
  EXPECT_EQ(read, 4 * 6);
}

TEST(WedgeFiles, AreTheSameBytesWhetherWedgesAreExpectedOrFound) {
  const TempDir dir;
  const MeshData mesh = open_grid(2);
  for (const char* const name : {"m.vtu", "m.vtkhdf", "m.msh", "m.inp", "m.exo"}) {
    const auto path = dir.path() / name;
    save(mesh, path);
    const std::string found = content_of(path);
    const auto sink = open_mesh_sink(path, Element::kTet4, {.wedges = true});
    EXPECT_GE(sink->buffer_bytes(), 64U << 20) << name;
    write_mesh(mesh, *sink);
    EXPECT_TRUE(content_of(path) == found) << name;
  }
}

/// A mesh of another tool may consist of wedges that do not follow from its tets.
TEST(WedgeFiles, WithoutARecordAreRefused) {
  const TempDir dir;
  const auto path = dir.path() / "m.vtu";
  save(open_grid(1), path);
  std::string bytes = content_of(path);
  const std::size_t at = bytes.find("Name=\"mwmesh\"");
  ASSERT_NE(at, bytes.npos);
  bytes[at + 6] = 'x';
  const auto other = dir.file("other.vtu", bytes);
  expect_error(ErrorKind::kInput, {other.string(), "type 13 is no tetrahedron"},
               [&] { static_cast<void>(read_mesh(other)); });
}

TEST(WedgeFiles, OfOtherFormatsAreRefusedAndLeaveNothing) {
  const MeshData mesh = open_grid(1);
  int refused = 0;
  for (const std::string& ending : mesh_endings()) {
    for (const Element element : {Element::kTet4, Element::kTet10}) {
      const TempDir dir;
      const auto path = dir.path() / ("m" + ending);
      if (takes_wedges(path, element) || (ending == ".mesh" && element == Element::kTet10))
        continue;
      expect_error(ErrorKind::kUsage, {path.string(), "no place for cohesive wedges", ".vtu"},
                   [&] { save(mesh, path, element); });
      EXPECT_EQ(dir.entries(), 0U) << path;
      ++refused;
    }
  }
  EXPECT_EQ(refused, 6 + 9);
  const TempDir dir;
  expect_error(ErrorKind::kUsage, {"m.pvtu", "no place for cohesive wedges"},
               [&] { write_mesh(mesh, *open_mesh_pieces(dir.path() / "m.pvtu", 2)); });
}

TEST(WedgeFiles, SurviveDamage) {
  for (const char* const name : {"m.vtu", "m.vtkhdf", "m.msh2"}) {
    const TempDir dir;
    save(open_grid(3), dir.path() / name);
    EXPECT_GT(try_damage(dir, name, content_of(dir.path() / name)), 20) << name;
  }
}

}  // namespace
}  // namespace mw::io
