// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtu file.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/ten_node_writer.h"
#include "io/mesh/vtu/vtu_layout.h"

namespace mw::io {

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
