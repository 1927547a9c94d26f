// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a volume to disk slab by slab, in bounded memory.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "io/file/sink/atomic_file.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// Voxels in file order, x fastest, little-endian, in the type of the info.  Nothing appears under
/// the path before finish() returns.
/// ERRORS: mw::Error(kUsage) for a label the type cannot hold, a number of voxels that is not the
/// shape's, or a path that cannot be written; kResource on a full disk.
class VolumeWriter {
 public:
  /// Appends whole or partial z-slabs, in order.
  void write(std::span<const RawLabel> labels);
  void finish();

 protected:
  VolumeWriter(const std::filesystem::path& path, const VolumeInfo& info, std::string_view header);

 private:
  AtomicFile file_;
  std::string name_;
  VoxelType type_;
  std::uint64_t expected_;
  std::uint64_t written_ = 0;
};

/// .npy, C order [z, y, x].
class NpyWriter : public VolumeWriter {
 public:
  NpyWriter(const std::filesystem::path& path, const VolumeInfo& info);
};

/// The voxels alone.
class RawWriter : public VolumeWriter {
 public:
  RawWriter(const std::filesystem::path& path, const VolumeInfo& info);
};

}  // namespace mw::io
