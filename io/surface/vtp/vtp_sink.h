// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a surface as a .vtp file.
#pragma once

#include "io/file/atomic_file.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// PolyData, appended raw as in a .vtu file (vtu_layout.h): Points (Float64), connectivity and
/// offsets (Int64), cell data label_in, label_out (UInt64 or Int64; 0 where a face is on no
/// interface) and side (UInt8, see Side), names of labels as field data (vtu_names.h).
class VtpSink : public SurfaceSink {
 public:
  explicit VtpSink(const std::filesystem::path& path) : file_(path) {}

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override;

 private:
  template <class T, class Value>
  void append_of_runs(Value value);

  AtomicFile file_;
  SurfaceHeader header_;
  bool triangles_begun_ = false;
};

}  // namespace mw::io
