// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One segment of neuroglancer's multi-resolution meshes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "io/file/sink/atomic_file.h"
#include "io/surface/precomputed/coarser_surface.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// Bits of a coordinate within the box of a segment: 10 or 16.
inline constexpr int kDracoBits = 16;

/// The box of a segment in the numbers that its file has.
struct FloatBox {
  std::array<float, 3> origin{};
  std::array<float, 3> shape{};
};

/// FOLDER/ID.index, the manifest: levels of detail, each in one fragment, and the box of the
/// segment; and FOLDER/ID, the fragments: Draco meshes, coordinates whole numbers in a box that is
/// twice as large for each level.  The first level is the surface itself: vertices that are rounded
/// to the same place stay apart, so it stays as closed as it is.  Each level after it may be twice
/// as far from it (clustered()); there is none after one of few triangles.
/// Memory: the segment, some 300 bytes a triangle: Draco takes it at once.
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
  /// Returns how many bytes it appends.
  [[nodiscard]] std::uint32_t append_level(const TriangleSurface& surface, const FloatBox& box,
                                           int level, AtomicFile& file) const;

  std::filesystem::path segment_;
  double nm_per_unit_;
  TriangleSurface surface_;  ///< nm
};

}  // namespace mw::io
