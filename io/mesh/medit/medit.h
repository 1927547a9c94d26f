// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes ASCII MEDIT .mesh files.
// Format: https://hal.inria.fr/inria-00069921
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/file/scratch/scratch_file.h"
#include "io/file/sink/atomic_file.h"
#include "io/file/source/byte_source.h"
#include "io/mesh/mesh_data.h"
#include "io/mesh/mesh_sink.h"
#include "io/names/label_names.h"

namespace mw::io {

/// Reads Vertices and Tetrahedra and skips every other section; labels are signed when one of them
/// is negative.
/// ERRORS: mw::Error(kInput) with file and line when truncated, not of dimension 3, without
/// vertices or tetrahedra, or when a row does not exist.
[[nodiscard]] MeshData read_medit(const ByteSource& source);

/// Coordinates are printed with the fewest digits that give back the same double.  The reference of
/// a tet is its label, and that of a vertex 0; rows count from 1.  Names of labels are comments
/// (medit_comment()).  The lines of the tets, which come last in the file, wait in a temporary file
/// in the same folder.
class MeditSink : public MeshSink {
 public:
  explicit MeditSink(const std::filesystem::path& path)
      : name_(path.string()), file_(path), tet_lines_(path.parent_path()) {}

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 2 << 20; }

 private:
  std::string name_;
  AtomicFile file_;
  ScratchFile tet_lines_;
  MeshHeader header_;
  std::uint64_t count_at_ = 0;  ///< where the number of vertices goes
  std::uint64_t vertices_ = 0;
  std::uint64_t tets_ = 0;
};

/// Returns the line `# label 7 "name" 255 0 0 255`, with its end; without the four numbers where
/// the colour is unknown.  In the name `"` and `\` have a `\` in front.
[[nodiscard]] std::string medit_comment(const LabelName& row, bool is_signed);

/// Reads what medit_comment() wrote, from behind the '#' to the end of the line; returns nothing
/// for any other comment.
[[nodiscard]] std::optional<LabelName> parse_medit_comment(std::string_view comment);

}  // namespace mw::io
