// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What every format demands of its numbers.
#include "io/volume/checks.h"

#include <cmath>

#include "io/file/errors.h"

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

}  // namespace mw::io
