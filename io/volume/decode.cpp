// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels of any integer type and byte order from bytes and to bytes.
#include "io/volume/decode.h"

namespace mw::io {
namespace {

/// Calls run with a value of the C++ type that `type` names.
template <class Run>
auto with_type(VoxelType type, Run run) {
  switch (type) {
    case VoxelType::kU8:
      return run(std::uint8_t{});
    case VoxelType::kU16:
      return run(std::uint16_t{});
    case VoxelType::kU32:
      return run(std::uint32_t{});
    case VoxelType::kU64:
      return run(std::uint64_t{});
    case VoxelType::kI8:
      return run(std::int8_t{});
    case VoxelType::kI16:
      return run(std::int16_t{});
    case VoxelType::kI32:
      return run(std::int32_t{});
    case VoxelType::kI64:
      break;
  }
  return run(std::int64_t{});
}

// The byte order is a template parameter and stride 1 a loop of its own, for the vectoriser.
template <class T, ByteOrder kOrder>
void decode(const std::byte* bytes, std::size_t count, RawLabel* out, std::size_t stride) {
  if (stride == 1) {
    for (std::size_t i = 0; i < count; ++i) {
      out[i] = static_cast<RawLabel>(load<T>(bytes + i * sizeof(T), kOrder));
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    out[i * stride] = static_cast<RawLabel>(load<T>(bytes + i * sizeof(T), kOrder));
  }
}

}  // namespace

void decode_voxels(const std::byte* bytes, std::size_t count, VoxelType type, ByteOrder order,
                   RawLabel* out, std::size_t stride) {
  with_type(type, [&]<class T>(T) {
    if (order == ByteOrder::kLittle) {
      decode<T, ByteOrder::kLittle>(bytes, count, out, stride);
    } else {
      decode<T, ByteOrder::kBig>(bytes, count, out, stride);
    }
  });
}

std::size_t encode_voxels(std::span<const RawLabel> labels, VoxelType type,
                          std::span<std::byte> out) {
  return with_type(type, [&]<class T>(T) {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const T value = static_cast<T>(labels[i]);
      if (static_cast<RawLabel>(value) != labels[i]) return i;
      store_little(value, out.data() + i * sizeof(T));
    }
    return labels.size();
  });
}

}  // namespace mw::io
