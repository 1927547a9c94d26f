// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a labelled volume of any format that is read here.
#pragma once

#include <filesystem>
#include <vector>

#include "io/volume/open_options.h"

namespace mw::io {

/// The endings of files that are read, as ".npy, .nrrd, .nhdr".
[[nodiscard]] std::string volume_endings();
/// The kinds of folders that are read, as "N5, Zarr".
[[nodiscard]] std::string volume_folders();
/// The formats in which OpenOptions::dataset and OpenOptions::scale choose.
[[nodiscard]] std::string formats_with_datasets();
[[nodiscard]] std::string formats_with_scales();
/// The formats in which OpenOptions::overlap decides.
[[nodiscard]] std::string formats_with_masks();

/// What a caller says of the place, instead of the file.
/// ERRORS: mw::Error(kUsage) unless spacing is finite and positive, and origin finite.
void check_place(const std::optional<Vector3>& spacing, const std::optional<Vector3>& origin);

/// A path, or the address of a remote volume (io/remote/address.h), whose format its metadata tell.
/// Tells the format of a file by content, then by extension, whether it is gzipped or not, and that
/// of a folder by what is in it; raw when options.raw is given.  The numbers of the options are
/// checked like the file's.
/// ERRORS: mw::Error(kInput) naming file, field, reason and way out; kResource when a gzipped
/// file does not fit into $TMPDIR, or a server does not answer; kUsage when the options make no
/// sense, also those that the format does not have: --scale of a file without scales.
[[nodiscard]] std::unique_ptr<LabelVolume> open_volume(const std::filesystem::path& path,
                                                       const OpenOptions& options = {});

/// One of the scales that OpenOptions::scale chooses from.
struct VolumeScale {
  int number = 0;
  VolumeInfo info;
};

/// The scales of a volume, the finest first, from its metadata alone; empty when its format has
/// none, or one of them is chosen already (by options.dataset of a precomputed volume).  Those that
/// a copy of the volume lacks are left out.
/// ERRORS: those of open_volume().
[[nodiscard]] std::vector<VolumeScale> scales_of(const std::filesystem::path& path,
                                                 const OpenOptions& options);

}  // namespace mw::io
