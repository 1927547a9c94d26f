// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes and names of the voxel types.
#include "io/volume/voxel_type.h"

#include <array>

namespace mw::io {
namespace {

constexpr std::array<const char*, 10> kNames{"u8",  "u16", "u32", "u64", "i8",
                                             "i16", "i32", "i64", "f32", "f64"};

}  // namespace

int byte_size(VoxelType type) {
  if (is_float(type)) return type == VoxelType::kF32 ? 4 : 8;
  return 1 << (static_cast<int>(type) % 4);
}

bool is_signed(VoxelType type) {
  return type >= VoxelType::kI8;
}

bool is_float(VoxelType type) {
  return type >= VoxelType::kF32;
}

const char* name(VoxelType type) {
  return kNames[static_cast<std::size_t>(type)];
}

std::optional<VoxelType> parse_voxel_type(std::string_view text) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (text == kNames[i]) return static_cast<VoxelType>(i);
  }
  return std::nullopt;
}

VoxelType float_type(int bytes) {
  return bytes == 4 ? VoxelType::kF32 : VoxelType::kF64;
}

VoxelType integer_type(int bytes, bool is_signed) {
  int log2 = 0;
  while ((1 << log2) < bytes) ++log2;
  return static_cast<VoxelType>(log2 + (is_signed ? 4 : 0));
}

}  // namespace mw::io
