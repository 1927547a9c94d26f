// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The chunks of an HDF5 data set, read without the HDF5 library.
#pragma once

#include <memory>

#include "io/chunks/chunk.h"
#include "io/file/byte_source.h"
#include "io/volume/hdf5/axes.h"
#include "io/volume/hdf5/description.h"

namespace mw::io {

class Hdf5Chunks : public ChunkSource {
 public:
  /// REQUIRES: check_description() and check_filters() passed.
  /// ERRORS: mw::Error(kInput) when a chunk is larger than HDF5 allows, 4 GiB.
  Hdf5Chunks(std::unique_ptr<ByteSource> source, Hdf5Description description, const Hdf5Axes& axes);

  [[nodiscard]] std::string name() const override { return source_->name(); }
  [[nodiscard]] std::string name_of(Index3 chunk) const override;
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& box) const override;
  [[nodiscard]] std::uint64_t scratch_bytes() const override;

 private:
  [[nodiscard]] std::vector<std::uint64_t> index_in_grid(Index3 chunk) const;
  [[nodiscard]] const Hdf5Chunk* find(const std::vector<std::uint64_t>& index) const;
  [[nodiscard]] bool sticks_out(const std::vector<std::uint64_t>& index) const;

  std::unique_ptr<ByteSource> source_;
  Hdf5Description description_;
  Hdf5Axes axes_;
  Index3 strides_;  ///< voxels from one to its neighbours within a chunk
  std::size_t chunk_bytes_ = 0;
};

/// Extents of a chunk along x, y and z.
[[nodiscard]] Index3 chunk_extents(const Hdf5Description& description, const Hdf5Axes& axes);

}  // namespace mw::io
