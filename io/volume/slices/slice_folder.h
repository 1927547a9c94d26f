// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a folder of slices, TIFF or PNG files in the order that people mean, as a volume.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/volume/open_options.h"

namespace mw::io {

/// Whether name a comes before b: digits in a row count as one number, and names that differ in
/// leading zeros only are in the order of their bytes.  A strict total order.
[[nodiscard]] bool comes_before(std::string_view a, std::string_view b);

/// A place where numbered names miss one: b follows a by another step than the least one between
/// two names.
struct NumberGap {
  std::string a;
  std::string b;
};

/// Returns the first gap.  REQUIRES: names in natural order.
/// ENSURES: empty when the names differ in more than one number or in other letters, so that
/// nothing can be said.
[[nodiscard]] std::optional<NumberGap> find_gap(const std::vector<std::string>& names);

/// Whether the folder holds a file that ends in .tif, .tiff or .png; hidden files do not count.
[[nodiscard]] bool is_slice_folder(const std::filesystem::path& folder);

/// Opens all these files as slices, in natural order; files of other names are not looked at.
/// REQUIRES: is_slice_folder(folder).
/// ERRORS: mw::Error(kInput) naming the file that is not like the first, or behind which one is
/// missing; or both when there are TIFF and PNG files.
[[nodiscard]] std::unique_ptr<LabelVolume> open_slice_folder(const std::filesystem::path& folder,
                                                             const OpenOptions& options);

}  // namespace mw::io
