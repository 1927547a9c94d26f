// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Surfaces of a mesh in memory, for the tests of surfaces.
#pragma once

#include "io/mesh/grouped/grouped_sink.h"
#include "io/surface/surface.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/test_files.h"

namespace mw::io {

/// Keeps all that it receives.
class CollectSurface : public SurfaceSink {
 public:
  void begin(const SurfaceHeader& header) override { header_ = header; }
  void write_vertices(std::span<const Position> positions) override {
    vertices.insert(vertices.end(), positions.begin(), positions.end());
  }
  void write_triangles(std::span<const Triangle> more) override {
    triangles.insert(triangles.end(), more.begin(), more.end());
  }
  void finish() override {
    EXPECT_EQ(vertices.size(), header_.vertices());
    EXPECT_EQ(triangles.size(), header_.triangles());
    RunCursor cursor(header_);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      cursor.next();
      runs.push_back(cursor.run());
    }
  }

  std::vector<Position> vertices;
  std::vector<Triangle> triangles;
  std::vector<SurfaceRun> runs;  ///< by triangle

 private:
  SurfaceHeader header_;
};

/// A mesh and its facets.
class SurfaceMesh {
 public:
  explicit SurfaceMesh(const MeshData& mesh) : sink_(dir_.path(), nullptr) {
    write_mesh(mesh, sink_);
  }

  [[nodiscard]] GroupedMesh& mesh() { return sink_.mesh(); }
  [[nodiscard]] Surface surface(const std::vector<ShellPlan>& plans, Touching touching) {
    return {{mesh(), dir_.path()}, surface_labels(mesh()), plans, touching};
  }
  [[nodiscard]] Surface surface(const std::vector<ShellPlan>& plans, bool manifold) {
    return surface(plans, manifold ? Touching::kDoubled : Touching::kJoined);
  }
  template <class How>
  [[nodiscard]] CollectSurface collect(const std::vector<ShellPlan>& plans, How how) {
    CollectSurface out;
    surface(plans, how).write(out);
    return out;
  }

 private:
  TempDir dir_;
  GroupedSink sink_;
};

/// Random labels, by cubes (even seeds) or by tets, where surfaces touch themselves everywhere; in
/// every third mesh some tets are left out.
inline MeshData touching_mesh(unsigned seed) {
  MeshData mesh = grid_mesh({4, 3, 3}, seed);
  std::mt19937 random(seed);
  if (seed % 2 == 1) {
    for (RawLabel& label : mesh.labels) label = random() % 3;
  }
  mesh.record.box = MeshBox{.edges = {{{4, 0, 0}, {0, 3, 0}, {0, 0, 3}}}};
  if (seed % 3 != 0) return mesh;
  for (std::size_t i = 0; i < mesh.tets.size(); i += 1 + random() % 9) {
    mesh.tets.erase(mesh.tets.begin() + static_cast<std::ptrdiff_t>(i));
    mesh.labels.erase(mesh.labels.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return mesh;
}

/// Six times what a closed surface encloses.
inline double enclosed6(const CollectSurface& surface) {
  double sum = 0;
  for (const Triangle& t : surface.triangles) {
    sum += volume6_of({0, 0, 0}, surface.vertices[t[0]], surface.vertices[t[1]],
                      surface.vertices[t[2]]);
  }
  return sum;
}

}  // namespace mw::io
