// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// DICOM segmentations: files, and without DCMTK, which reads them in a process that a fuzzer does
// not see, headers of packed frames and places of frames.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/file/byte_order.h"
#include "io/volume/dicom/frame_unpacker.h"
#include "io/volume/dicom/open_dicom.h"
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/byte_file.h"
#include "tests/fuzz/choices.h"
#include "tests/fuzz/look_at_volume.h"

namespace mw::fuzz {
namespace {

/// How many bytes a segment of RLE unpacks to before nothing but zeros follow.
std::size_t unpacked_bytes(Bytes segment, std::size_t wanted) {
  Choices next(segment);
  std::size_t out = 0;
  while (out < wanted) {
    const std::uint32_t length = next.byte();
    const bool is_run = length >= 128;
    const std::size_t taken = is_run ? 1 : length + 1;
    require(taken <= next.rest().size(), "no run leads out of its segment");
    next = Choices(next.rest().subspan(taken));
    out += is_run ? 257 - length : length + 1;
  }
  return out;
}

void check_rle(Bytes frame, const io::DicomGrid& grid) {
  const auto voxels = static_cast<std::size_t>(grid.rows * grid.columns);
  const auto first_of = [&](std::size_t segment) {
    return io::load<std::uint32_t>(frame.data() + 4 * segment, io::ByteOrder::kLittle);
  };
  const auto segments = static_cast<std::size_t>(grid.bits / 8);
  for (std::size_t i = 1; i <= segments; ++i) {
    const std::size_t end = i == segments ? frame.size() : first_of(i + 1);
    require(first_of(i) <= end && end <= frame.size(), "segments follow each other in the frame");
    require(unpacked_bytes(frame.subspan(first_of(i), end - first_of(i)), voxels) == voxels,
            "a segment has a byte for each voxel");
  }
}

/// Mostly a number as files have them, at times any bits.
double choose_number(Choices& choices) {
  const std::uint32_t kind = choices.byte();
  if (kind % 8 != 7)
    return static_cast<double>(static_cast<int>(choices.byte()) - 100) / (1 + kind);
  std::array<std::byte, sizeof(double)> bits{};
  for (std::byte& b : bits) b = static_cast<std::byte>(choices.byte());
  return io::load<double>(bits.data(), io::ByteOrder::kLittle);
}

Vector3 choose_vector(Choices& choices) {
  Vector3 out;
  for (double& x : out) x = choose_number(choices);
  return out;
}

io::DicomSegments choose_frames(Choices& choices) {
  io::DicomSegments out;
  out.grid = {.rows = 2, .columns = 3};
  if (choices.below(2) == 0) {
    out.grid.along_row = choose_vector(choices);
    out.grid.along_column = choose_vector(choices);
  }
  for (double* length : {&out.grid.column_spacing, &out.grid.row_spacing, &out.grid.slice_spacing,
                         &out.grid.slice_thickness}) {
    *length = std::abs(choose_number(choices));
  }
  out.segments.push_back({.number = 1, .name = "a", .colour = {}});
  while (!choices.at_end() && out.frames.size() < 100) {
    out.frames.push_back({.segment = 1, .first = choose_vector(choices)});
  }
  return out;
}

}  // namespace

/// A file of DICOM, which may begin with anything: its first byte is the rule for overlaps.
void fuzz_dicom(Bytes bytes) {
  const auto rule = static_cast<io::Overlap>(Choices(bytes).below(4));
  ends_well(
      [&] { look_at(*io::open_dicom(std::make_unique<ByteFile>(bytes), {.overlap = rule})); });
}

/// The first bytes are the grid and the packing, the others a frame.
void fuzz_packed_frame(Bytes bytes) {
  Choices choices(bytes);
  io::DicomGrid grid;
  grid.rows = 1 + static_cast<std::int32_t>(choices.byte());
  grid.columns = 1 + static_cast<std::int32_t>(choices.byte());
  const std::uint32_t kind = choices.below(4);
  grid.bits = kind % 2 == 0 ? 8 : 16;
  const Bytes frame = choices.rest();
  if (kind >= 2) {
    static_cast<void>(io::fault_of_jpeg(frame, grid));
  } else if (io::fault_of_rle(frame, grid).empty()) {
    check_rle(frame, grid);
  }
}

/// Numbers of a file: each frame is on a slice, or the file is refused.
void fuzz_slice_grid(Bytes bytes) {
  Choices choices(bytes);
  const io::DicomSegments dicom = choose_frames(choices);
  if (!io::is_sound(dicom)) return;
  ends_well([&] {
    const io::SliceGrid grid(dicom, "fuzzed.dcm");
    require(std::isfinite(grid.step()) && grid.step() > 0, "slices have a distance");
    require(grid.count() > 0 && grid.empty() >= 0 && grid.empty() < grid.count(), "some are there");
    std::int64_t lowest = grid.count(), highest = -1;
    for (std::size_t i = 0; i < dicom.frames.size(); ++i) {
      lowest = std::min(lowest, grid.slice(i));
      highest = std::max(highest, grid.slice(i));
    }
    require(lowest == 0 && highest == grid.count() - 1, "frames reach from end to end");
    for (const double x : grid.first()) require(std::isfinite(x), "the first voxel is somewhere");
  });
}

}  // namespace mw::fuzz
