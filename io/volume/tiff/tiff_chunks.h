// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The pixels of a stack of TIFF pages as chunks.
#pragma once

#include "io/chunks/chunk.h"
#include "io/volume/tiff/tiff_stack.h"

namespace mw::io {

/// A chunk is a tile of one slice, or some strips.  Blocks that a file leaves out are label 0.
/// Numbers are in the byte order of this machine.
class TiffChunks : public ChunkSource {
 public:
  explicit TiffChunks(std::unique_ptr<TiffStack> stack) : stack_(std::move(stack)) {}

  [[nodiscard]] std::string name() const override { return stack_->name(); }
  [[nodiscard]] std::string name_of(Index3 chunk) const override;
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& box) const override;
  /// A block, unpacked and packed.
  [[nodiscard]] std::uint64_t scratch_bytes() const override { return 2 * stack_->largest_block(); }
  /// A tile, or as many strips as make 64 KiB.
  [[nodiscard]] Index3 chunk_shape() const;

 private:
  std::unique_ptr<TiffStack> stack_;
};

}  // namespace mw::io
