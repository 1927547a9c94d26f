// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The header of a volume of FreeSurfer.
#include <array>
#include <optional>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/volume/freesurfer/open_mgh.h"

namespace mw::io {
namespace {

/// Byte offsets of the fields that matter here.
constexpr std::size_t kVersion = 0, kDimensions = 4, kFrames = 16, kType = 20, kHasPlace = 28,
                      kSpacing = 30, kDirections = 42, kCentre = 78, kFieldsEnd = 90;
constexpr std::int32_t kOnlyVersion = 1;
constexpr std::int64_t kMaxFrames = 32767;

std::int32_t int32(std::span<const std::byte> bytes, std::size_t at) {
  return load<std::int32_t>(&bytes[at], ByteOrder::kBig);
}

std::int32_t extent(std::span<const std::byte> bytes, std::size_t axis) {
  return int32(bytes, kDimensions + 4 * axis);
}

Vector3 three_reals(std::span<const std::byte> bytes, std::size_t at) {
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = decimal_of(load<float>(&bytes[at + 4 * i], ByteOrder::kBig));
  }
  return out;
}

std::optional<VoxelType> type_of(std::int32_t code) {
  switch (code) {
    case 0:
      return VoxelType::kU8;
    case 1:
      return VoxelType::kI32;
    case 3:
      return VoxelType::kF32;
    case 4:
      return VoxelType::kI16;
    case 10:
      return VoxelType::kU16;
    default:
      return std::nullopt;
  }
}

/// FreeSurfer's default where a file does not say where its voxels lie.
FileSpace coronal_space() {
  return {.steps = {{{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}, .is_sized = false};
}

FileSpace space_of(std::span<const std::byte> bytes, Index3 shape) {
  const bool has_place = load<std::int16_t>(&bytes[kHasPlace], ByteOrder::kBig) != 0;
  FileSpace space = has_place ? FileSpace{.in_floats = true} : coronal_space();
  Vector3 first{0, 0, 0};
  if (has_place) {
    const Vector3 spacing = three_reals(bytes, kSpacing);
    for (std::size_t i = 0; i < 3; ++i) {
      space.steps[i] = three_reals(bytes, kDirections + 12 * i);
      for (double& x : space.steps[i]) x *= spacing[i];
    }
    space.lengths = spacing;
    first = three_reals(bytes, kCentre);
  }
  // The centre of the volume is that of the voxel of this number, also where it is no whole one.
  const Vector3 middle{static_cast<double>(shape.x) / 2, static_cast<double>(shape.y) / 2,
                       static_cast<double>(shape.z) / 2};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) first[k] -= space.steps[i][k] * middle[i];
  }
  space.first = first;
  space.unit = "mm";
  space.frame = WorldFrame::kRas;
  space.steps_field = "Mdc, spacing";
  space.first_field = "Pxyz_c";
  return space;
}

}  // namespace

bool has_mgh_magic(std::span<const std::byte> bytes) {
  if (bytes.size() < kFieldsEnd || int32(bytes, kVersion) != kOnlyVersion) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t voxels = extent(bytes, axis);
    if (voxels < 1 || voxels > kMaxAxisVoxels) return false;
  }
  const std::int64_t frames = int32(bytes, kFrames);
  return frames >= 1 && frames <= kMaxFrames && type_of(int32(bytes, kType)).has_value();
}

MghHeader parse_mgh_header(std::span<const std::byte> bytes, std::string_view file) {
  if (bytes.size() < kMghHeaderBytes) {
    fail_input(
        file, "MGH header",
        text("truncated: it needs ", kMghHeaderBytes, " bytes, the file holds ", bytes.size()),
        "get a whole copy of the file");
  }
  if (const std::int32_t version = int32(bytes, kVersion); version != kOnlyVersion) {
    fail_input(file, "version", text(version, " is not 1"),
               "the file is damaged or of another format");
  }
  const std::int32_t code = int32(bytes, kType);
  const std::optional<VoxelType> type = type_of(code);
  if (!type) {
    fail_input(file, text("type ", code), "unsupported",
               "save as uchar, short, ushort, int or float (mri_convert -odt int)");
  }
  const std::int32_t frames = int32(bytes, kFrames);
  if (frames < 1 || frames > kMaxFrames) {
    fail_input(file, "nframes", text(frames, " is not 1 to ", kMaxFrames), "the header is damaged");
  }
  const Index3 shape = checked_shape(file, "width, height, depth",
                                     {extent(bytes, 0), extent(bytes, 1), extent(bytes, 2)});
  return {.type = *type, .shape = shape, .frames = frames, .space = space_of(bytes, shape)};
}

}  // namespace mw::io
