// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds axes and place of an HDF5 data set that was described, and makes a volume of it.
#include "io/volume/hdf5/open_hdf5.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "io/chunks/chunked_volume.h"
#include "io/file/errors.h"
#include "io/json/json_fields.h"
#include "io/volume/checks.h"
#include "io/volume/raw_array.h"

namespace mw::io {
namespace {

[[noreturn]] void fail(const Hdf5Description& description, std::string_view file,
                       std::string_view reason) {
  fail_input(file, text("data set ", description.path), reason,
             "write the one volume of it that is meant, as [z, y, x]");
}

/// What axistags say of each axis of the array.
struct AxisTags {
  std::string keys;                 ///< as "zyxc"
  std::vector<double> resolutions;  ///< 0: unknown
};

/// Returns no keys without axistags.
AxisTags tags_of(const Hdf5Description& description, std::string_view file) {
  if (description.axistags.empty()) return {};
  try {
    AxisTags out;
    const Json tags = parse_json(description.axistags, file);
    const JsonFields fields(tags, std::string(file));
    for (std::size_t i = 0; i < fields.count("axes"); ++i) {
      const JsonFields axis = fields.element("axes", i);
      const std::string key = axis.text("key");
      out.keys += key.size() == 1 ? key[0] : '?';
      out.resolutions.push_back(axis.has("resolution") ? axis.number("resolution") : 0);
    }
    return out;
  } catch (const Error&) {
    fail(description, file, "its axistags are no list of axes");
  }
}

Hdf5Axes tagged_axes(const Hdf5Description& description, const std::string& keys,
                     std::string_view file) {
  if (keys.size() != description.shape.size()) {
    fail(description, file,
         text("its axistags name ", keys.size(), " axes ('", keys, "'), it has ",
              description.shape.size()));
  }
  Hdf5Axes axes;
  for (std::size_t d = 0; d < keys.size(); ++d) {
    const std::size_t i = std::string_view("xyz").find(keys[d]);
    if (i != std::string_view::npos && !axes[i]) {
      axes[i] = d;
    } else if (description.shape[d] != 1) {
      fail(description, file,
           text("axis '", keys.substr(d, 1), "' of '", keys, "' has ", description.shape[d],
                " elements, a volume has one"));
    }
  }
  return axes;
}

/// Leaves out axes of one element, the first or the last ones first, until three are left.
std::vector<std::size_t> three_of(const Hdf5Description& description, bool last_first) {
  std::vector<std::size_t> left(description.shape.size());
  for (std::size_t d = 0; d < left.size(); ++d) left[d] = d;
  if (last_first) std::reverse(left.begin(), left.end());
  for (auto axis = left.begin(); axis != left.end() && left.size() > 3;) {
    axis = description.shape[*axis] == 1 ? left.erase(axis) : axis + 1;
  }
  std::sort(left.begin(), left.end());
  return left;
}

}  // namespace

Hdf5Axes find_axes(const Hdf5Description& description, std::string_view file) {
  const std::string keys = tags_of(description, file).keys;
  if (!keys.empty()) return tagged_axes(description, keys, file);
  const bool of_dream3d = description.numbers.contains("SPACING");
  const std::vector<std::size_t> left = three_of(description, of_dream3d);
  if (left.size() == 2) return {left[1], left[0], std::nullopt};
  if (left.size() != 3) {
    fail(description, file,
         text("its shape is ", shape_text(description.shape), ", a volume has 3 axes"));
  }
  return {left[2], left[1], left[0]};
}

namespace {

std::optional<Vector3> three(const Hdf5Description& description, const char* name) {
  const auto found = description.numbers.find(name);
  if (found == description.numbers.end() || found->second.size() != 3) return std::nullopt;
  return Vector3{found->second[0], found->second[1], found->second[2]};
}

/// Some programs write an attribute `spacing` in the order of the array's axes and some as x, y, z,
/// so numbers that differ say nothing.
bool is_cube(const Vector3& edges) {
  return edges[0] == edges[1] && edges[1] == edges[2];
}

Vector3 reversed(const Vector3& v) {
  return {v[2], v[1], v[0]};
}

void check_dimensions(const Hdf5Description& description, const Index3& shape,
                      std::string_view file) {
  const auto dimensions = three(description, "DIMENSIONS");
  const Vector3 own{static_cast<double>(shape.x), static_cast<double>(shape.y),
                    static_cast<double>(shape.z)};
  if (!dimensions || *dimensions == own) return;
  fail_input(file, text("data set ", description.path),
             text("has ", shape.x, " x ", shape.y, " x ", shape.z,
                  " voxels, the DIMENSIONS of its geometry are ", (*dimensions)[0], " x ",
                  (*dimensions)[1], " x ", (*dimensions)[2]),
             "write both with DREAM.3D again, or the data set alone");
}

}  // namespace

namespace {

/// Returns the edges that axistags give to x, y and z; nothing where they lack one.  A slice is as
/// thick as its pixels are wide.
std::optional<Vector3> tagged_edges(const Hdf5Description& description, std::string_view file) {
  const AxisTags tags = tags_of(description, file);
  if (tags.keys.empty()) return std::nullopt;
  const Hdf5Axes axes = tagged_axes(description, tags.keys, file);
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = axes[i] ? tags.resolutions[*axes[i]] : out[0];
    if (!(out[i] > 0)) return std::nullopt;
  }
  return out;
}

}  // namespace

