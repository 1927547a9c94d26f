// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces as .vtp files, the polygons of VTK and ParaView.
// Format: https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html
#pragma once

#include <filesystem>
#include <string>

#include "io/file/sink/atomic_file.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// Writes an XML head, '_', then for each array a UInt64 byte count and the numbers, little-endian:
/// points Float64 x 3, connectivity and offsets Int64, then arrays of the triangles: label, which
/// normals point out of, and label_out, which they point into (Int64 or UInt64; 0 where a triangle
/// is on no interface), side (UInt8, see Side), and colour (UInt8 x 3, of label) if that of any
/// label is known.  Fields are the arrays of field_names.h, names being strings, and where they are
/// known SPACE, where 3D Slicer looks for the frame, and SHIFT, which is to be added to points.
class VtpSink : public SurfaceSink {
 public:
  explicit VtpSink(const std::filesystem::path& path) : file_(path) {}

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override;

 private:
  void begin_polygons();
  template <class Number>
  void append_by_run(Number (*number)(const SurfaceHeader& header, const SurfaceRun& run));

  AtomicFile file_;
  SurfaceHeader header_;
  bool has_polygons_ = false;  ///< whether the count of connectivity's bytes is written
};

}  // namespace mw::io
