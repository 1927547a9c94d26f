// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The header of a single-file NIfTI-1 or NIfTI-2 volume.
#include "io/volume/nifti/nifti_header.h"

#include <cmath>
#include <cstring>

#include "io/file/errors.h"
#include "io/volume/checks.h"

namespace mw::io {
namespace {

/// Byte offsets of the fields that matter here, and where numbers of version 1 are narrower.
struct Fields {
  int version;
  std::int32_t header_size;
  std::size_t magic, dim, datatype, pixdim, vox_offset, scl_slope, scl_inter;
  std::size_t qform_code, sform_code, qoffset, srow;
};
constexpr Fields kNifti1{1, 348, 344, 40, 70, 76, 108, 112, 116, 252, 254, 268, 280};
constexpr Fields kNifti2{2, 540, 4, 16, 12, 104, 168, 176, 184, 344, 348, 376, 400};

/// Typed access to the header's bytes.
class View {
 public:
  View(std::span<const std::byte> bytes, const Fields& fields, ByteOrder order)
      : bytes_(bytes), fields_(fields), order_(order) {}

  [[nodiscard]] const Fields& fields() const { return fields_; }
  [[nodiscard]] ByteOrder order() const { return order_; }
  [[nodiscard]] std::int16_t int16(std::size_t at) const {
    return load<std::int16_t>(&bytes_[at], order_);
  }
  /// A number that is float in version 1 and double in version 2.
  [[nodiscard]] double real(std::size_t base, std::size_t index = 0) const {
    return fields_.version == 1
               ? static_cast<double>(load<float>(&bytes_[base + 4 * index], order_))
               : load<double>(&bytes_[base + 8 * index], order_);
  }
  [[nodiscard]] std::int64_t dim(std::size_t index) const {
    return fields_.version == 1 ? int16(fields_.dim + 2 * index)
                                : load<std::int64_t>(&bytes_[fields_.dim + 8 * index], order_);
  }
  /// A code that is int16 in version 1 and int32 in version 2.
  [[nodiscard]] std::int32_t code(std::size_t at) const {
    return fields_.version == 1 ? int16(at) : load<std::int32_t>(&bytes_[at], order_);
  }
  [[nodiscard]] double vox_offset() const {
    return fields_.version == 1
               ? real(fields_.vox_offset)
               : static_cast<double>(load<std::int64_t>(&bytes_[fields_.vox_offset], order_));
  }
  [[nodiscard]] std::string_view magic() const {
    return {reinterpret_cast<const char*>(&bytes_[fields_.magic]), 3};
  }

