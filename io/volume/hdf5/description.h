// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// All that must be known of an HDF5 data set to read it without the HDF5 library.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/file/byte_order.h"
#include "io/volume/label_volume.h"

namespace mw::io {

enum class Hdf5Layout : std::uint8_t {
  kContiguous,  ///< one run of bytes in the file
  kCompact,     ///< bytes among the metadata
  kChunked,
};

/// A step of the pipeline that packed the chunks, by its registered number.
struct Hdf5Filter {
  std::uint32_t id = 0;
  std::vector<std::uint32_t> parameters;
};

/// Where a chunk is.
struct Hdf5Chunk {
  std::uint64_t number = 0;   ///< in the grid of chunks, the last axis of the data set fastest
  std::uint64_t offset = 0;   ///< in the file
  std::uint32_t bytes = 0;    ///< as stored
  std::uint32_t skipped = 0;  ///< bit i: filter i was not applied to this one
};

/// Axes are the data set's, slowest first.
struct Hdf5Description {
  std::string path;  ///< "/volumes/labels/neuron_ids"
  std::vector<std::uint64_t> shape;
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
  Hdf5Layout layout = Hdf5Layout::kContiguous;
  std::uint64_t offset = 0;  ///< kContiguous
  std::string bytes;         ///< kCompact
  /// kChunked, the rest too.
  std::vector<std::uint64_t> chunk_shape;
  std::vector<Hdf5Filter> filters;  ///< in the order in which they packed
  bool edges_unfiltered = false;    ///< chunks that stick out of the array are not packed
  std::string fill;                 ///< the bytes of one voxel
  std::vector<Hdf5Chunk> chunks;    ///< those that the file has, by number
  /// What tells where the volume lies, as far as the file has it: "resolution", "offset",
  /// "element_size_um" of the data set; "DIMENSIONS", "SPACING", "ORIGIN" of DREAM.3D's geometry.
  std::map<std::string, std::vector<double>> numbers;
  std::string axistags;  ///< ilastik's JSON
};

/// Chunks that a data set may have: 24 bytes each are kept.
inline constexpr std::uint64_t kMaxHdf5Chunks = std::uint64_t{1} << 22U;
/// The most that pack() makes beside 24 bytes a chunk.
inline constexpr std::size_t kMaxPackedDescription = std::size_t{1} << 20U;

[[nodiscard]] std::string pack(const Hdf5Description& description);

/// ENSURES: memory in the order of `bytes`.  Empty when they are no description; the numbers in it
/// are not checked.
[[nodiscard]] std::optional<Hdf5Description> unpack_description(const std::string& bytes);

}  // namespace mw::io
