// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads what labels are called from a file (--names).
#pragma once

#include <filesystem>
#include <string_view>

#include "io/names/label_names.h"

namespace mw::io {

/// Largest file of names, unpacked.
inline constexpr std::uint64_t kMaxNamesBytes = 64 << 20;

/// By the first line that is no comment: label descriptions of ITK-SNAP and colour tables of
/// FreeSurfer and Slicer (colour_table.h), else values separated by commas, semicolons or tabs
/// (csv_names.h).  May be gzipped.
/// ERRORS: mw::Error(kInput) naming file and line; also for a file without labels, above
/// kMaxNamesBytes, or not of text.
[[nodiscard]] LabelNames read_names(const std::filesystem::path& path);

/// The same of text; `file` is what errors call it.
[[nodiscard]] LabelNames parse_names(std::string_view text, std::string_view file);

}  // namespace mw::io
