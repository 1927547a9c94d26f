// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The slices of a volume, pages of one TIFF file or files of one page each, and their pixels as
// chunks.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "io/chunks/chunk.h"
#include "io/file/source/byte_source.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// libtiff over a ByteSource: it opens nothing itself, prints nothing, and takes no piece of memory
/// that is large against the file.  Thread safety: none, but handles may share a source.
class TiffHandle {
 public:
  /// Opens a file, and stands at its first page.
  /// ERRORS: mw::Error(kInput) naming the file when it is no TIFF file.
  explicit TiffHandle(std::shared_ptr<const ByteSource> source);
  ~TiffHandle();
  TiffHandle(const TiffHandle&) = delete;
  TiffHandle& operator=(const TiffHandle&) = delete;

  /// Goes to the page whose directory begins there.
  /// ERRORS: mw::Error(kInput) naming file and place.
  void go_to(std::uint64_t directory);

  [[nodiscard]] TIFF* get() const { return tiff_; }
  [[nodiscard]] const std::string& file() const { return stream_.source->name(); }
  /// Throws mw::Error(kInput) with what libtiff said last.
  [[noreturn]] void fail(std::string_view field, std::string_view reason) const;

  /// What libtiff reads from, and where it complains.
  struct Stream {
    std::shared_ptr<const ByteSource> source;
    std::uint64_t at = 0;
    std::string complaint;
  };

 private:
  Stream stream_;
  TIFF* tiff_ = nullptr;
};

struct TiffPage {
  std::int64_t width = 0;
  std::int64_t height = 0;
  VoxelType type = VoxelType::kU8;
  /// Pixels are packed in blocks of this size, strips or tiles, from the top left corner on.
  std::int64_t block_width = 0;
  std::int64_t block_height = 0;
  bool tiled = false;
  bool smaller_copy = false;  ///< a thumbnail, a level of a pyramid or a mask: no slice
  /// Pixels are bits, eight in a byte, each row in bytes of its own.  White ones are label 1.
  bool has_bits = false;
  bool zero_is_white = false;  ///< of bits alone

  /// Returns the bytes that a block unpacks to; the last strip of a page is shorter.
  [[nodiscard]] std::uint64_t block_bytes() const;
  /// Returns the bytes of its pixels, once bits have become bytes.
  [[nodiscard]] std::uint64_t block_pixel_bytes() const;
  /// Returns the page in words, such as "5 x 4 pixels of u8".
  [[nodiscard]] std::string words() const;
  [[nodiscard]] bool is_like(const TiffPage& other) const {
    return width == other.width && height == other.height && type == other.type &&
           has_bits == other.has_bits;
  }
};

/// Reads the page where the handle stands.  Errors call it `where`, such as "page 3".
/// ENSURES: extents within kMaxAxisVoxels; blocks that the file can hold, at most 512 MiB.
/// ERRORS: mw::Error(kInput) naming file and page for pixels that are no labels: of several
/// samples, of a type or compression that is not read, or of a depth.
[[nodiscard]] TiffPage read_tiff_page(const TiffHandle& handle, const std::string& where);

/// XResolution and YResolution of a page.
struct TiffResolution {
  std::array<double, 2> pixels{};  ///< in a unit; 0 where the page does not say it
  bool per_centimetre = false;     ///< ResolutionUnit
};

/// Thread safety: const members may be called from many threads.
class TiffStack {
 public:
  /// Takes the pages of one file, in its order, without smaller copies.
  /// Cost: each directory is read once; 8 bytes a page are kept.
  /// ERRORS: mw::Error(kInput) naming file and page for one that cannot be read, is no labels, or
  /// is not like the first.
  explicit TiffStack(std::shared_ptr<const ByteSource> file);
  /// Takes the only pages of these files, in this order.  REQUIRES: there is at least one file.
  /// ERRORS: those of the other constructor, and kInput for a file of several pages.
  explicit TiffStack(std::vector<std::filesystem::path> files);

  [[nodiscard]] std::int64_t slices() const { return static_cast<std::int64_t>(positions_.size()); }
  /// Returns the first page, which all others are like, except for their blocks.
  [[nodiscard]] const TiffPage& first() const { return first_; }
  /// Returns the largest number of bytes of the pixels of a block of any slice.
  [[nodiscard]] std::uint64_t largest_block() const { return largest_block_; }
  /// Returns the ImageDescription of the first slice; empty when it has none.
  [[nodiscard]] const std::string& description() const { return description_; }
  [[nodiscard]] const TiffResolution& resolution() const { return resolution_; }  ///< first slice
  /// Returns the file, or the folder of the files.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns "FILE: slice 3", or the file of the slice.
  [[nodiscard]] std::string name_of(std::int64_t slice) const;

  /// Lends a handle that stands at the slice to one thread, until the lease ends.
  class Lease {
   public:
    Lease(const TiffStack& stack, std::int64_t slice);
    ~Lease();
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    [[nodiscard]] TiffHandle& operator*() const { return *handle_; }

   private:
    const TiffStack& stack_;
    std::int64_t slice_;
    std::unique_ptr<TiffHandle> handle_;
  };

 private:
  /// A handle that nobody has, and the slice where it stands.
  struct Idle {
    std::int64_t slice;
    std::unique_ptr<TiffHandle> handle;
  };

  void add_page(const TiffHandle& handle, const std::string& position);
  [[nodiscard]] std::unique_ptr<TiffHandle> take(std::int64_t slice) const;
  void give_back(std::int64_t slice, std::unique_ptr<TiffHandle> handle) const;

  std::shared_ptr<const ByteSource> file_;    ///< empty for many files
  std::vector<std::filesystem::path> files_;  ///< empty for one
  std::vector<std::uint64_t> positions_;      ///< where each slice's directory is in its file
  std::string name_;
  TiffPage first_;
  std::uint64_t largest_block_ = 0;
  std::string description_;
  TiffResolution resolution_;
  mutable std::mutex mutex_;
  mutable std::vector<Idle> idle_;  ///< the one used last at the end
};

/// Reads chunks, each a tile of one slice or some strips.  Blocks that a file leaves out are label
/// 0.  Numbers are in the byte order of this machine.
class TiffChunks : public ChunkSource {
 public:
  explicit TiffChunks(std::unique_ptr<TiffStack> stack) : stack_(std::move(stack)) {}

  [[nodiscard]] std::string name() const override { return stack_->name(); }
  [[nodiscard]] std::string name_of(Index3 chunk) const override;
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& box,
                                          ChunkPlace place) const override;
  /// A block takes memory both packed and unpacked.
  [[nodiscard]] std::uint64_t scratch_bytes() const override { return 2 * stack_->largest_block(); }
  /// Returns the extents of a tile, or of as many strips as make 64 KiB.
  [[nodiscard]] Index3 chunk_shape() const;

 private:
  std::unique_ptr<TiffStack> stack_;
};

}  // namespace mw::io
