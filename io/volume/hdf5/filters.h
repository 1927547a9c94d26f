// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Undoes what the filters of HDF5 did to a chunk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/volume/hdf5/description.h"

namespace mw::io {

/// ERRORS: mw::Error(kInput) naming file, data set and filter unless all are ones that unfilter()
/// knows: deflate, shuffle, Fletcher-32, LZF, Blosc, LZ4 and Zstandard.
void check_filters(const Hdf5Description& description, std::string_view file);

/// What a chunk is to become.
struct Unfiltering {
  std::uint32_t skipped = 0;  ///< bit i: filter i was not applied
  std::size_t bytes = 0;      ///< of the chunk's voxels
  std::string_view name;      ///< what errors call the chunk
};

/// The voxels of a chunk.  REQUIRES: check_filters().
/// Memory: in the order of the chunk's voxels and its stored bytes, whatever those claim.
/// ERRORS: mw::Error(kInput) for damage, wrong checksums and other sizes.  Thread safety: any.
[[nodiscard]] std::vector<std::byte> unfilter(const std::vector<Hdf5Filter>& filters,
                                              std::vector<std::byte> stored,
                                              const Unfiltering& wanted);

/// The most that unfilter() takes in memory for `bytes` of voxels, beside the stored ones and what
/// it returns.
[[nodiscard]] std::uint64_t max_unfilter_scratch(const std::vector<Hdf5Filter>& filters,
                                                 std::size_t bytes);

}  // namespace mw::io
