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

/// Checks the place that a caller gives instead of that of the file.
/// ERRORS: mw::Error(kUsage) unless spacing is finite and positive, and origin finite.
void check_place(const std::optional<Vector3>& spacing, const std::optional<Vector3>& origin);

/// Opens a path, or the address of a remote volume (io/remote/address.h).  The content of a file
/// tells its format, else its extension does, whether it is gzipped or not; a folder or a remote
/// volume tells it by what is in it.  With options.raw the format is raw.  The numbers of the
/// options are checked like the file's.
/// ERRORS: mw::Error(kInput) naming file, field, reason and way out; kResource when a gzipped file
/// does not fit into $TMPDIR, or a server does not answer; kUsage when the options make no sense,
/// also those that the format does not have, such as --scale of a file without scales.
[[nodiscard]] std::unique_ptr<LabelVolume> open_volume(const std::filesystem::path& path,
                                                       const OpenOptions& options = {});

/// One of the scales that OpenOptions::scale chooses from.
struct VolumeScale {
  int number = 0;
  VolumeInfo info;
};

/// The scales of a volume, the finest first, from its metadata alone.  There are none where its
/// format has none, or where options.dataset chooses one already (the key of a precomputed volume).
/// Scales that cannot be opened, as in a partial copy of the volume, are left out.
/// ERRORS: those of open_volume().
[[nodiscard]] std::vector<VolumeScale> scales_of(const std::filesystem::path& path,
                                                 const OpenOptions& options);

}  // namespace mw::io
