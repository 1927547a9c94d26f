// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a data set of an HDF5 file as a volume, whose chunks are read and unpacked without the HDF5
// library.
// Format: https://support.hdfgroup.org/documentation/hdf5/latest/_f_m_t3.html
// Format: https://cremi.org/data/ (labels of CREMI)
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "io/chunks/chunk.h"
#include "io/file/source/byte_source.h"
#include "io/volume/hdf5/description.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// The most bytes of a chunk.
inline constexpr std::uint64_t kMaxHdf5ChunkBytes = UINT32_MAX;

/// ERRORS: mw::Error(kInput) naming file, data set and filter unless all are ones that unfilter()
/// knows: deflate, shuffle, Fletcher-32, bzip2, LZF, Blosc, LZ4 and Zstandard.
void check_filters(const Hdf5Description& description, std::string_view file);

/// What a chunk is to become.
struct Unfiltering {
  std::uint32_t skipped = 0;  ///< bit i: filter i was not applied
  std::size_t bytes = 0;      ///< what the chunk's voxels need
  std::string_view name;      ///< what errors call the chunk

  [[nodiscard]] bool skips(std::size_t filter) const {
    return filter < 32 && ((skipped >> filter) & 1U) != 0;
  }
};

/// Returns the voxels of a chunk.  REQUIRES: check_filters() passed.
/// Memory: in the order of the chunk's voxels and its stored bytes, whatever those claim.
/// ERRORS: mw::Error(kInput) for damage, wrong checksums and other sizes.  Thread safety: any.
[[nodiscard]] std::vector<std::byte> unfilter(const std::vector<Hdf5Filter>& filters,
                                              std::vector<std::byte> stored,
                                              const Unfiltering& wanted);

/// Unfilters to a file without a name, piece by piece.  REQUIRES: unfilter_streaming() has a value.
[[nodiscard]] std::shared_ptr<const ByteSource> unfilter_to_file(
    const std::vector<Hdf5Filter>& filters, std::shared_ptr<const ByteSource> stored,
    const Unfiltering& wanted);
/// Returns the most that unfilter_to_file() takes in memory; nothing when a filter needs the whole.
[[nodiscard]] std::optional<std::uint64_t> unfilter_streaming(
    const std::vector<Hdf5Filter>& filters);

/// Returns the most that unfilter() takes in memory for `bytes` of voxels, beside the stored ones
/// and what it returns.
[[nodiscard]] std::uint64_t max_unfilter_scratch(const std::vector<Hdf5Filter>& filters,
                                                 std::size_t bytes);

class Hdf5Chunks : public ChunkSource {
 public:
  /// REQUIRES: check_description() and check_filters() passed.
  /// ERRORS: mw::Error(kInput) when a chunk is larger than HDF5 allows, 4 GiB.
  Hdf5Chunks(std::unique_ptr<ByteSource> source, Hdf5Description description, const Hdf5Axes& axes);

  [[nodiscard]] std::string name() const override { return source_->name(); }
  [[nodiscard]] std::string name_of(Index3 chunk) const override;
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& box,
                                          ChunkPlace place) const override;
  [[nodiscard]] std::uint64_t scratch_bytes() const override;
  [[nodiscard]] std::optional<std::uint64_t> streaming_bytes() const override;

 private:
  [[nodiscard]] std::vector<std::uint64_t> index_in_grid(Index3 chunk) const;
  [[nodiscard]] const Hdf5Chunk* find(const std::vector<std::uint64_t>& index) const;
  [[nodiscard]] bool sticks_out(const std::vector<std::uint64_t>& index) const;

  std::shared_ptr<const ByteSource> source_;
  Hdf5Description description_;
  Hdf5Axes axes_;
  Index3 strides_;  ///< voxels from one to its neighbours within a chunk
  std::size_t chunk_bytes_ = 0;
};

/// Returns the extents of a chunk along x, y and z.
[[nodiscard]] Index3 chunk_extents(const Hdf5Description& description, const Hdf5Axes& axes);

/// Whether the superblock of HDF5 begins at 0 or, behind a block of the user's, at 512, 1024 and so
/// on within the bytes.
[[nodiscard]] bool has_hdf5_magic(std::span<const std::byte> head);

/// Opens the data set that options.dataset names, else the labels by the conventions of CREMI,
/// ilastik and DREAM.3D, else the only array of integers with three or two axes.  Spacing and
/// origin are as those tools write them (see choose_data_set, find_axes, hdf5_space).
/// The HDF5 library sees the file in a child process only; voxels are read without it.
/// ERRORS: mw::Error(kInput) for damage, for what cannot be read here, and when no or several data
/// sets are fit.
[[nodiscard]] std::unique_ptr<LabelVolume> open_hdf5(std::unique_ptr<ByteSource> source,
                                                     const OpenOptions& options);

}  // namespace mw::io
