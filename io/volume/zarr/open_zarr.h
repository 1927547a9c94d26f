// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an array or a multiscale image of a Zarr store as a volume, looked for among the groups and
// arrays of the store.
// Format: https://zarr-specs.readthedocs.io/en/latest/v3/core/index.html
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/json/json.h"
#include "io/store/place.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// What is in a folder, with its metadata read but not looked at.
struct ZarrNode {
  Place folder;
  int version = 2;
  bool is_array = false;
  Json metadata;  ///< an array's .zarray or zarr.json
  /// Always an object.  Attributes of arrays of version 2 are not read: they hold nothing that is
  /// used here, and NaN, which some writers put there, is no JSON.
  Json attributes;
  std::string metadata_file;  ///< what errors about the two name
  std::string attributes_file;
};

/// Whether there is metadata of a group or an array.
[[nodiscard]] bool is_zarr_node(const Place& folder);

/// Reads the node in a folder, by version 3 where both versions have metadata there.  Attributes
/// without other metadata make a group.
/// ENSURES: empty when the folder is no node.
/// ERRORS: mw::Error(kInput) naming the file when metadata are damaged.
[[nodiscard]] std::optional<ZarrNode> read_zarr_node(const Place& folder);

/// Returns a folder of the store, whether it exists or not.  "" and "." are the store itself, and
/// so is "/" in front of a path.
/// ENSURES: empty for a path that leads out of the store.
[[nodiscard]] std::optional<Place> path_in_store(const Place& folder, std::string_view path);

/// Returns the paths, below the group, of arrays and of multiscale images (whose levels are not
/// named): sorted, the first 100, at most 5 groups deep.
/// ENSURES: empty where the store cannot list its folders.
/// ERRORS: mw::Error(kInput) when metadata on the way are damaged.
[[nodiscard]] std::vector<std::string> volumes_below(const Place& group);

/// Returns the labels of a multiscale image, as --dataset wants them: "labels/cells".  There are
/// none where their metadata are damaged.
[[nodiscard]] std::vector<std::string> labels_of_image(const Place& group);

/// Returns "a, b, c", and "..." behind the first 20.
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

/// Whether the folder is a node of a store, or its name ends in .zarr.
[[nodiscard]] bool is_zarr(const Place& folder);

/// Opens the node that options.dataset names below the folder, or the folder itself: an array, a
/// multiscale image of OME-NGFF, or a group with only one of them below it.  options.scale is the
/// level of an image.  Axes are z, y, x unless the metadata name them; levels of images are placed
/// by their transformations, also when they are opened as arrays.
/// ERRORS: mw::Error(kInput) naming file and field; kUsage when there is no such dataset or scale.
[[nodiscard]] std::unique_ptr<LabelVolume> open_zarr(const Place& folder,
                                                     const OpenOptions& options);

/// Returns how many levels the image at the folder, or at options.dataset in it, has; 1 for what is
/// no image.  ERRORS: mw::Error(kInput) when its metadata are damaged.
[[nodiscard]] std::size_t count_zarr_scales(const Place& folder, const OpenOptions& options);

/// Opens a store in a ZIP archive, at its top or in the only folder there, as open_zarr() does.
/// ERRORS: also mw::Error(kInput) naming an archive that is damaged or holds no store.
[[nodiscard]] std::unique_ptr<LabelVolume> open_zarr_zip(std::unique_ptr<ByteSource> archive,
                                                         const OpenOptions& options);

/// Returns what count_zarr_scales() does.  ERRORS: also those of open_zarr_zip().
[[nodiscard]] std::size_t count_zarr_zip_scales(std::unique_ptr<ByteSource> archive,
                                                const OpenOptions& options);

}  // namespace mw::io
