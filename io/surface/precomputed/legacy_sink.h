// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One segment of neuroglancer's legacy meshes.
#pragma once

#include "io/file/atomic_file.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// FOLDER/ID:0, JSON that names one fragment, and the fragment, FOLDER/ID.mesh: the number of
/// vertices (u32), their coordinates (3 x f32, nm), the vertices of triangles (3 x u32).
class LegacySink : public SurfaceSink {
 public:
  /// segment: FOLDER/ID.
  LegacySink(const std::filesystem::path& segment, double nm_per_unit);

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override;

 private:
  std::filesystem::path segment_;
  std::filesystem::path fragment_;
  AtomicFile file_;
  double nm_per_unit_;
};

}  // namespace mw::io
