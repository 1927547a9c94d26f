// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtu file.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "io/file/atomic_file.h"
#include "io/mesh/mesh_sink.h"
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
class VtuSink : public MeshSink {
 public:
  explicit VtuSink(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 3 << 20; }

 private:
  std::string name_;
  AtomicFile file_;
  MeshHeader header_;
  std::vector<FileRegion> regions_;
  std::uint64_t vertices_ = 0;
  std::uint64_t tets_ = 0;
};

}  // namespace mw::io
