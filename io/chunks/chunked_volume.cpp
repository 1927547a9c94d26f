// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads regions of a volume from its chunks.
#include "io/chunks/chunked_volume.h"

#include <algorithm>
#include <bit>

#include "io/file/errors.h"
#include "io/file/source/inflated_source.h"
#include "kernels/core/assert.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

/// Whether the bytes hold every voxel that the strides lead to.
bool holds(const Chunk& chunk, Index3 shape, VoxelType type) {
  const std::uint64_t voxels = chunk.size() / static_cast<std::uint64_t>(byte_size(type));
  if (chunk.strides.x < 0 || chunk.strides.y < 0 || chunk.strides.z < 0) return false;
  const auto last =
      static_cast<std::size_t>((shape.x - 1) * chunk.strides.x + (shape.y - 1) * chunk.strides.y +
                               (shape.z - 1) * chunk.strides.z);
  return chunk.first + last < voxels;
}

/// Chunks of up to this many bytes are held in memory, however small the cache is.
constexpr std::uint64_t kMinFileBytes = 1 << 20;

ChunkPlace place_of(std::uint64_t chunk, std::uint64_t cache) {
  return chunk > std::max(cache / 8, kMinFileBytes) ? ChunkPlace::kFile : ChunkPlace::kMemory;
}

/// Gives the voxels of a part the fill value.
void fill_in(RawLabel fill, const Box3& part, const ReadBox& to) {
  for (Index3 v = part.lo; v.z < part.hi.z; ++v.z) {
    for (v.y = part.lo.y; v.y < part.hi.y; ++v.y) {
      std::fill_n(to.labels.data() + to.box.offset({part.lo.x, v.y, v.z}), part.shape().x, fill);
    }
  }
}

