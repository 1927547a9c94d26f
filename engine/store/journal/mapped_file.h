// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A work file on disk, read and written through mappings.
#pragma once

#include <atomic>
#include <boost/interprocess/file_mapping.hpp>
#include <filesystem>

#include "engine/store/journal/work_file.h"

namespace mw::engine {

/// Mapped pages count as memory of the process, so nothing stays mapped: write() maps at most
/// kMappedAtOnce at a time, read() maps the bytes it was asked for while they are used.  Space is
/// reserved before it is written, since writing to a hole in a mapped file on a full disk raises
/// SIGBUS.
class MappedFile : public WorkFile {
 public:
  static constexpr std::uint64_t kMappedAtOnce = 1 << 20;

  /// Opens the file, or makes it, and syncs its folder.
  /// ERRORS: those of io::fail_output.
  explicit MappedFile(const std::filesystem::path& path);

  [[nodiscard]] std::uint64_t size() const override { return size_; }
  void resize(std::uint64_t size) override;
  void write(std::uint64_t offset, std::span<const std::byte> bytes) override;
  void read(std::uint64_t offset, std::uint64_t size, const UseBytes& use) const override;
  void prefetch(std::uint64_t offset, std::uint64_t size) const override;
  void sync() override;

 private:
  [[nodiscard]] int handle() const { return mapping_.get_mapping_handle().handle; }

  std::string path_;
  boost::interprocess::file_mapping mapping_;
  std::atomic<std::uint64_t> size_ = 0;
};

}  // namespace mw::engine
