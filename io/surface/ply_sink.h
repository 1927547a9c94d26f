// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces as binary .ply files.
// Format: https://www.loc.gov/preservation/digital/formats/fdd/fdd000501.shtml
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// Writes little-endian.  Vertices have x y z (double), faces have vertex_indices (int).
/// Surfaces of labels have more on their vertices only, as simple readers expect: label (int), and
/// red green blue (uchar).  Interfaces have more on their faces: label_in, label_out (int; 0 where
/// a face is on no interface), side (uchar, see Side), and red green blue of label_in.
/// Colours are written if that of any label is known.  Comments hold names and colours; labels
/// beyond 31 bits get numbers, and a comment says which.
class PlySink : public SurfaceSink {
 public:
  explicit PlySink(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override { file_.commit(); }

 private:
  void append_comments();
  void append_number(Label rank);
  void append_colour(Label rank);

  std::string name_;
  AtomicFile file_;
  SurfaceHeader header_;
  std::optional<LabelNumbers> numbers_;
  std::optional<RunCursor> cursor_;
  bool of_labels_ = false;
  bool colours_ = false;
  std::size_t shell_ = 0;           ///< of the next vertex
  std::uint64_t shell_vertex_ = 0;  ///< its number there
};

}  // namespace mw::io
