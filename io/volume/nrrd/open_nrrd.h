// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text header of an NRRD volume, inline or detached.
// Format: https://teem.sourceforge.net/nrrd/format.html
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_order.h"
#include "io/file/source/byte_source.h"
#include "io/names/header_names.h"
#include "io/volume/checks.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// The most bytes of a header that is looked for.
inline constexpr std::size_t kMaxNrrdHeaderBytes = 1 << 20;

enum class NrrdEncoding { kRaw, kGzip, kText };

struct NrrdHeader {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
  Index3 shape;
  NrrdEncoding encoding = NrrdEncoding::kRaw;
  std::int64_t byte_skip = 0;  ///< -1: the voxels are the last bytes of the file
  /// Files with equal parts of the voxels, in their order; none: the voxels follow the header.
  std::vector<std::string> data_files;
  std::size_t bytes = 0;  ///< length of the header with its blank line
  /// The place, by `space directions`, `space origin` and `space`, else by `spacings` and `axis
  /// mins`.  `space origin` is the centre of the first sample whatever the centering (format
  /// definition); `axis mins` are its corner, or its centre along axes whose `centers` is "node".
  FileSpace space;
  bool units_differ = false;  ///< axes of space have several units
  /// How many numbers each voxel has: more than one where segments overlap, or where there are
  /// none.  With layers_first the numbers of a voxel follow each other, else those of a layer do.
  std::int64_t layers = 1;
  bool layers_first = true;
  std::vector<Segment> segments;   ///< those of a .seg.nrrd
  bool has_segment_names = false;  ///< there are segments, be it without values
};

[[nodiscard]] bool has_nrrd_magic(std::span<const std::byte> head);

/// Whether a value of `data file` is that of a list, which ends the header.
[[nodiscard]] bool is_nrrd_list(std::string_view value);

/// Returns the names of data files: that of one file; those of a list, a name a line; or those of
/// "PATTERN MIN MAX STEP", where PATTERN has one %d.  "LIST", or the three numbers, may be followed
/// by the number of axes that a file has, which else is one less than the volume's.
/// REQUIRES: sizes are those of all axes, not checked.
/// ERRORS: mw::Error(kInput) naming file and field, also where there are fewer or more files than
/// the sizes need.
[[nodiscard]] std::vector<std::string> nrrd_data_files(const std::string& value,
                                                       std::string_view list,
                                                       const std::vector<std::int64_t>& sizes,
                                                       std::string_view file);

/// REQUIRES: head is the beginning of the file, kMaxNrrdHeaderBytes or as much as there is.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] NrrdHeader parse_nrrd_header(std::string_view head, std::string_view file);

/// Bytes in which the voxels lie one behind the other.
struct NrrdVoxels {
  std::unique_ptr<ByteSource> source;
  std::uint64_t offset = 0;
};

/// Finds the voxels of a file, whose text or several packed files are unpacked first, into an
/// unlinked temporary file.
/// REQUIRES: bytes is those of all voxels and layers.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] NrrdVoxels find_nrrd_voxels(std::unique_ptr<ByteSource> source,
                                          const NrrdHeader& header, std::uint64_t bytes,
                                          bool is_trusted);

/// Opens an NRRD file.  Detached data files are looked for relative to the folder of source.name().
/// Bytes behind the voxels are ignored.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] std::unique_ptr<LabelVolume> open_nrrd(std::unique_ptr<ByteSource> source,
                                                     const OpenOptions& options);

}  // namespace mw::io
