// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the array that is meant and its place, and makes a chunked volume of it.
#include "io/volume/zarr/open_zarr.h"

#include <algorithm>

#include "io/chunks/chunked_volume.h"
#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/zarr/multiscale.h"
#include "io/volume/zarr/zarr_array.h"

namespace mw::io {
namespace {

/// A level of a multiscale image.
struct Level {
  Multiscale multiscale;
  std::size_t number = 0;
  std::string file;                 ///< where the multiscale is
  std::vector<std::string> labels;  ///< those of the image
};

/// Returns what to do about a further axis, or an image that is not one of labels.
std::string way_out_of_image(const std::vector<std::string>& labels) {
  if (labels.empty()) return "store one channel and one time as an array of its own";
  return "its labels are images of their own: --dataset " + listed(labels);
}

/// Whether chunks are in nested folders, one for each axis; where folders cannot be seen, the first
/// chunk tells.
bool has_nested_chunks(const ZarrNode& node, const ZarrArray& array) {
  if (const auto is_folder = (node.folder / "0").is_folder()) return *is_folder;
  if (array.shape.size() < 2) return false;
  Place first = node.folder;
  for (std::size_t axis = 0; axis < array.shape.size(); ++axis) first = first / "0";
  return first.is_document();
}

ZarrArray parse_array(const ZarrNode& node) {
  if (node.version == 3) return parse_zarr_v3(node.metadata, node.metadata_file);
  ZarrArray array = parse_zarr_v2(node.metadata, node.metadata_file);
  // Early writers of OME-NGFF left the separator out; "." would find no chunk and read fill values.
  if (!node.metadata.contains("dimension_separator") && has_nested_chunks(node, array)) {
    array.keys.separator = '/';
  }
  return array;
}

std::vector<std::string> axis_names(const ZarrNode& node, const ZarrArray& array,
                                    const Level* level) {
  if (level == nullptr || level->multiscale.axis_names.empty()) return array.axis_names;
  const std::size_t count = level->multiscale.axis_names.size();
  if (count != array.shape.size()) {
    fail_input(level->file, "axes",
               text("has ", count, " axes, and ", node.metadata_file, " ", array.shape.size()),
               "the store is damaged");
  }
  return level->multiscale.axis_names;
}

VolumeSpace space_of_array(const ZarrNode& node, const AxisMap& axes, const Level* level,
                           const OpenOptions& options) {
  if (level == nullptr) return placed(node.metadata_file, {.is_sized = false}, options);
  Multiscale multiscale = level->multiscale;
  if (options.spacing) multiscale.axis_units.clear();  // they do not matter then
  const FileSpace space = space_of(multiscale, multiscale.levels[level->number], axes, level->file);
  return placed(level->file, space, options);
}

/// Opens an array; level is that of the image that it belongs to, or null.
std::unique_ptr<LabelVolume> open_array(const ZarrNode& node, const Level* level,
                                        const OpenOptions& options) {
  const ZarrArray array = parse_array(node);
  const std::vector<std::string> labels =
      level != nullptr ? level->labels : std::vector<std::string>{};
  const AxisMap axes = map_axes(node.metadata_file, array.shape, axis_names(node, array, level),
                                way_out_of_image(labels));
  if (is_float(array.type) && !labels.empty()) {
    fail_input(node.metadata_file, "data type", text(name(array.type), ": an image, not labels"),
               way_out_of_image(labels));
  }
  const Index3 extents = axes.pick(array.shape, 1);
  const Index3 shape =
      checked_shape(node.metadata_file, "shape", {extents.x, extents.y, extents.z});
  VolumeInfo info{.shape = shape, .type = array.type, .format = "zarr"};
  info.is_far = !node.folder.is_near();
  info.chunk = axes.pick(array.chunk.shape, 1);
  info.space = space_of_array(node, axes, level, options);
  info.offset = number_of_first_voxel([&] {
    return OwnPlace{space_of_array(node, axes, level, {}), true};
  });
  const VoxelCoding coding{.type = array.type, .order = array.chunk.byte_order};
  return std::make_unique<ChunkedVolume>(std::move(info), coding, array.fill,
                                         zarr_chunks(node.folder, array, axes),
                                         options.cache_bytes);
}

std::size_t level_number(const Multiscale& multiscale, const std::string& file,
                         const OpenOptions& options) {
  const int number = options.scale.value_or(0);
  const std::size_t count = multiscale.levels.size();
  if (number >= 0 && static_cast<std::size_t>(number) < count) {
    return static_cast<std::size_t>(number);
  }
  fail_usage("--scale ", number, ": ", file, " has ", count, " scales, 0 (the finest) to ",
             count - 1);
}

std::unique_ptr<LabelVolume> open_image(const ZarrNode& group, const OpenOptions& options) {
  Level level{.multiscale = parse_multiscale(group.attributes, group.attributes_file),
              .file = group.attributes_file};
  level.number = level_number(level.multiscale, level.file, options);
  // A user who names a dataset knows what it is.
  if (options.dataset.empty()) level.labels = labels_of_image(group.folder);
  const std::string& path = level.multiscale.levels[level.number].path;
  const auto folder = path_in_store(group.folder, path);
  const auto node = folder ? read_zarr_node(*folder) : std::nullopt;
  if (!node || !node->is_array) {
    fail_input(level.file, text("datasets[", level.number, "].path"),
               text("'", path.substr(0, 100), "' is no array of the store"),
               "get a whole copy of the store");
  }
  return open_array(*node, &level, options);
}

/// Returns which level an array is when its parent is a multiscale image that has it.
std::optional<Level> level_of(const ZarrNode& array) {
  const auto above = array.folder.parent();
  if (!above) return std::nullopt;
  const auto parent = read_zarr_node(above->first);
  if (!parent || parent->is_array || !has_multiscale(parent->attributes)) return std::nullopt;
  Level level{.multiscale = parse_multiscale(parent->attributes, parent->attributes_file),
              .file = parent->attributes_file};
  const auto& levels = level.multiscale.levels;
  const auto found = std::find_if(levels.begin(), levels.end(), [&](const MultiscaleLevel& one) {
    return one.path == above->second;
  });
  if (found == levels.end()) return std::nullopt;
  level.number = static_cast<std::size_t>(found - levels.begin());
  return level;
}

std::unique_ptr<LabelVolume> open_lone_array(const ZarrNode& node, const OpenOptions& options) {
  if (options.scale.value_or(0) != 0) {
    fail_usage("--scale ", *options.scale, ": ", node.folder.string(),
               " is one array, without levels");
  }
  const std::optional<Level> level = level_of(node);
  return open_array(node, level ? &*level : nullptr, options);
}

std::unique_ptr<LabelVolume> open_node(const ZarrNode& node, const OpenOptions& options) {
  if (node.is_array) return open_lone_array(node, options);
  if (has_multiscale(node.attributes)) return open_image(node, options);
  const std::vector<std::string> volumes = volumes_below(node.folder);
  if (!node.folder.folders()) {
    fail_input(node.folder.string(), {}, "is a group, and a server does not list what is in it",
               "name the array with --dataset, or give its own address");
  }
  if (volumes.empty()) {
    fail_input(node.folder.string(), {}, "the group has no array below it",
               "get a whole copy of the store");
  }
  if (volumes.size() > 1) {
    fail_input(node.folder.string(), {}, "the group has several volumes: " + listed(volumes),
               "choose one with --dataset");
  }
  return open_node(*read_zarr_node(node.folder / volumes[0]), options);
}

std::string contents(const Place& folder) {
  if (!folder.folders()) return "what the server does not list";
  const std::vector<std::string> names = volumes_below(folder);
  return names.empty() ? "no volume below it" : listed(names);
}

}  // namespace

bool is_zarr(const Place& folder) {
  return is_zarr_node(folder) || std::filesystem::path(folder.string()).extension() == ".zarr";
}

std::unique_ptr<LabelVolume> open_zarr(const Place& folder, const OpenOptions& options) {
  const auto path = path_in_store(folder, options.dataset);
  const auto node = path ? read_zarr_node(*path) : std::nullopt;
  if (node) return open_node(*node, options);
  if (options.dataset.empty()) {
    fail_input(folder.string(), {}, "no metadata of Zarr in it (zarr.json, .zarray, .zgroup)",
               folder.refusal_or("get a whole copy of the store"));
  }
  fail_usage("--dataset ", options.dataset, ": ", folder.string(), " has none of this name; ",
             folder.refusal_or("it has " + contents(folder)));
}

std::size_t count_zarr_scales(const Place& folder, const OpenOptions& options) {
  const auto path = path_in_store(folder, options.dataset);
  auto node = path ? read_zarr_node(*path) : std::nullopt;
  while (node && !node->is_array && !has_multiscale(node->attributes)) {
    const std::vector<std::string> volumes = volumes_below(node->folder);
    if (volumes.size() != 1) return 1;
    node = read_zarr_node(node->folder / volumes[0]);
  }
  if (!node || node->is_array) return 1;
  return parse_multiscale(node->attributes, node->attributes_file).levels.size();
}

}  // namespace mw::io
