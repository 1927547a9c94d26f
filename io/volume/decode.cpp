// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Decodes and encodes voxels, and names their types.
#include "io/volume/decode.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <type_traits>

#include "io/file/errors.h"
#include "kernels/core/lattice.h"

namespace mw::io {
namespace {

constexpr std::array<const char*, 10> kNames{"u8",  "u16", "u32", "u64", "i8",
                                             "i16", "i32", "i64", "f32", "f64"};

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
      return run(std::int64_t{});
    case VoxelType::kF32:
      return run(float{});
    case VoxelType::kF64:
      break;
  }
  return run(double{});
}

/// Returns x as a whole number if it is one that 64 signed bits hold.
std::optional<std::int64_t> whole(double x) {
  if (!(x >= -0x1p63 && x < 0x1p63) || x != std::floor(x)) return std::nullopt;
  return static_cast<std::int64_t>(x);
}

thread_local std::uint64_t rounded_here = 0;

/// Returns the whole number that x is, or that it is near to.
std::optional<std::int64_t> nearly_whole(double x) {
  const double nearest = std::round(x);
  if (!(std::abs(x - nearest) <= kRounding)) return std::nullopt;
  if (nearest != x) ++rounded_here;
  return whole(nearest);
}

/// Returns slope * value + intercept if it is a whole number that 64 signed bits hold.  It is
/// computed in integers where all three are, so that no bit is lost.
template <class T>
std::optional<std::int64_t> scaled(T value, const VoxelScaling& scaling) {
  if constexpr (std::is_integral_v<T>) {
    const auto slope = whole(scaling.slope), intercept = whole(scaling.intercept);
    if (slope && intercept) {
      const Int128 x = static_cast<Int128>(*slope) * value + *intercept;
      if (x < INT64_MIN || x > INT64_MAX) return std::nullopt;
      return static_cast<std::int64_t>(x);
    }
  }
  return nearly_whole(scaling.slope * static_cast<double>(value) + scaling.intercept);
}

/// Negative labels are kept in two's complement.
template <class T>
RawLabel label_of(T value) {
  return static_cast<RawLabel>(value);  // NOLINT(bugprone-signed-char-misuse): with signs
}

// The byte order is a template parameter, and neighbours have their own loop, to be vectorised.
template <class T, ByteOrder kOrder>
void decode_integers(const std::byte* bytes, std::size_t count, std::size_t step, RawLabel* out,
                     std::size_t stride) {
  if (stride == 1 && step == 1) {
    for (std::size_t i = 0; i < count; ++i) {
      out[i] = label_of(load<T>(bytes + i * sizeof(T), kOrder));
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    out[i * stride] = label_of(load<T>(bytes + i * step * sizeof(T), kOrder));
  }
}

// More than five parameters: innermost loops from one stride to another (also below).
template <class T>
std::size_t decode_checked(const std::byte* bytes, std::size_t count, std::size_t step,
                           const VoxelCoding& coding, RawLabel* out, std::size_t stride) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto label = scaled(load<T>(bytes + i * step * sizeof(T), coding.order), coding.scaling);
    if (!label) return i;
    out[i * stride] = static_cast<RawLabel>(*label);
  }
  return count;
}

template <class T>
void decode_numbers(const std::byte* bytes, std::size_t count, std::size_t step,
                    const VoxelCoding& coding, RawLabel* out, std::size_t stride) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = static_cast<double>(load<T>(bytes + i * step * sizeof(T), coding.order));
    out[i * stride] =
        std::bit_cast<RawLabel>(coding.scaling.slope * value + coding.scaling.intercept);
  }
}

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

std::size_t decode_voxels(const std::byte* bytes, std::size_t count, std::size_t step,
                          const VoxelCoding& coding, RawLabel* out, std::size_t stride) {
  return with_type(coding.type, [&]<class T>(T) {
    if (coding.as_numbers) {
      decode_numbers<T>(bytes, count, step, coding, out, stride);
      return count;
    }
    if constexpr (std::is_integral_v<T>) {
      if (coding.scaling.is_identity()) {
        if (coding.order == ByteOrder::kLittle) {
          decode_integers<T, ByteOrder::kLittle>(bytes, count, step, out, stride);
        } else {
          decode_integers<T, ByteOrder::kBig>(bytes, count, step, out, stride);
        }
        return count;
      }
    }
    return decode_checked<T>(bytes, count, step, coding, out, stride);
  });
}

std::uint64_t rounded_voxels() {
  return rounded_here;
}

void numbers_of_bits(std::span<const RawLabel> bits, std::span<double> out) {
  std::transform(bits.begin(), bits.end(), out.begin(),
                 [](RawLabel b) { return std::bit_cast<double>(b); });
}

std::string why_no_label(const std::byte* bytes, const VoxelCoding& coding) {
  const double value = with_type(
      coding.type, [&]<class T>(T) { return static_cast<double>(load<T>(bytes, coding.order)); });
  const VoxelScaling& scaling = coding.scaling;
  std::string what = text("value ", value);
  if (!scaling.is_identity()) {
    what += text(" times ", scaling.slope, " plus ", scaling.intercept);
  }
  const double label = scaling.slope * value + scaling.intercept;
  const bool is_whole = std::isfinite(label) && label == std::floor(label);
  return what + (is_whole ? " does not fit into 64 bits" : " is not a whole number");
}

void fail_voxel(std::string_view file, Index3 voxel, const std::byte* bytes,
                const VoxelCoding& coding) {
  fail_input(file, text("voxel (", voxel.x, ", ", voxel.y, ", ", voxel.z, ")"),
             why_no_label(bytes, coding),
             "labels are whole numbers: is this an image, or probabilities?");
}

std::size_t encode_voxels(std::span<const RawLabel> labels, VoxelType type,
                          std::span<std::byte> out) {
  return with_type(type, [&]<class T>(T) {
    if constexpr (std::is_integral_v<T>) {
      for (std::size_t i = 0; i < labels.size(); ++i) {
        const T value = static_cast<T>(labels[i]);
        if (static_cast<RawLabel>(value) != labels[i]) return i;
        store_little(value, out.data() + i * sizeof(T));
      }
    }
    return labels.size();
  });
}

}  // namespace mw::io
