// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A folder of neuroglancer's precomputed meshes, and what a viewer may sort its segments by,
// measured while a surface is written.
// Format: https://github.com/google/neuroglancer/blob/master/src/datasource/precomputed/meshes.md
// Format:
// https://github.com/google/neuroglancer/blob/master/src/datasource/precomputed/segment_properties.md
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>

#include "io/file/scratch/scratch_file.h"
#include "io/file/sink/atomic_file.h"
#include "io/surface/precomputed/draco_segments.h"
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

/// Writes FOLDER/ID:0, JSON that names one fragment, and the fragment, FOLDER/ID.mesh, with the
/// number of vertices (u32), their coordinates (3 x f32, nm), the vertices of triangles (3 x u32).
class LegacySink : public SurfaceSink {
 public:
  /// segment is FOLDER/ID.
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

enum class FragmentKind : std::uint8_t {
  kLegacy,  ///< "neuroglancer_legacy_mesh": plain numbers
  kDraco,   ///< "neuroglancer_multilod_draco": levels of detail on an octree
};

/// How a folder is written.
struct MeshFolderOptions {
  FragmentKind kind = FragmentKind::kLegacy;
  bool closed = true;                ///< surfaces are closed, so that they have volumes
  std::size_t most_single = 10'000;  ///< kDraco: more segments than these go into shards
};

/// Writes one segment a label, whose number is the label (a signed one by the same 64 bits
/// unsigned), and as segment properties its name, volume, area and number of neighbours.  The
/// folder can be shown by itself, or lie in that of a segmentation as its "mesh".
/// ERRORS: as SurfaceSink.
class MeshFolder {
 public:
  MeshFolder(const std::filesystem::path& path, MeshFolderOptions options)
      : folder_(path), options_(std::move(options)), draco_(folder_.path()) {}

  /// Says in which unit the coordinates of surfaces are; else they are in nm.
  /// REQUIRES: no sink was asked for; nm_in() knows the unit.
  void use_unit(const std::string& unit);
  /// Returns a sink for the surface of one label, not for interfaces.
  [[nodiscard]] std::unique_ptr<SurfaceSink> sink(RawLabel label);
  /// Writes what describes the whole, and commits.  REQUIRES: all sinks have finished.
  void finish(const LabelNames& names);

 private:
  AtomicFolder folder_;
  MeshFolderOptions options_;
  std::string unit_ = "nm";
  double nm_per_unit_ = 1;  ///< the format counts in nm
  DracoSegments draco_;
  std::vector<RawLabel> segments_;
  std::deque<SegmentFigures> figures_;  ///< of segments_; sinks refer to them
};

}  // namespace mw::io
