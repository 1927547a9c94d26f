// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One segment of neuroglancer's multi-resolution meshes.
// Format: https://github.com/google/neuroglancer/blob/master/src/datasource/precomputed/meshes.md
// Format: https://google.github.io/draco/spec/
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/surface/precomputed/draco_segments.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

struct TriangleSurface {
  std::vector<Position> vertices;
  std::vector<Triangle> triangles;
};

/// Lengths of the edges of all triangles; 0 where there are none.
struct EdgeLengths {
  double mean = 0;
  double longest = 0;
};
[[nodiscard]] EdgeLengths edge_lengths(const TriangleSurface& surface);

/// Writes levels of detail on an octree.  The first is the surface itself; each later one has its
/// topology, keeps its volume as far as SurfaceDecimator does, may be twice as far from it as the
/// one before, and has cells twice as long; one of few triangles is the last.  A cell is 64 mean
/// edges long, so that its mesh has some 10^4 triangles at any level, and a viewer fetches the
/// cells that it shows. Meshes are Draco's, with whole coordinates of 1/1024 mean edge.  Vertices
/// of the first level that are rounded to the same place stay apart, so that the surface stays as
/// closed in a cell as it is, and cells meet along their planes point by point. Memory: the
/// segment, 500 bytes a triangle at most.
class DracoSink : public SurfaceSink {
 public:
  /// REQUIRES: segments outlives it.
  DracoSink(DracoSegments& segments, std::uint64_t segment, double nm_per_unit)
      : segments_(segments), segment_(segment), nm_per_unit_(nm_per_unit) {}

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override;

 private:
  DracoSegments& segments_;
  std::uint64_t segment_;
  double nm_per_unit_;
  TriangleSurface surface_;  ///< nm
};

}  // namespace mw::io
