// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Small solid meshes of several labels: a grid of cubes, six tets each.
#pragma once

#include "io/mesh/mesh_data.h"
#include "tests/testing.h"

namespace mw::io {

/// Six times the signed volume.
inline double volume6_of(const Position& a, const Position& b, const Position& c,
                         const Position& d) {
  std::array<Position, 3> e{};
  for (std::size_t k = 0; k < 3; ++k) {
    e[0][k] = b[k] - a[k];
    e[1][k] = c[k] - a[k];
    e[2][k] = d[k] - a[k];
  }
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    sum +=
        e[0][k] * (e[1][(k + 1) % 3] * e[2][(k + 2) % 3] - e[1][(k + 2) % 3] * e[2][(k + 1) % 3]);
  }
  return sum;
}

/// Unit cubes from (0, 0, 0) on; every cube has a random label from 0 to 3.
inline MeshData grid_mesh(std::array<std::uint64_t, 3> cubes, unsigned seed) {
  std::mt19937 random(seed);
  MeshData mesh;
  const auto row = [&](std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return (z * (cubes[1] + 1) + y) * (cubes[0] + 1) + x;
  };
  for (std::uint64_t v = 0; v < (cubes[0] + 1) * (cubes[1] + 1) * (cubes[2] + 1); ++v) {
    const std::uint64_t line = v / (cubes[0] + 1), layer = line / (cubes[1] + 1);
    mesh.vertices.push_back({static_cast<double>(v % (cubes[0] + 1)),
                             static_cast<double>(line % (cubes[1] + 1)),
                             static_cast<double>(layer)});
  }
  // The six ways from one end of a cube's diagonal to the other.
  constexpr std::array<std::array<std::size_t, 3>, 6> kWays{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (std::uint64_t cube = 0; cube < cubes[0] * cubes[1] * cubes[2]; ++cube) {
    const std::array<std::uint64_t, 3> corner{cube % cubes[0], cube / cubes[0] % cubes[1],
                                              cube / cubes[0] / cubes[1]};
    const RawLabel label = random() % 4;
    for (std::size_t way = 0; way < kWays.size(); ++way) {
      TetRows tet{};
      std::array<std::uint64_t, 3> at = corner;
      for (std::size_t i = 0; i < 4; ++i) {
        tet[i] = row(at[0], at[1], at[2]);
        if (i < 3) ++at[kWays[way][i]];
      }
      if (way >= 3) std::swap(tet[2], tet[3]);
      mesh.tets.push_back(tet);
      mesh.labels.push_back(label);
    }
  }
  return mesh;
}

/// Moves each vertex of a cube of edge^3 unit cubes by up to 0.1 along each axis, within its
/// sides.
inline void shake(MeshData& mesh, double edge, unsigned seed) {
  std::mt19937 random(seed);
  for (Position& p : mesh.vertices) {
    for (double& x : p) {
      if (x != 0 && x != edge) x += 0.2 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
    }
  }
}

}  // namespace mw::io
