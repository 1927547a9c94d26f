// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One segment of neuroglancer's multi-resolution meshes.
#pragma once

#include <filesystem>

#include "io/surface/surface_sink.h"

namespace mw::io {

/// Bits of a coordinate within the box of a segment: 10 or 16.
inline constexpr int kDracoBits = 16;

/// FOLDER/ID.index, the manifest: one level of detail, one fragment, the box of the segment; and
/// FOLDER/ID, the fragment: a Draco mesh, coordinates whole numbers from 0 to 2^16 - 1 in the box.
/// Vertices that are rounded to the same place stay apart, so the surface stays as closed as it is.
/// Memory: the segment, some 200 bytes a triangle: Draco takes it at once.
class DracoSink : public SurfaceSink {
 public:
  /// segment: FOLDER/ID.
  DracoSink(std::filesystem::path segment, double nm_per_unit)
      : segment_(std::move(segment)), nm_per_unit_(nm_per_unit) {}

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override;

 private:
  std::filesystem::path segment_;
  double nm_per_unit_;
  std::vector<Position> vertices_;  ///< nm
  std::vector<Triangle> triangles_;
};

}  // namespace mw::io
