// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bricks with labels of 1, 2 or 4 bytes.
#include "io/labels/brick_volume.h"

#include <algorithm>
#include <array>

#include "kernels/core/assert.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

constexpr std::size_t kMaxBytes = BrickVolume::kEdge * BrickVolume::kEdge * BrickVolume::kEdge * 4;

std::int64_t bricks_along(std::int64_t voxels) {
  return (voxels + BrickVolume::kEdge - 1) / BrickVolume::kEdge;
}

template <typename Stored>
void encode(std::span<const Label> labels, std::byte* out) {
  auto* stored = reinterpret_cast<Stored*>(out);
  for (const Label l : labels) *stored++ = static_cast<Stored>(l);
}

template <typename Stored>
void decode_row(const std::byte* in, std::int64_t first, std::int64_t count, Label* out) {
  const auto* stored = reinterpret_cast<const Stored*>(in) + first;
  std::copy_n(stored, count, out);
}

}  // namespace

BrickVolume::BrickVolume(Index3 shape, std::size_t labels, const std::filesystem::path& folder)
    : BrickVolume(
          shape, labels, folder,
          {{0, 0, 0}, {bricks_along(shape.x), bricks_along(shape.y), bricks_along(shape.z)}}) {}

BrickVolume::BrickVolume(Index3 shape, std::size_t labels, const std::filesystem::path& folder,
                         const Box3& held)
    : shape_(shape),
      bricks_{bricks_along(shape.x), bricks_along(shape.y), bricks_along(shape.z)},
      held_(held),
      label_bytes_(labels <= 0x100     ? 1
                   : labels <= 0x10000 ? 2
                                       : 4),
      entries_(static_cast<std::size_t>(held.voxels())),
      file_(folder) {}

std::size_t BrickVolume::row(Index3 brick) const {
  MW_ASSERT(held_.contains(brick));
  return static_cast<std::size_t>(held_.offset(brick));
}

Box3 BrickVolume::box_of(Index3 brick) const {
  const Index3 lo{brick.x * kEdge, brick.y * kEdge, brick.z * kEdge};
  return intersection({lo, lo + Index3{kEdge, kEdge, kEdge}}, {{0, 0, 0}, shape_});
}

void BrickVolume::write(Index3 brick, std::span<const Label> voxels) {
  MW_ASSERT(voxels.size() == static_cast<std::size_t>(box_of(brick).voxels()));
  const Label first = voxels[0];
  if (std::all_of(voxels.begin(), voxels.end(), [first](Label l) { return l == first; })) {
    entries_[row(brick)] = first;
    return;
  }
  alignas(Label) std::array<std::byte, kMaxBytes> bytes;
  if (label_bytes_ == 1) {
    encode<std::uint8_t>(voxels, bytes.data());
  } else if (label_bytes_ == 2) {
    encode<std::uint16_t>(voxels, bytes.data());
  } else {
    encode<std::uint32_t>(voxels, bytes.data());
  }
  const std::size_t size = voxels.size() * label_bytes_;
  const std::uint64_t offset = file_size_.fetch_add(size, std::memory_order_relaxed);
  file_.write_at(offset, std::span(bytes).first(size));
  entries_[row(brick)] = kInFile | offset;
}

std::optional<Label> BrickVolume::uniform_label(Index3 brick) const {
  const std::uint64_t entry = entries_[row(brick)];
  if ((entry & kInFile) != 0) return std::nullopt;
  return static_cast<Label>(entry);
}

void BrickVolume::read(const Box3& box, std::span<Label> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  const Box3 inside = intersection(box, {{0, 0, 0}, shape_});
  if (inside != box) std::fill(out.begin(), out.end(), kExterior);
  if (inside.lo.x >= inside.hi.x || inside.lo.y >= inside.hi.y || inside.lo.z >= inside.hi.z) {
    return;
  }
  const Box3 bricks{
      {inside.lo.x / kEdge, inside.lo.y / kEdge, inside.lo.z / kEdge},
      {bricks_along(inside.hi.x), bricks_along(inside.hi.y), bricks_along(inside.hi.z)}};
  for_each_index(bricks,
                 [&](Index3 b) { copy_part(b, intersection(box_of(b), inside), box, out); });
}

void BrickVolume::copy_part(Index3 brick, const Box3& part, const Box3& box,
                            std::span<Label> out) const {
  const std::optional<Label> uniform = uniform_label(brick);
  const Box3 whole = box_of(brick);
  alignas(Label) std::array<std::byte, kMaxBytes> bytes;
  if (!uniform) {
    file_.read_at(entries_[row(brick)] & ~kInFile,
                  std::span(bytes).first(static_cast<std::size_t>(whole.voxels()) * label_bytes_));
  }
  const std::int64_t count = part.shape().x;
  for (Index3 v = part.lo; v.z < part.hi.z; ++v.z) {
    for (v.y = part.lo.y; v.y < part.hi.y; ++v.y) {
      Label* to = out.data() + box.offset(v);
      const std::int64_t first = whole.offset(v);
      if (uniform) {
        std::fill_n(to, count, *uniform);
      } else if (label_bytes_ == 1) {
        decode_row<std::uint8_t>(bytes.data(), first, count, to);
      } else if (label_bytes_ == 2) {
        decode_row<std::uint16_t>(bytes.data(), first, count, to);
      } else {
        decode_row<std::uint32_t>(bytes.data(), first, count, to);
      }
    }
  }
}

}  // namespace mw::io
