// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a surface as a Wavefront .obj file, with its colours beside.
#pragma once

#include "io/file/atomic_file.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// OUT.obj and, where colours of labels are known, OUT.mtl.  A surface of a label is a group of its
/// name (`g liver`), an interface one of both (`g liver|kidney`); the material is that of the label
/// inside.  In names '_' stands for what is blank.
class ObjSink : public SurfaceSink {
 public:
  explicit ObjSink(const std::filesystem::path& path);

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override;

 private:
  void append_group();
  void append_materials(AtomicFile& file);

  std::filesystem::path materials_path_;
  AtomicFile file_;
  SurfaceHeader header_;
  std::optional<RunCursor> cursor_;
  bool colours_ = false;
  std::string group_;
};

}  // namespace mw::io
