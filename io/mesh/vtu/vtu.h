// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tetrahedral .vtu files, in and out.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/file/source/byte_source.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/mesh_data.h"
#include "io/mesh/vtu/vtu_layout.h"

namespace mw::io {

/// Pieces are put one after the other.  Of tets with ten nodes the corners are read; the middles of
/// edges go.  The label is the cell array `label`, else `Label`,
/// `labels`, `material` or `medit:ref`, else the only integer cell array.
/// ERRORS: mw::Error(kInput) with file and place when truncated or corrupt, for cells that are not
/// tetrahedra, without label, or when a row does not exist.
[[nodiscard]] MeshData read_vtu(const ByteSource& source);

/// A mesh that is part of another.
struct VtuPiece {
  MeshData mesh;
  std::vector<std::uint64_t> ids;  ///< of its vertices in the whole: PointData/GlobalNodeIds
};

/// ERRORS: as read_vtu(); without ids, or with tets of ten nodes.
[[nodiscard]] VtuPiece read_vtu_piece(const ByteSource& source);

/// One buffered place of a file that is filled from its beginning to its end.
class FileRegion {
 public:
  FileRegion(AtomicFile& file, std::uint64_t start) : file_(&file), next_(start) {}
  template <class T>
  void add(T value);
  void flush();

 private:
  AtomicFile* file_;
  std::uint64_t next_;
  std::vector<std::byte> buffer_;
};

/// Cost: five buffers of 256 KiB; every number is copied once.
class VtuSink : public TenNodeSink {
 public:
  explicit VtuSink(const std::filesystem::path& path, Element element = Element::kTet4)
      : name_(path.string()), file_(path), element_(element) {}

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void write_ten_nodes(std::span<const TenRows> tets, std::span<const RawLabel> labels) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 3 << 20; }

 private:
  void write_cell(std::span<const std::uint64_t> rows, RawLabel label);

  std::string name_;
  AtomicFile file_;
  Element element_;
  MeshHeader header_;
  std::vector<FileRegion> regions_;
  std::uint64_t vertices_ = 0;
  std::uint64_t tets_ = 0;
  std::uint64_t corners_ = 0;  ///< rows of all tets so far
};

}  // namespace mw::io
