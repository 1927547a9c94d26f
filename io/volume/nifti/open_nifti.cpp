// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The label table behind the header of a NIfTI file, and the volume.
#include "io/volume/nifti/open_nifti.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/names/header_names.h"
#include "io/volume/array_series.h"
#include "io/volume/checks.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kMaxExtensionBytes = 4 << 20;
constexpr int kMaxExtensions = 1000;
/// The bytes of an extension's own length and its code, two int32.
constexpr std::uint64_t kExtensionHead = 8;

/// Returns the bytes of the extension that begins there; 0: there is none.
std::uint64_t extension_bytes(const ByteSource& source, std::uint64_t at, std::uint64_t end,
                              ByteOrder order) {
  if (end < at + kExtensionHead) return 0;
  std::array<std::byte, 4> bytes{};
  source.read_at(at, bytes);
  const auto size = load<std::int32_t>(bytes.data(), order);
  if (size <= static_cast<std::int32_t>(kExtensionHead)) return 0;
  return static_cast<std::uint64_t>(size) <= end - at ? static_cast<std::uint64_t>(size) : 0;
}

/// Reads a text up to its NUL, as most are padded with them.
std::string read_text(const ByteSource& source, std::uint64_t at, std::uint64_t size) {
  std::string out(size, '\0');
  source.read_at(at, std::as_writable_bytes(std::span(out)));
  out.resize(std::min(out.find('\0'), out.size()));
  return out;
}

void check_rotation(const NiftiHeader& header, std::string_view file) {
  if (is_rotation(header.quaternion)) return;
  fail_input(
      file, "quatern_b, quatern_c, quatern_d",
      text("their length is ", header.quaternion, ", and that of a rotation is at most 1"),
      "correct the qform, or, where it is the volume to mesh, give --frame voxel, which does "
      "without it");
}

Vector3 centre_of(const FileSpace& space, const Vector3& voxel) {
  Vector3 out = *space.first;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) out[k] += space.steps[i][k] * voxel[i];
  }
  return out;
}

/// Where two forms are farthest apart among the corners of the volume.
struct Apart {
  double way = 0;
  Index3 voxel;
  Vector3 one{}, other{};  ///< the voxel's centre by either form
};

/// Takes the first corner of those that differ by rounding alone.  The way is 0 where a form makes
/// no sense.
Apart farthest_apart(const FileSpace& a, const FileSpace& b, Index3 shape) {
  Apart most;
  for_each_index({{0, 0, 0}, {2, 2, 2}}, [&](Index3 corner) {
    const Index3 at{corner.x * (shape.x - 1), corner.y * (shape.y - 1), corner.z * (shape.z - 1)};
    const Vector3 voxel{static_cast<double>(at.x), static_cast<double>(at.y),
                        static_cast<double>(at.z)};
    const Vector3 one = centre_of(a, voxel), other = centre_of(b, voxel);
    const double way = std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);
    if (std::isfinite(way) && way > most.way * (1 + 1e-6)) most = {way, at, one, other};
  });
  return most;
}

/// Returns what to say of an sform that places the volume elsewhere than the qform does; empty
/// where they agree to a tenth of a voxel, as forms that tools convert to one another do.
std::string note_of_forms(const NiftiHeader& header, std::string_view file) {
  constexpr double kAgree = 0.1;
  double edge = std::numeric_limits<double>::infinity();
  for (const Vector3& step : header.space.steps) edge = std::min(edge, std::sqrt(dot(step, step)));
  const Apart apart = farthest_apart(header.space, *header.qform, header.shape);
  const double voxels = apart.way / edge;
  if (!(voxels > kAgree)) return {};
  const auto& [way, voxel, sform, qform] = apart;
  return text(file, ": sform and qform differ by up to ", std::round(10 * voxels) / 10,
              " voxels: the centre of voxel ", voxel.x, ",", voxel.y, ",", voxel.z, " is at ",
              sform[0], ",", sform[1], ",", sform[2], " by the sform, which is taken, and at ",
              qform[0], ",", qform[1], ",", qform[2],
              " by the qform, which --use-form qform takes");
}

}  // namespace

LabelNames read_nifti_names(const ByteSource& source, const NiftiHeader& header) {
  const std::uint64_t first = header.version == 1 ? 348 : 540;
  // Those of a pair are all that is behind the header.
  const std::uint64_t end =
      source.size_within(header.is_pair ? 2 * kMaxExtensionBytes : header.data_offset);
  if (end < first + 4) return {};
  std::array<std::byte, 4> flags{};
  source.read_at(first, flags);
  if (flags[0] == std::byte{0}) return {};
  std::uint64_t at = first + 4;
  for (int i = 0; i < kMaxExtensions; ++i) {
    const std::uint64_t size = extension_bytes(source, at, end, header.order);
    if (size == 0) break;
    if (size <= kMaxExtensionBytes) {
      const std::string text = read_text(source, at + kExtensionHead, size - kExtensionHead);
      LabelNames names = parse_label_table(text);
      if (!names.empty()) return names;
    }
    at += size;
  }
  return {};
}

std::unique_ptr<LabelVolume> open_nifti(std::unique_ptr<ByteSource> source,
                                        const OpenOptions& options) {
  NiftiFiles files = nifti_files(std::move(source));
  const std::string file = files.header->name();
  const NiftiHeader header =
      parse_nifti_header(read_prefix(*files.header, kNiftiHeaderBytes), file, options.form);
  VolumeInfo info{.shape = header.shape, .type = header.type, .format = "nifti"};
  if (options.frame != FrameChoice::kVoxel) check_rotation(header, file);
  info.space = placed(file, header.space, options);
  if (header.skips_sform) {
    info.note = text(file, ": the sform spans no volume, and the qform is taken in its place");
  }
  const bool tells_forms =
      options.form == FormChoice::kFile && options.frame != FrameChoice::kVoxel;
  if (header.qform && tells_forms) info.note = note_of_forms(header, file);
  info.scaled = !header.scaling.is_identity();
  info.names = read_nifti_names(*files.header, header);
  if (header.is_pair && files.image == nullptr) files.image = open_nifti_image(file);
  return open_series(
      std::move(header.is_pair ? files.image : files.header), std::move(info),
      {.offset = header.data_offset, .order = header.order, .scaling = header.scaling},
      header.masks, options);
}

}  // namespace mw::io
