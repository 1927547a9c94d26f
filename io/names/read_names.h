// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads what labels are called from a file (--names).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/names/label_names.h"

namespace mw::io {

/// The most bytes of a file of names, unpacked.
inline constexpr std::uint64_t kMaxNamesBytes = 64 << 20;

/// Reads label descriptions of ITK-SNAP and colour tables of FreeSurfer and Slicer
/// (colour_table.h), values separated by commas, semicolons or tabs (csv_names.h), or objects of
/// JSON (json_names.h).  The first line that is no comment decides which.  The file may be gzipped.
/// Text that is not in UTF-8 is read as Latin-1, which `note` then says.
/// ERRORS: mw::Error(kInput) naming file and line; also for a file without labels, above
/// kMaxNamesBytes, or not of text.
[[nodiscard]] LabelNames read_names(const std::filesystem::path& path, std::string* note = nullptr);

/// Reads names from text, which errors call `file`.
[[nodiscard]] LabelNames parse_names(std::string_view text, std::string_view file,
                                     std::string* note = nullptr);

}  // namespace mw::io
