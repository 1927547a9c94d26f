// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes and damage for the tests of formats that group tets.
#pragma once

#include <sys/resource.h>

#include <csignal>

#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/test_files.h"

namespace mw::io {

/// A grid of labels that need 64 bits, or of signed ones; with vertices that no tet has, and names.
inline MeshData named_grid(unsigned seed, bool labels_signed) {
  MeshData mesh = grid_mesh({3, 3, 2}, seed);
  const std::array<RawLabel, 4> labels = labels_signed
                                             ? std::array<RawLabel, 4>{0, 3, ~0ULL, 1ULL << 63}
                                             : std::array<RawLabel, 4>{0, 3, 1ULL << 40, ~0ULL};
  for (RawLabel& label : mesh.labels) label = labels[label];
  mesh.labels_signed = labels_signed;
  mesh.names = LabelNames({{0, "air \"outside\"", Colour{1, 2, 3, 255}},
                           {labels[2], "Größe, 漢字", std::nullopt},
                           {labels[3], "", Colour{9, 8, 7, 6}}});
  for (Position& p : mesh.vertices) p = {p[0] / 3 - 0.1, 1e3 * p[1], 1e-9 * p[2]};
  mesh.vertices.insert(mesh.vertices.begin() + 5, Position{7, 7, 7});
  for (TetRows& tet : mesh.tets) {
    for (std::uint64_t& row : tet) row += row >= 5 ? 1 : 0;
  }
  mesh.vertices.push_back({8, 8, 8});
  return mesh;
}

inline void save(const MeshData& mesh, const std::filesystem::path& path,
                 Element element = Element::kTet4, Encoding encoding = Encoding::kUsual) {
  write_mesh(mesh, *open_mesh_sink(path, element, {.encoding = encoding}));
}

/// Reads it or throws the error of bad input; anything else fails the test.
inline void try_mesh(const std::filesystem::path& path, std::size_t position, int& refused) {
  try {
    const MeshData mesh = read_mesh(path);
    EXPECT_LE(mesh.tets.size(), 100'000U) << position;
    EXPECT_EQ(mesh.labels.size(), mesh.tets.size());
    for (const TetRows& tet : mesh.tets) {
      for (const std::uint64_t row : tet) EXPECT_LT(row, mesh.vertices.size()) << position;
    }
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput) << position << ": " << error.what();
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    ++refused;
  }
}

/// Random bytes at random places, bits turned over, and digits made larger; returns how many were
/// refused.
inline int try_damage(const TempDir& dir, const std::string& name, const std::string& good) {
  std::mt19937 random(7);
  int refused = 0;
  for (std::size_t i = 0; i < 600; ++i) {
    std::string bad = good;
    const std::size_t at = random() % bad.size();
    if (i % 4 == 0) bad[at] = static_cast<char>(random());
    if (i % 4 == 1) bad[at] = static_cast<char>(bad[at] ^ (1 << random() % 8));
    if (i % 4 == 2) bad.replace(at, std::min<std::size_t>(8, bad.size() - at), 8, '\xff');
    if (i % 4 == 3) bad.replace(at, std::min<std::size_t>(6, bad.size() - at), "999999");
    try_mesh(dir.file(name, bad), at, refused);
  }
  return refused;
}

/// The limit on the size of files stands in for a full disk; it is full of what waits, or of the
/// file itself.
inline void expect_full_disk(const std::string& name, Encoding encoding) {
  const TempDir dir;
  const MeshData mesh = grid_mesh({20, 20, 20}, 1);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  for (const rlim_t room : {rlim_t{100}, rlim_t{1 << 18}, rlim_t{2500 << 10}}) {
    const rlimit small{.rlim_cur = room, .rlim_max = old.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    expect_error(ErrorKind::kResource, {dir.path().string()},
                 [&] { save(mesh, dir.path() / name, Element::kTet10, encoding); });
    setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_EQ(dir.entries(), 0U) << room;
  }
  static_cast<void>(std::signal(SIGXFSZ, old_handler));
}

}  // namespace mw::io
