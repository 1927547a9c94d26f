// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What every format demands of its numbers and its place.
#include "io/volume/checks.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/file/read_number.h"
#include "kernels/core/vector3.h"

namespace mw::io {

Index3 checked_shape(std::string_view file, std::string_view field,
                     std::array<std::int64_t, 3> extents) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string where = text(field, " (", std::string_view("xyz").substr(axis, 1), ")");
    if (extents[axis] < 1) {
      fail_input(file, where, text("extent ", extents[axis], " is not positive"),
                 "the header is damaged or the volume is empty");
    }
    if (extents[axis] > kMaxAxisVoxels) {
      fail_input(file, where,
                 text("extent ", extents[axis], " is above ", kMaxAxisVoxels,
                      " voxels, the most along an axis (positions are 32-bit, 1/1024 voxel)"),
                 "cut the volume into parts");
    }
  }
  return {extents[0], extents[1], extents[2]};
}

void check_spacing(std::string_view file, std::string_view field, double spacing) {
  if (std::isfinite(spacing) && spacing > 0) return;
  fail_input(file, field, text("spacing ", spacing, " is not a finite positive number"),
             "give the right one with --spacing");
}

void check_origin(std::string_view file, std::string_view field, double origin) {
  if (std::isfinite(origin)) return;
  fail_input(file, field, text("origin ", origin, " is not finite"),
             "give the right one with --origin");
}

void check_same_grid(std::string_view file, const VolumeInfo& info, const VolumeInfo& before,
                     std::string_view what) {
  const Index3 a = info.shape, b = before.shape;
  if (a != b) {
    fail_input(file, "shape",
               text(a.x, " x ", a.y, " x ", a.z, " voxels, but the ", what, " before it have ", b.x,
                    " x ", b.y, " x ", b.z),
               text("give ", what, " of one grid"));
  }
  if (is_same_place(in_frame(info.space, before.space.frame), before.space)) return;
  fail_input(file, "place", text("lies elsewhere than the ", what, " before it"),
             text("resample the ", what, " to one grid, or give --spacing and --origin"));
}

std::uint64_t payload_bytes(const VolumeInfo& info) {
  return static_cast<std::uint64_t>(info.shape.product()) *
         static_cast<std::uint64_t>(byte_size(info.type));
}

void check_payload(const ByteSource& source, const VolumeInfo& info, std::uint64_t offset,
                   BytesBehind behind, std::uint64_t copies) {
  const std::uint64_t wanted = saturating_product(payload_bytes(info), copies);
  // One byte more, as a packed source compares its checksum at its end.  Where more bytes are
  // refused, they are counted further, which shows the type that the voxels may have.
  const std::uint64_t max =
      behind == BytesBehind::kIgnored ? wanted + 1 : saturating_product(wanted, 16);
  const std::uint64_t size = source.size_within(saturating_sum(offset, max));
  const std::uint64_t held = size > offset ? size - offset : 0;
  if (held == wanted || (held > wanted && behind == BytesBehind::kIgnored)) return;
  const std::string reason = text(
      "shape ", info.shape.x, " x ", info.shape.y, " x ", info.shape.z, " of ", name(info.type),
      copies == 1 ? "" : text(", ", copies, " times,"), " needs ", wanted, " bytes after offset ",
      offset, ", the file holds ", held < max ? "" : "at least ", held);
  fail_input(source.name(), "voxel data", reason,
             held < wanted ? "the file is truncated or the shape or type is wrong"
                           : "the shape or type is wrong");
}

namespace {

/// Largest cosine between two axes.  Headers in float are off by 1e-7, the sums of some tools by
/// 1e-5; over a thousand voxels 1e-4 is a tenth of one.
constexpr double kMaxShear = 1e-4;

bool is_direction(const Vector3& step) {
  const double length = std::hypot(step[0], step[1], step[2]);
  return std::isfinite(length) && length > 0;
}

/// Rounds to the fewest digits within a relative error, and at most to 14, which is all that
/// lengths of turned steps are good for: a turned spacing of 1.25 is 1.25 again, so that a volume
/// is meshed the same in all its directions.
double tidied(double length, double error) {
  constexpr int kMostDigits = 14;
  double out = length;
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    std::array<char, 32> text{};
    const char* end = std::to_chars(text.data(), text.data() + text.size(), length,
                                    std::chars_format::scientific, digits - 1)
                          .ptr;
    (void)read_number({text.data(), end}, out);
    if (std::abs(out - length) <= error * length) break;
  }
  return out;
}

double length_of(const FileSpace& space, std::size_t axis) {
  constexpr double kAgree = 1e-5;       // error of six digits
  constexpr double kFloatError = 3e-7;  // error of floats, and of sums of them
  const Vector3& step = space.steps[axis];
  const double length = std::hypot(step[0], step[1], step[2]);
  if (std::count(step.begin(), step.end(), 0.0) == 2) return length;
  double stated = space.lengths ? (*space.lengths)[axis] : length;
  if (!(std::abs(stated - length) <= kAgree * length)) stated = length;
  const bool is_rounded = space.in_floats && std::abs(stated - length) <= kFloatError * length;
  return is_rounded ? tidied(length, kFloatError) : tidied(stated, 0);
}

