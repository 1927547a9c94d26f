// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The header of a NIfTI file.
#include "io/volume/nifti/open_nifti.h"

#include <array>
#include <cmath>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/volume/checks.h"

namespace mw::io {
namespace {

/// Byte offsets of the fields that matter here, and where numbers of version 1 are narrower.
struct Fields {
  int version;
  std::int32_t header_size;
  std::size_t magic, dim, datatype, pixdim, vox_offset, scl_slope, scl_inter;
  std::size_t qform_code, sform_code, quatern, qoffset, srow, xyzt_units;
};
constexpr Fields kNifti1{1, 348, 344, 40, 70, 76, 108, 112, 116, 252, 254, 256, 268, 280, 123};
constexpr Fields kNifti2{2, 540, 4, 16, 12, 104, 168, 176, 184, 344, 348, 352, 376, 400, 500};

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
    return fields_.version == 1 ? decimal_of(load<float>(&bytes_[base + 4 * index], order_))
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
  /// The units, which are a byte in version 1 and int32 in version 2.
  [[nodiscard]] int units() const {
    return fields_.version == 1 ? std::to_integer<int>(bytes_[fields_.xyzt_units])
                                : load<std::int32_t>(&bytes_[fields_.xyzt_units], order_);
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

/// Finds version and byte order by sizeof_hdr, the first four bytes.
std::optional<View> detect(std::span<const std::byte> bytes) {
  if (bytes.size() < 4) return std::nullopt;
  for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
    const auto size = load<std::int32_t>(bytes.data(), order);
    if (size == kNifti1.header_size) return View(bytes, kNifti1, order);
    if (size == kNifti2.header_size) return View(bytes, kNifti2, order);
  }
  return std::nullopt;
}

constexpr std::int64_t kMaxVolumes = 32767;

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
      return VoxelType::kF32;
    case 64:
      return VoxelType::kF64;
    default:
      fail_input(file, text("datatype ", code), "unsupported",
                 "use integers of 8 to 64 bits, or whole numbers in floats of 32 or 64");
  }
}

/// Returns the shape, and finds how many volumes there are.
Index3 parse_dim(const View& view, std::int64_t& volumes, std::string_view file) {
  const std::int64_t rank = view.dim(0);
  if (rank < 3 || rank > 7) {
    fail_input(file, "dim[0]", text("the volume has ", rank, " axes, 3 are needed"));
  }
  for (std::int64_t i = 4; i <= rank; ++i) {
    const std::int64_t extent = view.dim(static_cast<std::size_t>(i));
    if (extent == 1) continue;
    if (i == 4 && extent > 1 && extent <= kMaxVolumes) {
      volumes = extent;
      continue;
    }
    fail_input(file, text("dim[", i, "]"), text("extent ", extent, " of a further axis is not 1"),
               "pick one volume of the series");
  }
  return checked_shape(file, "dim", {view.dim(1), view.dim(2), view.dim(3)});
}

VoxelScaling parse_scaling(const View& view, std::string_view file) {
  const double slope = view.real(view.fields().scl_slope);
  const double inter = view.real(view.fields().scl_inter);
  // A slope of 0 (or NaN, as some tools write) means that the voxels are not scaled.
  if (slope == 0 || std::isnan(slope)) return {};
  const VoxelScaling scaling{slope, std::isnan(inter) ? 0 : inter};
  if (std::isfinite(slope) && std::isfinite(scaling.intercept)) return scaling;
  fail_input(file, "scl_slope, scl_inter", text("voxels are scaled by ", slope, " and ", inter),
             "save the labels with slope 1 and intercept 0");
}

/// Says how voxels of Analyze 7.5 are meshed where someone knows how they lie.
std::string way_out_of_analyze(const View& view, std::string_view file) {
  std::string out =
      "convert it to NIfTI with the program that wrote it, which knows how it turns images";
  try {
    std::int64_t volumes = 1;
    const Index3 n = parse_dim(view, volumes, file);
    const VoxelType type = parse_datatype(view.int16(view.fields().datatype), file);
    out += text(", or mesh the bare voxels of the .img with --shape ", n.x, ",", n.y, ",", n.z,
                " --dtype ", name(type), view.order() == ByteOrder::kBig ? "be" : "",
                " and --spacing");
  } catch (const Error&) {
    // The header does not even tell the shape.
  }
  return out;
}

/// Returns whether the voxels are in a file of their own.
bool parse_magic(const View& view, std::string_view file) {
  const std::string_view magic = view.magic();
  const int version = view.fields().version;
  if (magic == text("ni", version)) return true;
  if (magic == text("n+", version)) return false;
  if (version == 1) {
    fail_input(
        file, "magic",
        "neither 'n+1' nor 'ni1' of NIfTI: Analyze 7.5 does not say where left and right are",
        way_out_of_analyze(view, file));
  }
  fail_input(file, "magic", "neither 'n+2' nor 'ni2'", "convert to NIfTI-1 or NIfTI-2");
}

std::uint64_t parse_vox_offset(const View& view, bool is_pair, std::string_view file) {
  const double offset = view.vox_offset();
  const double min = is_pair ? 0 : view.fields().version == 1 ? 352 : 544;
  if (!(offset >= min && offset < 0x1p53) || offset != std::floor(offset)) {
    fail_input(file, "vox_offset", text(offset, " is not a whole number of at least ", min),
               "the header is damaged");
  }
  return static_cast<std::uint64_t>(offset);
}

