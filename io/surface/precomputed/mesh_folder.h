// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A folder of neuroglancer's precomputed meshes.
#pragma once

#include "io/file/sink/atomic_file.h"
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

enum class FragmentKind : std::uint8_t {
  kLegacy,  ///< "neuroglancer_legacy_mesh": plain numbers
  kDraco,   ///< "neuroglancer_multilod_draco", each level of detail in one piece
};

/// How a folder is written.
struct MeshFolderOptions {
  FragmentKind kind = FragmentKind::kLegacy;
  double nm_per_unit = 1;  ///< of the mesh's coordinates; the format counts in nm
};

/// One segment a label, called by the label (a signed one by the same 64 bits unsigned), and names
/// of labels as segment properties.  The folder can be shown by itself, or lie in that of a
/// segmentation as its "mesh".
/// ERRORS: as SurfaceSink.
class MeshFolder {
 public:
  MeshFolder(const std::filesystem::path& path, MeshFolderOptions options)
      : folder_(path), options_(options) {}

  /// For the surface of one label, not of interfaces.
  [[nodiscard]] std::unique_ptr<SurfaceSink> sink(RawLabel label);
  /// Writes what describes the whole, and commits.  REQUIRES: all sinks have finished.
  void finish(const LabelNames& names);

 private:
  AtomicFolder folder_;
  MeshFolderOptions options_;
  std::vector<RawLabel> segments_;
};

}  // namespace mw::io
