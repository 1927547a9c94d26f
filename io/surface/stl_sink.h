// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces as binary .stl files.
// Format: https://www.loc.gov/preservation/digital/formats/fdd/fdd000505.shtml
#pragma once

#include <filesystem>
#include <string>

#include "io/file/scratch/scratch_file.h"
#include "io/file/sink/atomic_file.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// Writes 80 bytes of text with shift_comment(), space_comment() and the names of the labels, the
/// number of triangles in 32 bits, then for each its normal and its corners as 32-bit floats and
/// two bytes of 0.  The format has neither labels nor vertices; readers join the corners that have
/// the same coordinates.
/// Memory: 10 MiB; vertices wait in a temporary file.
class StlSink : public SurfaceSink {
 public:
  explicit StlSink(const std::filesystem::path& path);

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override { file_.commit(); }

 private:
  std::string name_;
  AtomicFile file_;
  PagedFile<Position> vertices_;
};

}  // namespace mw::io