class Turn {
 public:
  explicit Turn(std::counting_semaphore<>& turns) : turns_(turns) { turns_.acquire(); }
  ~Turn() { turns_.release(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  std::counting_semaphore<>& turns_;
};

}  // namespace

ChunkedVolume::ChunkedVolume(VolumeInfo info, VoxelCoding coding, const ChunkFill& fill,
                             std::unique_ptr<ChunkSource> source, std::uint64_t cache_bytes)
    : info_(std::move(info)),
      coding_(coding),
      fill_(fill),
      source_(std::move(source)),
      cache_bytes_(cache_bytes),
      place_(place_of(chunk_bytes(), cache_bytes)),
      cache_(place_ == ChunkPlace::kFile ? room_to_inflate() : cache_bytes),
      unpacking_(static_cast<std::ptrdiff_t>(unpacked_at_once())) {
  MW_ASSERT(info_.chunk.x > 0 && info_.chunk.y > 0 && info_.chunk.z > 0);
}

Box3 ChunkedVolume::box_of(Index3 chunk) const {
  const Index3 c = info_.chunk;
  const Index3 lo{chunk.x * c.x, chunk.y * c.y, chunk.z * c.z};
  return intersection({lo, lo + c}, {{0, 0, 0}, info_.shape});
}

/// Returns the bytes of the voxels of a whole chunk.
std::uint64_t ChunkedVolume::chunk_bytes() const {
  return static_cast<std::uint64_t>(info_.chunk.product()) *
         static_cast<std::uint64_t>(byte_size(coding_.type));
}

/// Returns the memory that a chunk takes while it is unpacked, with its voxels if they are held.
std::uint64_t ChunkedVolume::unpacking_bytes() const {
  if (place_ == ChunkPlace::kFile) {
    if (const auto streaming = source_->streaming_bytes()) return *streaming;
  }
  return chunk_bytes() + source_->scratch_bytes();
}

/// Returns how many chunks together take no more than the cache may; at least one.
std::uint64_t ChunkedVolume::unpacked_at_once() const {
  constexpr std::uint64_t kMost = 1024;
  return std::clamp<std::uint64_t>(cache_bytes_ / unpacking_bytes(), 1, kMost);
}

std::optional<Chunk> ChunkedVolume::unpacked(Index3 chunk, const Box3& box) const {
  const Turn turn(unpacking_);
  std::optional<Chunk> loaded = source_->load(chunk, box, place_);
  if (!loaded) return loaded;
  if (!holds(*loaded, box.shape(), coding_.type)) {
    fail_input(source_->name_of(chunk), {}, "the chunk is too short for its voxels",
               "get a whole copy of the store");
  }
  if (place_ == ChunkPlace::kFile && !loaded->file) {
    loaded->file = written_to_file(loaded->bytes, source_->name_of(chunk));
    loaded->bytes = {};
  }
  return loaded;
}

ChunkCache::Loaded ChunkedVolume::load(Index3 chunk) const {
  const Box3 grid = cells_of({{0, 0, 0}, info_.shape}, info_.chunk);
  return cache_.get(static_cast<std::uint64_t>(grid.offset(chunk)),
                    [&] { return unpacked(chunk, box_of(chunk)); });
}

void ChunkedVolume::read_numbers(const Box3& box, std::span<double> out) const {
  VoxelCoding coding = coding_;
  coding.as_numbers = true;
  std::vector<RawLabel> bits(out.size());
  read_as(coding, std::bit_cast<RawLabel>(fill_.number), {box, bits});
  numbers_of_bits(bits, out);
}

void ChunkedVolume::read_as(const VoxelCoding& coding, std::optional<RawLabel> fill,
                            const ReadBox& to) const {
  MW_ASSERT(to.labels.size() == static_cast<std::size_t>(to.box.voxels()));
  if (to.labels.empty()) return;
  for_each_index(cells_of(to.box, info_.chunk), [&](Index3 number) {
    const Box3 held = box_of(number);
    const Box3 part = intersection(held, to.box);
    const ChunkCache::Loaded chunk = load(number);
    if (chunk) {
      const StoredArray array{.first = chunk->first,
                              .strides = chunk->strides,
                              .coding = coding,
                              .box = held,
                              .name = source_->name()};
      return chunk->file ? read_array(*chunk->file, array, part, to)
                         : copy(*chunk, array, part, to);
    }
    if (!fill) {
      fail_input(source_->name_of(number), "fill value",
                 text("the chunk is not there, and ", fill_.number, " fills it, which is no label"),
                 "labels are whole numbers: is this an image, or probabilities?");
    }
    fill_in(*fill, part, to);
  });
}

void ChunkedVolume::copy(const Chunk& chunk, const StoredArray& array, const Box3& part,
                         const ReadBox& to) const {
  const auto size = static_cast<std::size_t>(byte_size(array.coding.type));
  const auto length = static_cast<std::size_t>(part.shape().x);
  for (Index3 v = part.lo; v.z < part.hi.z; ++v.z) {
    for (v.y = part.lo.y; v.y < part.hi.y; ++v.y) {
      const Index3 inside = Index3{part.lo.x, v.y, v.z} - array.box.lo;
      const auto at = static_cast<std::size_t>(
          inside.x * array.strides.x + inside.y * array.strides.y + inside.z * array.strides.z);
      const std::byte* bytes = chunk.bytes.data() + (array.first + at) * size;
      const auto step = static_cast<std::size_t>(array.strides.x);
      const std::size_t good =
          decode_voxels(bytes, length, step, array.coding,
                        to.labels.data() + to.box.offset({part.lo.x, v.y, v.z}), 1);
      if (good == length) continue;
      fail_voxel(array.name, {part.lo.x + static_cast<std::int64_t>(good), v.y, v.z},
                 bytes + good * step * size, array.coding);
    }
  }
}

std::uint64_t ChunkedVolume::buffer_bytes(int threads) const {
  const auto readers = static_cast<std::uint64_t>(threads);
  const std::uint64_t at_once = std::min(readers, unpacked_at_once());
  if (place_ == ChunkPlace::kFile) return at_once * unpacking_bytes();
  return cache_bytes_ + readers * chunk_bytes() + at_once * source_->scratch_bytes();
}

void ChunkedVolume::drop_buffers() const {
  if (place_ == ChunkPlace::kMemory) cache_.clear();  // files take no memory
}

}  // namespace mw::io