void check_steps(std::string_view file, const FileSpace& space) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3& step = space.steps[i];
    const std::string field =
        text(space.steps_field, " (", std::string_view("xyz").substr(i, 1), ")");
    check_spacing(file, field, std::hypot(step[0], step[1], step[2]));
  }
}

/// Returns the nearest axes at right angles by Higham (SIAM J. Sci. Stat. Comput. 7, 1986): steps
/// go half-way to the inverse of the transpose.  Signed permutations stay as they are to the bit.
std::array<Vector3, 3> straightened(std::array<Vector3, 3> axes) {
  constexpr int kSteps = 6;  // each squares the error
  for (int step = 0; step < kSteps; ++step) {
    const std::array<Vector3, 3> old = axes;
    const double determinant = dot(old[0], cross(old[1], old[2]));
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 inverse = cross(old[(i + 1) % 3], old[(i + 2) % 3]);
      for (std::size_t k = 0; k < 3; ++k) {
        axes[i][k] = (old[i][k] + inverse[k] / determinant) / 2;
      }
    }
  }
  return axes;
}

std::array<Vector3, 3> axes_of(std::string_view file, const FileSpace& space) {
  std::array<Vector3, 3> axes = space.steps;
  for (Vector3& axis : axes) {
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    for (double& x : axis) x /= length;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double cosine = dot(axes[i], axes[(i + 1) % 3]);
    if (std::abs(cosine) <= kMaxShear) continue;
    fail_input(
        file, space.steps_field,
        text("the axes ", std::string_view("xyz").substr(i, 1), " and ",
             std::string_view("xyz").substr((i + 1) % 3, 1),
             " of the array are not at right angles in the world (cosine ", cosine,
             "): a sheared volume has no quality or distance that could be promised"),
        text(space.way_out,
             "resample it onto a grid with right angles, or, where it is the volume to mesh, give "
             "--frame voxel"));
  }
  return straightened(axes);
}

void choose_frame(std::string_view file, VolumeSpace& space, FrameChoice choice) {
  if (choice == FrameChoice::kFile) return;
  const WorldFrame wanted = choice == FrameChoice::kRas ? WorldFrame::kRas : WorldFrame::kLps;
  if (space.frame == WorldFrame::kOwn) {
    fail_usage("--frame ", name(wanted), ": ", file,
               " does not say how its axes lie in a patient; take its own with --frame file");
  }
  space = in_frame(space, wanted);
}

}  // namespace

std::array<Vector3, 3> steps_of(const Vector3& spacing) {
  return {{{spacing[0], 0, 0}, {0, spacing[1], 0}, {0, 0, spacing[2]}}};
}

std::optional<FrameChoice> parse_frame_choice(std::string_view text) {
  if (text == "file") return FrameChoice::kFile;
  if (text == "ras") return FrameChoice::kRas;
  if (text == "lps") return FrameChoice::kLps;
  if (text == "voxel") return FrameChoice::kVoxel;
  return std::nullopt;
}

VolumeSpace placed(std::string_view file, const FileSpace& space, const OpenOptions& options) {
  VolumeSpace out{.unit = space.unit,
                  .frame = space.frame,
                  .is_sized = space.is_sized || options.spacing.has_value()};
  const bool has_directions = std::all_of(space.steps.begin(), space.steps.end(), is_direction);
  if (!options.spacing) check_steps(file, space);
  if (has_directions && options.frame != FrameChoice::kVoxel) {
    out.axes = axes_of(file, space);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    out.spacing[i] = options.spacing ? (*options.spacing)[i] : length_of(space, i);
  }
  if (options.spacing) out.unit.clear();
  if (options.frame == FrameChoice::kVoxel) {
    out.frame = WorldFrame::kOwn;
  } else {
    if (space.first && !options.origin) {
      for (const double x : *space.first) check_origin(file, space.first_field, x);
      out.origin = *space.first;
      if (space.first_is_centre) out.origin = to_world(out, {-0.5, -0.5, -0.5});
    }
    if (!has_directions) out.frame = WorldFrame::kOwn;
    choose_frame(file, out, options.frame);
  }
  if (options.origin) out.origin = *options.origin;
  return out;
}

Index3 number_of_first_voxel(const std::function<OwnPlace()>& place) {
  constexpr double kOffGrid = 1e-3;
  constexpr double kMost = 0x1p48;  // far beyond any volume
  std::array<std::int64_t, 3> out{};
  try {
    const auto [space, first_is_centre] = place();
    if (!is_upright(space)) return {0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const double number = space.origin[i] / space.spacing[i] + (first_is_centre ? 0.5 : 0);
      const double whole = std::round(number);
      if (!(std::abs(number - whole) <= kOffGrid && std::abs(whole) < kMost)) return {0, 0, 0};
      out[i] = static_cast<std::int64_t>(whole);
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return {0, 0, 0};
  }
  return {out[0], out[1], out[2]};
}

}  // namespace mw::io
