// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// All that must be known about an HDF5 data set to read it without the HDF5 library.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_order.h"
#include "io/file/source/byte_source.h"
#include "io/volume/checks.h"
#include "io/volume/label_volume.h"

namespace mw::io {

enum class Hdf5Layout : std::uint8_t {
  kContiguous,  ///< one run of bytes in the file
  kCompact,     ///< bytes among the metadata
  kChunked,
};

/// A step in which the chunks were packed.
struct Hdf5Filter {
  std::uint32_t id = 0;         ///< its registered number
  std::uint32_t parameter = 0;  ///< the first one, 0 without any; shuffle's is the element's bytes
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
  std::uint64_t offset = 0;  ///< for kContiguous
  std::string bytes;         ///< for kCompact
  /// This and the next four are for kChunked.
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

/// The most chunks that a data set may have, as 24 bytes each are kept.
inline constexpr std::uint64_t kMaxHdf5Chunks = std::uint64_t{1} << 22U;
/// The most that pack() makes beside 24 bytes a chunk.
inline constexpr std::size_t kMaxPackedDescription = std::size_t{1} << 20U;

[[nodiscard]] std::string pack(const Hdf5Description& description);

/// Returns what pack() packed, or nothing when the bytes are no description.  Numbers in it are not
/// checked.  Memory: in the order of `bytes`.
[[nodiscard]] std::optional<Hdf5Description> unpack_description(const std::string& bytes);

/// The axis of the array for x, y and z; empty: the array has one slice there.
using Hdf5Axes = std::array<std::optional<std::size_t>, 3>;

/// Finds the axes by ilastik's axistags if there are any; else they are [z, y, x], or [y, x] as one
/// slice.  Arrays of more axes lose those of one element, the first ones first; in DREAM.3D, where
/// the components of a voxel are last, the last ones first.
/// ERRORS: mw::Error(kInput) naming `file` and the data set when three do not remain, and for tags
/// that do not fit the array.
[[nodiscard]] Hdf5Axes find_axes(const Hdf5Description& description, std::string_view file);

/// Returns the place by CREMI's `resolution` and `offset` (z, y, x; nm), Fiji's and ilastik's
/// `element_size_um` (z, y, x; um) or the geometry of DREAM.3D (x, y, z); all place the first
/// corner.  Without these, axistags count whose `resolution` is known for x, y and z; they name no
/// unit.  What is not three numbers is not looked at; without any of them voxels have edges of 1.
/// ERRORS: mw::Error(kInput) when a geometry has another shape (x, y, z) than the array, and for
/// tags that do not fit it.
[[nodiscard]] FileSpace hdf5_space(const Hdf5Description& description, const Index3& shape,
                                   std::string_view file);

struct Hdf5Entry {
  std::string path;  ///< from the root, with a slash in front
  std::vector<std::uint64_t> shape;
  std::string type;  ///< "u8", or what it is instead
  bool is_integer = false;
};

/// Returns the data set that has the labels by convention: CREMI's /volumes/labels/neuron_ids, else
/// the only integers below /volumes/labels; ilastik's /exported_data; the only FeatureIds of
/// DREAM.3D; else the only integers with three axes longer than 1, else with two.
/// ERRORS: mw::Error(kInput) naming `file` and the data sets that there are, when none or several
/// are fit.
[[nodiscard]] const std::string& choose_data_set(const std::vector<Hdf5Entry>& entries,
                                                 std::string_view file);

/// Returns the first few as "/a 3 x 4 x 5 u8, /b 7 f64".
[[nodiscard]] std::string list_text(const std::vector<Hdf5Entry>& entries);

/// Describes `data_set`, "/a/b", or the labels in it if it is a group; if it is empty, convention
/// chooses (choose_data_set()).  The library never sees the file in this process, as damage makes
/// it crash.
/// ENSURES: what is described is within the file and fits together, see check_description().
/// Memory: 24 bytes a chunk that the file has; time: some microseconds a chunk of the grid.
/// ERRORS: mw::Error(kInput) for damage, for a data set that is missing, when none or several are
/// fit, and for types and storage that cannot be read; kResource when no process can be started.
[[nodiscard]] Hdf5Description describe_hdf5(const ByteSource& source, const std::string& data_set);

/// ERRORS: mw::Error(kInput) unless chunks have as many axes as the array, lie within the file, are
/// in order and together no longer than it, and runs of bytes have the size that the shape needs.
void check_description(const ByteSource& source, const Hdf5Description& description);

}  // namespace mw::io
