// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/api/spaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/api/errors.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/volume/checks.h"
#include "io/volume/open_volume.h"

namespace mw::api {
namespace {

io::WorldFrame frame_of(const std::string& name, const char* expected = "own, ras or lps") {
  for (const io::WorldFrame frame :
       {io::WorldFrame::kOwn, io::WorldFrame::kRas, io::WorldFrame::kLps}) {
    if (name == io::name(frame)) return frame;
  }
  io::fail_usage("--frame ", name, ": expected ", expected);
}

void check_axes(const std::array<io::Vector3, 3>& axes) {
  constexpr double kMost = 1e-4;  // what io::placed() straightens
  for (std::size_t i = 0; i < 3; ++i) {
    const io::Vector3 &a = axes[i], &b = axes[(i + 1) % 3];
    const bool is_unit = std::abs(std::hypot(a[0], a[1], a[2]) - 1) < kMost;
    if (!is_unit) io::fail_usage("axes must have unit length");
    if (std::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) <= kMost) continue;
    io::fail_usage(
        "axes must be at right angles: resample a sheared volume onto a grid that has "
        "them, or leave the axes out");
  }
}

/// True if axes differ by no more than rounding.  To straighten axes that are straight already, as
/// those of a file are, would change last bits, so that an array had another mesh than its file.
bool are_alike(const std::array<io::Vector3, 3>& one, const std::array<io::Vector3, 3>& other) {
  constexpr double kRounding = 1e-15;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(one[i][k] - other[i][k]) > kRounding) return false;
    }
  }
  return true;
}

/// Throws if a column of an affine, or what it adds, is no place in the world.
void check_affine(const double (*affine)[4]) {
  for (std::size_t k = 0; k < 4; ++k) {
    const double length = std::hypot(affine[0][k], affine[1][k], affine[2][k]);
    if (std::isfinite(length) && (length > 0 || k == 3)) continue;
    throw Error(ErrorKind::kInput,
                io::text("affine: column ", k + 1, " must be finite",
                         k == 3 ? "" : " and not 0, as it is the edge of a voxel"));
  }
}

/// Returns whether the numbers are those of a header in floats of 32 bits, as most are in NIfTI.
bool is_in_floats(const double (*affine)[4]) {
  const auto is_float = [](double x) {
    return std::abs(x) <= std::numeric_limits<float>::max() &&
           static_cast<double>(static_cast<float>(x)) == x;
  };
  return std::all_of(&affine[0][0], &affine[0][0] + 12, is_float);
}

/// Returns what *space says, in the words of a file.
io::FileSpace file_space(const double (*affine)[4], const double* spacing, bool is_voxel,
                         const std::string& frame) {
  io::FileSpace told{
      .first = io::Vector3{},
      .frame = is_voxel ? io::WorldFrame::kOwn : frame_of(frame, "own, ras, lps or voxel"),
      .steps_field = "affine",
      .first_field = "affine"};
  told.in_floats = is_in_floats(affine);
  const auto number = [&](double x) {
    return told.in_floats ? io::decimal_of(static_cast<float>(x)) : x;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) told.steps[i][k] = number(affine[k][i]);
    (*told.first)[k] = number(affine[k][3]);
  }
  if (spacing == nullptr) return told;
  io::Vector3 lengths{spacing[0], spacing[1], spacing[2]};
  for (const double edge : lengths) io::check_spacing("affine", "spacing", edge);
  told.lengths = lengths;
  return told;
}

}  // namespace

io::VolumeSpace io_space(const mw_space* space) {
  constexpr mw_space kUnit{.spacing = {1, 1, 1},
                           .origin = {0, 0, 0},
                           .axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                           .unit = nullptr,
                           .frame = nullptr};
  const mw_space& from = space == nullptr ? kUnit : *space;
  const auto three = [](const double* at) { return io::Vector3{at[0], at[1], at[2]}; };
  const io::Vector3 spacing = three(from.spacing), origin = three(from.origin);
  const std::array<io::Vector3, 3> axes{three(from.axes[0]), three(from.axes[1]),
                                        three(from.axes[2])};
  io::check_place(spacing, origin);
  check_axes(axes);
  io::FileSpace told{.lengths = spacing,
                     .first = origin,
                     .first_is_centre = false,
                     .unit = from.unit == nullptr ? "" : from.unit,
                     .frame = frame_of(from.frame == nullptr ? "own" : from.frame)};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) told.steps[i][k] = axes[i][k] * spacing[i];
  }
  io::VolumeSpace out = io::placed(kArray, told, {});
  if (are_alike(out.axes, axes)) out.axes = axes;
  return out;
}

void tell_space(const io::VolumeSpace& space, mw_space* out) {
  std::copy_n(space.spacing.begin(), 3, out->spacing);
  std::copy_n(space.origin.begin(), 3, out->origin);
  for (std::size_t i = 0; i < 3; ++i) std::copy_n(space.axes[i].begin(), 3, out->axes[i]);
  out->unit = space.unit.c_str();
  out->frame = io::name(space.frame);
}

}  // namespace mw::api

mw_status mw_space_of_affine(const double affine[3][4], const char* frame, const double* spacing,
                             mw_space* space, mw_error** error) {
  using namespace mw;  // NOLINT(google-build-using-namespace)
  return api::tried(error, [&] {
    api::require(affine, "affine");
    api::require(space, "space");
    api::check_affine(affine);
    const std::string told = frame == nullptr ? "own" : frame;
    const bool is_voxel = told == "voxel";
    io::OpenOptions options;
    if (is_voxel) options.frame = io::FrameChoice::kVoxel;
    const io::VolumeSpace placed =
        io::placed(api::kArray, api::file_space(affine, spacing, is_voxel, told), options);
    api::tell_space(placed, space);
    space->unit = "";  // a matrix has none
  });
}
