// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels of a caller's array as a volume.
#include "engine/api/array_volume.h"

#include <algorithm>
#include <bit>

#include "engine/api/errors.h"
#include "engine/api/spaces.h"
#include "io/file/errors.h"
#include "io/volume/decode.h"

namespace mw::api {
namespace {

constexpr io::ByteOrder kMachine =
    std::endian::native == std::endian::little ? io::ByteOrder::kLittle : io::ByteOrder::kBig;

static_assert(static_cast<int>(io::VoxelType::kU8) == MW_U8 &&
              static_cast<int>(io::VoxelType::kF64) == MW_F64);

Index3 shape_of(const std::int64_t* shape) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (shape[axis] >= 1 && shape[axis] <= kMaxAxisVoxels) continue;
    io::fail_usage("shape (", std::string_view("xyz").substr(axis, 1), "): must be from 1 to ",
                   kMaxAxisVoxels, " voxels, got ", shape[axis]);
  }
  return {shape[0], shape[1], shape[2]};
}

io::VoxelType type_of(mw_type type) {
  if (type >= MW_U8 && type <= MW_F64) return static_cast<io::VoxelType>(type);
  io::fail_usage("type: is none of mw_type");
}

std::array<std::int64_t, 3> strides_of(const io::VolumeInfo& info, const std::int64_t* strides) {
  if (strides != nullptr) return {strides[0], strides[1], strides[2]};
  const std::int64_t x = io::byte_size(info.type);
  return {x, x * info.shape.x, x * info.shape.x * info.shape.y};
}

/// Returns whether a type holds the label; one of floats is taken to hold all of them.
bool holds(io::VoxelType type, RawLabel label) {
  const auto bits = static_cast<unsigned>(8 * io::byte_size(type));
  if (io::is_float(type) || bits == 64) return true;
  if (!io::is_signed(type)) return label >> bits == 0;
  // A negative label has ones in all higher bits.
  const std::int64_t rest = static_cast<std::int64_t>(label) >> (bits - 1);
  return rest == 0 || rest == -1;
}

/// Throws if the type of the volume cannot hold one of the labels of the box.
void require_held(const io::VolumeInfo& info, const Box3& box, std::span<const RawLabel> labels) {
  const auto wrong = std::find_if(labels.begin(), labels.end(),
                                  [&](RawLabel label) { return !holds(info.type, label); });
  if (wrong == labels.end()) return;
  const std::int64_t at = wrong - labels.begin();
  const std::int64_t row = box.hi.x - box.lo.x, plane = row * (box.hi.y - box.lo.y);
  throw Error(
      ErrorKind::kInput,
      io::text("volume: voxel (", box.lo.x + at % row, ", ", box.lo.y + at % plane / row, ", ",
               box.lo.z + at / plane, ") came back with a label that ", io::name(info.type),
               ", the type of the volume, cannot hold; give the type of the labels"));
}

}  // namespace

io::VolumeInfo info_of(mw_type type, const std::int64_t* shape, const mw_space* space) {
  require(shape, "shape");
  return {
      .shape = shape_of(shape), .space = io_space(space), .type = type_of(type), .format = kArray};
}

ArrayReader::ArrayReader(const void* data, const io::VolumeInfo& info, const std::int64_t* strides)
    : data_(static_cast<const std::byte*>(data)), strides_(strides_of(info, strides)), info_(info) {
  if (data_ == nullptr) io::fail_usage("array: there is no data");
  info_.z_fastest = std::abs(strides_[2]) < std::abs(strides_[0]);
}

void ArrayReader::read(const Box3& box, std::span<RawLabel> out) const {
  const io::VoxelCoding coding{.type = info_.type, .order = kMachine};
  const auto size = static_cast<std::int64_t>(io::byte_size(info_.type));
  const auto row = static_cast<std::size_t>(box.hi.x - box.lo.x);
  std::vector<std::byte> packed;
  // decode_voxels() takes steps of whole voxels forwards; rows of other strides are gathered first.
  const bool is_plain = strides_[0] > 0 && strides_[0] % size == 0;
  if (!is_plain) packed.resize(row * static_cast<std::size_t>(size));
  RawLabel* next = out.data();
  for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
    for (std::int64_t y = box.lo.y; y < box.hi.y; ++y, next += row) {
      const std::byte* first = data_ + box.lo.x * strides_[0] + y * strides_[1] + z * strides_[2];
      std::size_t step = is_plain ? static_cast<std::size_t>(strides_[0] / size) : 1;
      if (!is_plain) {
        for (std::size_t i = 0; i < row; ++i) {
          std::copy_n(first + static_cast<std::int64_t>(i) * strides_[0], size,
                      packed.data() + i * static_cast<std::size_t>(size));
        }
        first = packed.data();
      }
      const std::size_t good = io::decode_voxels(first, row, step, coding, next, 1);
      if (good == row) continue;
      const Index3 voxel{box.lo.x + static_cast<std::int64_t>(good), y, z};
      io::fail_voxel(kArray, voxel, first + good * step * static_cast<std::size_t>(size), coding);
    }
  }
}

RegionReader::RegionReader(io::VolumeInfo info, Read reader, void* data)
    : info_(std::move(info)), read_(reader), data_(data) {
  if (read_ == nullptr) io::fail_usage("volume: there is no function that reads it");
}

void RegionReader::read(const Box3& box, std::span<RawLabel> out) const {
  const std::int64_t lo[3]{box.lo.x, box.lo.y, box.lo.z}, hi[3]{box.hi.x, box.hi.y, box.hi.z};
  if (read_(data_, lo, hi, out.data()) != 0) throw CallbackFailed();
  require_held(info_, box, out);
}

}  // namespace mw::api