/// Reads the place by NIfTI-1's method 3: the rows of an affine map.
FileSpace sform(const View& view) {
  const std::size_t at = view.fields().srow;
  FileSpace space{.in_floats = view.fields().version == 1,
                  .steps_field = "sform",
                  .first_field = "sform offset"};
  Vector3 first{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) space.steps[i][k] = view.real(at, 4 * k + i);
    first[k] = view.real(at, 4 * k + 3);
  }
  space.first = first;
  return space;
}

/// Returns the columns of the rotation by a unit quaternion with these b, c and d, and a >= 0.
std::array<Vector3, 3> rotation(double b, double c, double d) {
  const double square = 1 - (b * b + c * c + d * d);
  double a = 0;
  if (square > 1e-7) {
    a = std::sqrt(square);
  } else {  // half a turn: rounding may have made the three too long
    const double length = std::hypot(b, c, d);
    b /= length, c /= length, d /= length;
  }
  return {{{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
           {2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
           {2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c}}};
}

/// Reads it by method 2: a rotation, pixdim, and a flip of the third axis if pixdim[0] is negative.
FileSpace qform(const View& view) {
  const Fields& f = view.fields();
  FileSpace space{.steps_field = "qform, pixdim", .first_field = "qform offset"};
  space.steps = rotation(view.real(f.quatern, 0), view.real(f.quatern, 1), view.real(f.quatern, 2));
  const double flip = view.real(f.pixdim, 0) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = std::abs(view.real(f.pixdim, i + 1)) * (i == 2 ? flip : 1);
    for (double& x : space.steps[i]) x *= length;
  }
  space.first = Vector3{view.real(f.qoffset, 0), view.real(f.qoffset, 1), view.real(f.qoffset, 2)};
  return space;
}

/// Three numbers of a quaternion that are longer than 1 beyond rounding are no rotation.
bool is_rotation(double quaternion) {
  constexpr double kRounding = 1e-4;
  return !(quaternion > 1 + kRounding);
}

/// Reads it by method 1: pixdim alone.
FileSpace by_pixdim(const View& view) {
  FileSpace space{.first = Vector3{0, 0, 0}, .steps_field = "pixdim"};
  const std::size_t at = view.fields().pixdim;
  space.steps = steps_of(
      {std::abs(view.real(at, 1)), std::abs(view.real(at, 2)), std::abs(view.real(at, 3))});
  return space;
}

std::string unit_name(int xyzt_units) {
  constexpr int kSpatial = 7;
  switch (xyzt_units & kSpatial) {
    case 1:
      return "m";
    case 2:
      return "mm";
    case 3:
      return "um";
    default:
      return {};
  }
}

/// Whether the steps span a volume.  Those of a header that nobody filled in are zeros.
bool spans_volume(const FileSpace& space) {
  constexpr double kLeast = 1e-6;  // of the volume of a box with these edges
  const auto& [x, y, z] = space.steps;
  const double box = std::sqrt(dot(x, x)) * std::sqrt(dot(y, y)) * std::sqrt(dot(z, z));
  return std::abs(dot(x, cross(y, z))) > kLeast * box;
}

void check_form(const View& view, FormChoice form, std::string_view file) {
  if (form == FormChoice::kFile) return;
  const bool is_sform = form == FormChoice::kSform;
  const std::size_t field = is_sform ? view.fields().sform_code : view.fields().qform_code;
  if (view.code(field) > 0) return;
  const char* const name = is_sform ? "sform" : "qform";
  fail_usage("--use-form ", name, ": ", file, " has no ", name, " (", name, "_code is ",
             view.code(field), "); leave it out");
}

void parse_space(const View& view, NiftiHeader& header, FormChoice form) {
  const Fields& f = view.fields();
  FileSpace& space = header.space;
  const bool has_qform = view.code(f.qform_code) > 0;
  bool by_sform = form != FormChoice::kQform && view.code(f.sform_code) > 0;
  if (by_sform) space = sform(view);
  header.skips_sform = form == FormChoice::kFile && by_sform && has_qform && !spans_volume(space);
  by_sform = by_sform && !header.skips_sform;
  if (!by_sform) space = has_qform ? qform(view) : by_pixdim(view);
  const double quaternion =
      std::hypot(view.real(f.quatern, 0), view.real(f.quatern, 1), view.real(f.quatern, 2));
  if (by_sform && has_qform && is_rotation(quaternion)) {
    header.qform = qform(view);
    space.way_out = "take the qform, which is there, too, with --use-form qform, or ";
  }
  if (by_sform || has_qform) space.frame = WorldFrame::kRas;
  if (!by_sform && has_qform) header.quaternion = quaternion;
  space.lengths = Vector3{std::abs(view.real(f.pixdim, 1)), std::abs(view.real(f.pixdim, 2)),
                          std::abs(view.real(f.pixdim, 3))};
  space.unit = unit_name(view.units());
}

}  // namespace

bool has_nifti_magic(std::span<const std::byte> bytes) {
  const std::optional<View> view = detect(bytes);
  if (!view || bytes.size() < view->fields().magic + 3) return false;
  return view->magic().starts_with("n+") || view->magic().starts_with("ni");
}

NiftiHeader parse_nifti_header(std::span<const std::byte> bytes, std::string_view file,
                               FormChoice form) {
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
  const bool is_pair = parse_magic(*view, file);
  NiftiHeader header{.version = view->fields().version,
                     .is_pair = is_pair,
                     .order = view->order(),
                     .shape = {},
                     .scaling = parse_scaling(*view, file),
                     .space = {}};
  check_form(*view, form, file);
  parse_space(*view, header, form);
  header.type = parse_datatype(view->int16(view->fields().datatype), file);
  header.shape = parse_dim(*view, header.masks, file);
  header.data_offset = parse_vox_offset(*view, is_pair, file);
  return header;
}

}  // namespace mw::io
