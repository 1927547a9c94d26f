// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bounds on memory, by measured factors.
#include "engine/window/window_memory.h"

#include <algorithm>

#include "kernels/distance/label_reach.h"
#include "kernels/size/size_field.h"
#include "kernels/source/source_plane.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kKibibyte = 1 << 10;
constexpr std::uint64_t kMebibyte = 1 << 20;

// The most that any visit took, from decoding to encoding, was 6.2 times the bytes of the content
// it began with (a checkerboard whose only block has eight parts); most take 4.
constexpr double kBytesPerContentByte = 6.5;
// Which part of the most that any labels give windows of usual ones take.  Dense EM takes 0.28;
// with limits on edges, which keep large cells away, grains took 0.45.
constexpr double kUsualShare = 0.3;
constexpr double kUsualShareSized = 0.5;
// For labels around blocks that are made from voxels, before and after coarsening.
constexpr std::uint64_t kBytesPerStartVoxel = 2 * sizeof(Label);
constexpr std::int64_t kStartLabelHalo = 6;
// For labels that the distance bound reads.  Content reaches out of its window by up to a block,
// but not on all sides at once: the most was 0.5 of the window's edge along an axis, and a voxel at
// each end.
constexpr std::uint64_t kBytesPerLabelVoxel = sizeof(Label);
// For a source surface: where its planes are, planes of up to three faces, bricks being read.
constexpr std::uint64_t kSourceBytesPerVoxel = 4 + 3 * sizeof(PackedPlane) + 2;
constexpr std::uint64_t kBytesPerWindow = 64 * kKibibyte;

// Pages of code and libraries, the allocator's slack, and buffers of the reading of labels.
constexpr std::uint64_t kProgramBytes = 20 * kMebibyte;
constexpr std::uint64_t kBytesPerThread = kMebibyte;
// The label table, and the counts of each label in voxels and mesh.
constexpr std::uint64_t kBytesPerLabel = 96;

// Places of a brick of the input and of a coarsened one, its large cells.
constexpr std::uint64_t kBytesPerBrick = 20;
// The count of a brick's faces, which every process has for the whole volume.
constexpr std::uint64_t kBytesPerCountedBrick = 2;
// A tile and its halo before and after coarsening, or while thin parts are found in it; and a tile
// that is read, with raw and dense labels.
constexpr std::uint64_t kCoarseningBytes = 12 * kMebibyte;
constexpr std::uint64_t kReadingBytes = 4 * kMebibyte;
// A tile and its halo whose source surface is found: 108^3 voxels with 8 bytes each, and 72 bytes a
// face.
constexpr std::uint64_t kSourceBytes = 48 * kMebibyte;
constexpr std::uint64_t kSourceBytesPerBrick = 8;

// For decoding, positions and tets with global rows; before these for triangles and their edges.
constexpr std::uint64_t kBytesPerWrittenByte = 4;

std::uint64_t content_bytes(const StartSize& size) {
  return size.vertices * sizeof(BlockVertex) + size.tets * sizeof(BlockTet) +
         size.samples * sizeof(BlockSample);
}

/// Returns what the content of a window takes whatever its labels are.
double max_window_bytes(const WindowGrid& grid) {
  std::uint64_t content = 0;
  for (Index3 block : grid.blocks_of({0, 0, 0})) {
    content += content_bytes(max_start_size(grid, block));
  }
  return kBytesPerContentByte * static_cast<double>(content);
}

/// Returns the bytes of the labels that the distance guard looks at; 0 without a bound.
std::uint64_t distance_label_bytes(const WindowGrid& grid, Index3 window,
                                   const WindowNeeds& needs) {
  if (!needs.max_distance) return 0;
  const Index3 edges = grid.window_box(window).shape(), volume = grid.volume();
  const std::int64_t around = 2 * (LabelReach::search_reach(*needs.max_distance) + 1);
  const auto along = [&](std::int64_t edge, std::int64_t all) {
    return static_cast<std::uint64_t>(std::min(edge + (edge + 1) / 2 + around, all));
  };
  const std::uint64_t each = kBytesPerLabelVoxel + (needs.has_source ? kSourceBytesPerVoxel : 0);
  return each * along(edges.x, volume.x) * along(edges.y, volume.y) * along(edges.z, volume.z);
}

}  // namespace

