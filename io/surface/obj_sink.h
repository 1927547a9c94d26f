// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces as .obj files.
// Format: https://www.loc.gov/preservation/digital/formats/fdd/fdd000507.shtml
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/file/sink/atomic_file.h"
#include "io/surface/surface_names.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// Writes text: comments with shift_comment(), space_comment() and names and colours of labels
/// (medit_comment()), then all vertices with the fewest digits that give back the same number, then
/// triangles.  The surface of a label is an object `o` and a group `g`, an interface a group, under
/// the words of SurfaceNames.
class ObjSink : public SurfaceSink {
 public:
  explicit ObjSink(const std::filesystem::path& path) : file_(path) {}

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override { file_.commit(); }

 private:
  void begin_run();

  AtomicFile file_;
  SurfaceHeader header_;
  std::optional<SurfaceNames> names_;
  std::optional<RunCursor> cursor_;
  const SurfaceShell* shell_ = nullptr;  ///< of the last triangle
};

}  // namespace mw::io
