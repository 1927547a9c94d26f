// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels of any type and byte order from bytes and to bytes; the types by their names and sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/file/byte_order.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// Returns the type that name() calls so: "u8" .. "i64", "f32", "f64".
[[nodiscard]] std::optional<VoxelType> parse_voxel_type(std::string_view text);

/// REQUIRES: bytes is 1, 2, 4 or 8.
[[nodiscard]] VoxelType integer_type(int bytes, bool is_signed);

/// REQUIRES: bytes is 4 or 8.
[[nodiscard]] VoxelType float_type(int bytes);

/// How stored numbers become labels: slope * stored + intercept (NIfTI).
struct VoxelScaling {
  double slope = 1;
  double intercept = 0;

  [[nodiscard]] bool is_identity() const { return slope == 1 && intercept == 0; }
};

/// How voxels are stored.
struct VoxelCoding {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
  VoxelScaling scaling{};
  /// Whether voxels are numbers of any kind, so that they become the bits of doubles, not labels.
  bool as_numbers = false;
};

/// Decodes `count` voxels at `bytes`, each `step` voxels behind the last, to out[0], out[stride]
/// and so on.  Signed types are sign-extended.  Floats and scaled numbers must be within kRounding
/// of whole numbers, which they become, and within 64 signed bits, unless coding.as_numbers.
/// ENSURES: returns the index of the first that is not, or count.
[[nodiscard]] std::size_t decode_voxels(const std::byte* bytes, std::size_t count, std::size_t step,
                                        const VoxelCoding& coding, RawLabel* out,
                                        std::size_t stride);

/// How far the number of a label may be from the whole number that it is taken for.
inline constexpr double kRounding = 1e-3;

/// Returns how many voxels decode_voxels() has rounded in this thread.
[[nodiscard]] std::uint64_t rounded_voxels();

/// Turns bits into the doubles that they are (VoxelCoding::as_numbers).  REQUIRES: sizes are equal.
void numbers_of_bits(std::span<const RawLabel> bits, std::span<double> out);

/// Says why the voxel at `bytes` is no label, such as "value 1.5 is not a whole number".
[[nodiscard]] std::string why_no_label(const std::byte* bytes, const VoxelCoding& coding);

/// Throws mw::Error(kInput) for a voxel that is no label: "FILE: voxel (x, y, z): value 1.5 is not
/// a whole number; WAY_OUT".
[[noreturn]] void fail_voxel(std::string_view file, Index3 voxel, const std::byte* bytes,
                             const VoxelCoding& coding);

/// Encodes labels, least significant byte first.  REQUIRES: the type is one of integers, and out
/// has the size of the voxels.
/// ENSURES: returns the index of the first label that the type cannot hold (nothing is written from
/// there on), or labels.size().
[[nodiscard]] std::size_t encode_voxels(std::span<const RawLabel> labels, VoxelType type,
                                        std::span<std::byte> out);

}  // namespace mw::io
