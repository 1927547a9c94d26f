// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a viewer may sort segments by, measured while a surface is written.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "io/file/scratch/scratch_file.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// The smallest box along the axes that holds a segment.
struct SegmentBox {
  Position low{};
  Position high{};

  void add(const Position& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
};

/// Figures of the surface of one label, in the mesh's unit.
struct SegmentFigures {
  double area = 0;
  std::optional<double> volume;  ///< where the surface is closed
  std::uint32_t neighbours = 0;  ///< labels that it touches
  std::optional<SegmentBox> box;
};

/// Passes a surface on to another sink, and measures it.
/// REQUIRES: figures outlives it.  Memory: 8 MiB; vertices wait in a temporary file in folder.
class MeasuredSink : public SurfaceSink {
 public:
  MeasuredSink(std::unique_ptr<SurfaceSink> sink, const std::filesystem::path& folder, bool closed,
               SegmentFigures& figures)
      : sink_(std::move(sink)), vertices_(folder), closed_(closed), figures_(figures) {}

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override;

 private:
  std::unique_ptr<SurfaceSink> sink_;
  PagedFile<Position> vertices_;
  bool closed_;
  Position first_{};    ///< the volume is the sum of the tets from triangles to here
  double volume6_ = 0;  ///< six times the volume
  SegmentFigures& figures_;
};

}  // namespace mw::io
