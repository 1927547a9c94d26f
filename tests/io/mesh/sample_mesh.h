// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Small meshes for the tests of mesh files.
#pragma once

#include "io/mesh/mesh_data.h"
#include "tests/io/test_files.h"

namespace mw::io {

/// `count` tets on a strip of points with coordinates that need all digits of a double.
inline MeshData sample_mesh(std::size_t count, bool labels_signed) {
  MeshData mesh;
  mesh.labels_signed = labels_signed;
  for (std::size_t i = 0; i < count + 3; ++i) {
    const auto x = static_cast<double>(i);
    mesh.vertices.push_back({x / 3, -0.1 * x, 1e-300 * x + static_cast<double>(i % 3)});
  }
  const RawLabel large = labels_signed ? static_cast<RawLabel>(-5) : (1ULL << 63) + 7;
  for (std::size_t i = 0; i < count; ++i) {
    mesh.tets.push_back({i, i + 1, i + 2, i + 3});
    mesh.labels.push_back(i % 2 == 0 ? large : i);
  }
  return mesh;
}

inline void expect_same(const MeshData& a, const MeshData& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.labels_signed, b.labels_signed);
}

}  // namespace mw::io
