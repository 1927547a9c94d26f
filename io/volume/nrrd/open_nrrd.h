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

struct NrrdHeader {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
  Index3 shape;
  bool gzip = false;
  std::int64_t byte_skip = 0;  ///< -1: the voxels are the last bytes of the file
  std::string data_file;       ///< empty: the voxels follow the header
  std::size_t bytes = 0;       ///< length of the header with its blank line
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

/// REQUIRES: head is the beginning of the file, kMaxNrrdHeaderBytes or as much as there is.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] NrrdHeader parse_nrrd_header(std::string_view head, std::string_view file);

/// Opens an NRRD file.  A detached `data file` is looked for relative to the folder of
/// source.name().  Bytes behind the voxels are ignored.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] std::unique_ptr<LabelVolume> open_nrrd(std::unique_ptr<ByteSource> source,
                                                     const OpenOptions& options);

}  // namespace mw::io
