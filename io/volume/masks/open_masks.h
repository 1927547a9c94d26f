// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens files that have one mask each as a volume of labels: a folder of them, or a list.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/volume/open_options.h"

namespace mw::io {

/// Returns what a file with one mask is called: its name without the ending of a volume.
[[nodiscard]] std::string mask_name(const std::filesystem::path& file);

/// Whether the folder holds a NIfTI, NRRD or MetaImage file, whose ending may be in any case;
/// hidden files do not count.
[[nodiscard]] bool is_mask_folder(const std::filesystem::path& folder);

/// Opens all these files, in natural order of their names, as masks; other files are not looked at.
/// REQUIRES: is_mask_folder(folder).  ERRORS: those of open_masks().
[[nodiscard]] std::unique_ptr<LabelVolume> open_mask_folder(const std::filesystem::path& folder,
                                                            const OpenOptions& options);

/// Returns the paths of "A,B,C" where this names no file itself and each of its parts does; none
/// where none of its parts names a file.
/// ERRORS: mw::Error(kInput) naming the first part that is no file where others are.
[[nodiscard]] std::vector<std::filesystem::path> listed_masks(const std::filesystem::path& list);

/// Opens files as masks, each named after its file; see MaskMerger.  options.crop is ignored.
/// ERRORS: mw::Error(kInput) naming the file that is no mask, or lies elsewhere than the others.
[[nodiscard]] std::unique_ptr<LabelVolume> open_masks(
    const std::vector<std::filesystem::path>& files, const std::string& name,
    const OpenOptions& options);

}  // namespace mw::io