 private:
  std::span<const std::byte> bytes_;
  const Fields& fields_;
  ByteOrder order_;
};

/// Version and byte order, told by sizeof_hdr, the first four bytes.
std::optional<View> detect(std::span<const std::byte> bytes) {
  if (bytes.size() < 4) return std::nullopt;
  for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
    const auto size = load<std::int32_t>(bytes.data(), order);
    if (size == kNifti1.header_size) return View(bytes, kNifti1, order);
    if (size == kNifti2.header_size) return View(bytes, kNifti2, order);
  }
  return std::nullopt;
}

void check_magic(const View& view, std::string_view file) {
  const std::string_view magic = view.magic();
  const std::string_view version = view.fields().version == 1 ? "1" : "2";
  if (magic == text("ni", version)) {
    fail_input(file, "magic", "header and voxels are in two files (.hdr and .img)",
               "convert to a single .nii");
  }
  if (magic != text("n+", version)) {
    fail_input(file, "magic", text("not 'n+", version, "'"), "convert to NIfTI-1 or NIfTI-2");
  }
}

VoxelType parse_datatype(int code, std::string_view file) {
  switch (code) {
    case 2:
      return VoxelType::kU8;
    case 4:
      return VoxelType::kI16;
    case 8:
      return VoxelType::kI32;
    case 256:
      return VoxelType::kI8;
    case 512:
      return VoxelType::kU16;
    case 768:
      return VoxelType::kU32;
    case 1024:
      return VoxelType::kI64;
    case 1280:
      return VoxelType::kU64;
    case 16:
    case 64:
    case 1536:
      fail_input(file, text("datatype ", code),
                 "voxels are floating point, labels must be integers",
                 "convert to an integer type");
    default:
      fail_input(file, text("datatype ", code), "unsupported", "use integers of 8 to 64 bits");
  }
}

Index3 parse_dim(const View& view, std::string_view file) {
  const std::int64_t rank = view.dim(0);
  if (rank < 3 || rank > 7) {
    fail_input(file, "dim[0]", text("the volume has ", rank, " axes, 3 are needed"));
  }
  for (std::int64_t i = 4; i <= rank; ++i) {
    const std::int64_t extent = view.dim(static_cast<std::size_t>(i));
    if (extent == 1) continue;
    fail_input(file, text("dim[", i, "]"), text("extent ", extent, " of a further axis is not 1"),
               "pick one volume of the series");
  }
  return checked_shape(file, "dim", {view.dim(1), view.dim(2), view.dim(3)});
}

void check_scaling(const View& view, std::string_view file) {
  const double slope = view.real(view.fields().scl_slope);
  const double inter = view.real(view.fields().scl_inter);
  // A slope of 0 (or NaN, as some tools write) means that the voxels are not scaled.
  if (slope == 0 || std::isnan(slope) || (slope == 1 && (inter == 0 || std::isnan(inter)))) return;
  fail_input(file, "scl_slope, scl_inter",
             text("voxels are scaled by ", slope, " and ", inter, ", labels must not be"),
             "save the labels with slope 1 and intercept 0");
}

std::uint64_t parse_vox_offset(const View& view, std::string_view file) {
  const double offset = view.vox_offset();
  const double least = view.fields().version == 1 ? 352 : 544;
  if (!(offset >= least && offset < 0x1p53) || offset != std::floor(offset)) {
    fail_input(file, "vox_offset", text(offset, " is not a whole number of at least ", least),
               "the header is damaged");
  }
  return static_cast<std::uint64_t>(offset);
}

std::optional<std::array<double, 3>> parse_centre(const View& view) {
  const Fields& f = view.fields();
  if (view.code(f.sform_code) > 0) {
    return std::array{view.real(f.srow, 3), view.real(f.srow, 7), view.real(f.srow, 11)};
  }
  if (view.code(f.qform_code) > 0) {
    return std::array{view.real(f.qoffset, 0), view.real(f.qoffset, 1), view.real(f.qoffset, 2)};
  }
  return std::nullopt;
}

}  // namespace

bool has_nifti_magic(std::span<const std::byte> bytes) {
  const std::optional<View> view = detect(bytes);
  if (!view || bytes.size() < view->fields().magic + 3) return false;
  return view->magic().starts_with("n+") || view->magic().starts_with("ni");
}

NiftiHeader parse_nifti_header(std::span<const std::byte> bytes, std::string_view file) {
  const std::optional<View> view = detect(bytes);
  if (!view) {
    fail_input(file, "sizeof_hdr", "neither 348 (NIfTI-1) nor 540 (NIfTI-2)",
               "it is damaged or of another format");
  }
  const auto needed = static_cast<std::size_t>(view->fields().header_size);
  if (bytes.size() < needed) {
    fail_input(file, "NIfTI header",
               text("truncated: it needs ", needed, " bytes, the file holds ", bytes.size()),
               "get a whole copy of the file");
  }
  check_magic(*view, file);
  check_scaling(*view, file);
  NiftiHeader header{.version = view->fields().version,
                     .order = view->order(),
                     .shape = {},
                     .first_centre = parse_centre(*view)};
  header.type = parse_datatype(view->int16(view->fields().datatype), file);
  header.shape = parse_dim(*view, file);
  header.data_offset = parse_vox_offset(*view, file);
  for (std::size_t i = 0; i < 3; ++i) header.pixdim[i] = view->real(view->fields().pixdim, i + 1);
  return header;
}

std::array<double, 3> nifti_spacing(const NiftiHeader& header, std::string_view file) {
  std::array<double, 3> spacing{};
  for (std::size_t i = 0; i < 3; ++i) {
    spacing[i] = std::abs(header.pixdim[i]);
    check_spacing(file, text("pixdim[", i + 1, "]"), spacing[i]);
  }
  return spacing;
}

std::array<double, 3> nifti_origin(const NiftiHeader& header, const std::array<double, 3>& spacing,
                                   std::string_view file) {
  std::array<double, 3> origin{};
  if (!header.first_centre) return origin;
  for (std::size_t i = 0; i < 3; ++i) {
    origin[i] = (*header.first_centre)[i] - spacing[i] / 2;
    check_origin(file, text("sform or qform offset[", i, "]"), origin[i]);
  }
  return origin;
}

}  // namespace mw::io