FileSpace hdf5_space(const Hdf5Description& description, const Index3& shape,
                     std::string_view file) {
  FileSpace space;
  space.first_is_centre = false;
  if (const auto spacing = three(description, "SPACING")) {
    check_dimensions(description, shape, file);
    space.steps = steps_of(*spacing);
    space.first = three(description, "ORIGIN");
    space.steps_field = "SPACING";
    space.first_field = "ORIGIN";
  } else if (const auto resolution = three(description, "resolution")) {
    space.steps = steps_of(reversed(*resolution));
    if (const auto offset = three(description, "offset")) space.first = reversed(*offset);
    space.unit = "nm";
    space.steps_field = "attribute resolution";
    space.first_field = "attribute offset";
  } else if (const auto size = three(description, "element_size_um")) {
    space.steps = steps_of(reversed(*size));
    space.unit = "um";
    space.steps_field = "attribute element_size_um";
  } else if (const auto edges = three(description, "spacing"); edges && is_cube(*edges)) {
    space.steps = steps_of(*edges);
    space.steps_field = "attribute spacing";
  } else if (const auto tagged = tagged_edges(description, file)) {
    space.steps = steps_of(*tagged);
    space.steps_field = "axistags resolution";
  } else {
    space.is_sized = false;
  }
  return space;
}

namespace {

constexpr std::string_view kMagic{"\x89HDF\r\n\x1a\n", 8};
constexpr std::size_t kFirstUserBlock = 512;

Index3 shape_of(const Hdf5Description& description, const Hdf5Axes& axes, std::string_view file) {
  std::array<std::int64_t, 3> extents{1, 1, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!axes[i]) continue;
    // What 63 bits cannot hold is too long in any case.
    extents[i] =
        static_cast<std::int64_t>(std::min<std::uint64_t>(description.shape[*axes[i]], INT64_MAX));
  }
  return checked_shape(file, text("data set ", description.path, " shape"), extents);
}

/// Whether z is the axis that goes fastest in the file.
/// ERRORS: kInput for orders of axes other than z, y, x and x, y, z.
bool is_z_fastest(const Hdf5Description& description, const Hdf5Axes& axes, std::string_view file) {
  // An axis that the array does not have can stand anywhere.
  const auto in_order = [&](const std::array<std::size_t, 3>& order) {
    std::size_t next = 0;
    for (const std::size_t i : order) {
      if (!axes[i] || description.shape[*axes[i]] == 1) continue;
      if (*axes[i] < next) return false;
      next = *axes[i];
    }
    return true;
  };
  if (in_order({2, 1, 0})) return false;
  if (in_order({0, 1, 2})) return true;
  fail_input(file, text("data set ", description.path),
             "its axes are neither in the order z, y, x nor x, y, z",
             "write it in one of them, or in chunks");
}

std::unique_ptr<LabelVolume> open_run(std::shared_ptr<const ByteSource> source, VolumeInfo info,
                                      const Hdf5Description& description) {
  const std::uint64_t offset = description.offset;
  // The voxels of a compact data set are no run of bytes in the file.
  if (description.layout == Hdf5Layout::kCompact) {
    source = written_to_file(std::as_bytes(std::span(description.bytes)), source->name());
  }
  check_payload(*source, info, offset);
  return std::make_unique<RawArrayVolume>(
      std::move(source), std::move(info),
      ArrayLayout{.offset = offset, .order = description.order});
}

/// Returns what voxels are whose chunk was never written.
ChunkFill fill_of(const Hdf5Description& description) {
  VoxelCoding coding{description.type, description.order};
  const auto* const bytes = reinterpret_cast<const std::byte*>(description.fill.data());
  ChunkFill out;
  RawLabel label = 0;
  const bool is_label = decode_voxels(bytes, 1, 1, coding, &label, 1) == 1;
  out.label = is_label ? std::optional(label) : std::nullopt;
  coding.as_numbers = true;
  static_cast<void>(decode_voxels(bytes, 1, 1, coding, &label, 1));
  out.number = std::bit_cast<double>(label);
  return out;
}

std::unique_ptr<LabelVolume> open_chunks(std::unique_ptr<ByteSource> source, VolumeInfo info,
                                         Hdf5Description description, const Hdf5Axes& axes,
                                         std::uint64_t cache_bytes) {
  check_filters(description, source->name());
  info.chunk = chunk_extents(description, axes);
  const ChunkFill fill = fill_of(description);
  const VoxelCoding coding{description.type, description.order};
  auto chunks = std::make_unique<Hdf5Chunks>(std::move(source), std::move(description), axes);
  return std::make_unique<ChunkedVolume>(std::move(info), coding, fill, std::move(chunks),
                                         cache_bytes);
}

}  // namespace

bool has_hdf5_magic(std::span<const std::byte> head) {
  for (std::size_t at = 0; at + kMagic.size() <= head.size();
       at = at == 0 ? kFirstUserBlock : 2 * at) {
    if (std::memcmp(head.data() + at, kMagic.data(), kMagic.size()) == 0) return true;
  }
  return false;
}

std::unique_ptr<LabelVolume> open_hdf5(std::unique_ptr<ByteSource> source,
                                       const OpenOptions& options) {
  Hdf5Description description = describe_hdf5(*source, options.dataset);
  const std::string file = source->name();
  const Hdf5Axes axes = find_axes(description, file);
  VolumeInfo info{
      .shape = shape_of(description, axes, file), .type = description.type, .format = "hdf5"};
  info.space = placed(file, hdf5_space(description, info.shape, file), options);
  if (description.layout == Hdf5Layout::kChunked) {
    return open_chunks(std::move(source), std::move(info), std::move(description), axes,
                       options.cache_bytes);
  }
  info.z_fastest = is_z_fastest(description, axes, file);
  return open_run(std::move(source), std::move(info), description);
}

}  // namespace mw::io