std::uint64_t window_bytes(const WindowGrid& grid, Index3 window, const BlockStore& store,
                           const WindowNeeds& needs) {
  std::uint64_t content = store.taken_bytes(window);
  for (Index3 block : grid.blocks_of(window)) {
    if (store.loaded_bytes(block) == 0) content += content_bytes(needs.start_size(block));
  }
  const auto voxels =
      static_cast<std::uint64_t>(grown(grid.window_box(window), kStartLabelHalo).voxels());
  const std::uint64_t labels =
      std::max(kBytesPerStartVoxel * voxels, distance_label_bytes(grid, window, needs));
  return static_cast<std::uint64_t>(kBytesPerContentByte * static_cast<double>(content)) + labels +
         kBytesPerWindow;
}

/// Noise gives the most: a vertex for each corner of a voxel, six tets a voxel where cells of two
/// voxels fan out to all their corners, and three faces a voxel, each with all its samples apart.
StartSize max_start_size(const WindowGrid& grid, Index3 block) {
  const Box3 box = grid.block_box(block);
  const auto voxels = static_cast<std::uint64_t>(box.voxels());
  const auto corners = static_cast<std::uint64_t>(grown(box, 1).voxels());
  return {.vertices = corners, .tets = 6 * voxels, .samples = 3 * kSamplesPerFace * corners};
}

/// Content reaches out as far as for kBytesPerLabelVoxel, here on either side.
std::int64_t content_halo(const WindowGrid& grid, double max_distance) {
  const Index3 edges = grid.window_box({0, 0, 0}).shape();
  const std::int64_t longest = std::max({edges.x, edges.y, edges.z});
  return (longest + 1) / 2 + LabelReach::search_reach(max_distance) + 1;
}

bool budget_is_ample(std::uint64_t memory, const WindowGrid& grid, int threads) {
  return static_cast<double>(memory) > 2.0 * (threads + 1) * max_window_bytes(grid);
}

std::uint64_t usual_window_bytes(const WindowGrid& grid, bool sized) {
  return static_cast<std::uint64_t>((sized ? kUsualShareSized : kUsualShare) *
                                    max_window_bytes(grid));
}

std::uint64_t program_bytes(std::size_t labels, int threads) {
  return kProgramBytes + kBytesPerThread * static_cast<std::uint64_t>(threads) +
         kBytesPerLabel * labels;
}

std::uint64_t prepared_label_bytes(Index3 shape, bool sized) {
  return prepared_label_bytes(bricks_of(shape), shape, sized);
}

std::uint64_t prepared_label_bytes(const NeededBricks& share, Index3 shape, bool sized) {
  const auto held = static_cast<std::uint64_t>(share.original.voxels());
  const auto all = static_cast<std::uint64_t>(bricks_of(shape).original.voxels());
  return kBytesPerBrick * held + kBytesPerCountedBrick * all +
         (sized ? SizeField::making_bytes(shape) + kSourceBytesPerBrick * held : 0);
}

std::uint64_t brick_place_bytes(Index3 shape) {
  return kSourceBytesPerBrick * static_cast<std::uint64_t>(bricks_of(shape).original.voxels());
}

std::uint64_t preparation_bytes(const MeshSettings& settings, bool has_scores) {
  if (wants_source(settings, has_scores)) return kSourceBytes;
  const bool has_halo = settings.start == StartMesh::kCoarse || settings.sizes.across > 0;
  return has_halo ? kCoarseningBytes : kReadingBytes;
}

std::uint64_t written_block_bytes(std::uint64_t loaded) {
  return kBytesPerWrittenByte * loaded;
}

}  // namespace mw::engine
