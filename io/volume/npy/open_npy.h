// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a NumPy .npy file, versions 1 to 3 of its header, as a volume.
// Format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/file/byte_order.h"
#include "io/file/sink/atomic_file.h"
#include "io/file/source/byte_source.h"
#include "io/volume/label_volume.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// What bytes 0 to 11 (magic, version, length) say about the dictionary that follows.
struct NpyPrefix {
  std::size_t dict_offset = 0;
  std::size_t dict_length = 0;
};

/// The dictionary.  Array axes are [z, y, x] (or [y, x], one slice), or [component, z, y, x].
struct NpyHeader {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
  bool fortran_order = false;
  Index3 shape;
  std::int64_t components = 1;  ///< numbers of each voxel, along the first of four axes
};

[[nodiscard]] bool has_npy_magic(std::span<const std::byte> bytes);

/// Read prefix and dictionary.  ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] NpyPrefix parse_npy_prefix(std::span<const std::byte> bytes, std::string_view file);
[[nodiscard]] NpyHeader parse_npy_dict(std::string_view dict, VoxelValues values,
                                       std::string_view file);

/// The length of a header that is written here, and what it begins with.  numpy pads the header of
/// such an array to 128 bytes at most, so that this tells whose file it is.
inline constexpr std::size_t kOwnNpyHeaderBytes = 192;
inline constexpr std::string_view kOwnNpyStart{"\x93NUMPY\1\0\xb6\0{'descr': '", 21};

/// Returns a version 1.0 header of kOwnNpyHeaderBytes for a C-order array [z, y, x].
[[nodiscard]] std::string format_npy_header(const VolumeInfo& info);

/// Opens an array with axes [z, y, x], in C or Fortran order.  The format knows neither spacing nor
/// origin, which are 1 and 0.  Bytes behind the voxels are ignored, as numpy does.  An array of
/// four axes is a NumberStack, which options.values must ask for.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] std::unique_ptr<LabelVolume> open_npy(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

/// Writes a .npy file in C order [z, y, x], little-endian, in the type of the info.  Nothing
/// appears under the path before finish() returns. ERRORS: mw::Error(kUsage) for a label the type
/// cannot hold, a number of voxels that is not the shape's, or a path that cannot be written;
/// kResource on a full disk.
class NpyWriter {
 public:
  NpyWriter(const std::filesystem::path& path, const VolumeInfo& info);

  /// Appends whole or partial z-slabs, in order.
  void write(std::span<const RawLabel> labels);
  void finish();

 private:
  AtomicFile file_;
  std::string name_;
  VoxelType type_;
  std::uint64_t expected_;
  std::uint64_t written_ = 0;
};

}  // namespace mw::io
