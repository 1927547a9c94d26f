// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an array of an N5 container, looked for where the caller did not name it.
#pragma once

#include <memory>
#include <optional>

#include "io/store/place.h"
#include "io/volume/n5/n5_array.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Returns the folder of the array: options.dataset in the container, or the only array or pyramid
/// that there is; in a pyramid (a group with s0, s1, ...) the level options.scale.
/// ERRORS: mw::Error(kInput) when there is none or several, with their names; kUsage when the
/// options name one that is not there.
[[nodiscard]] Place find_n5_array(const Place& container, const OpenOptions& options);

/// Returns the number of a level by the name of its folder, "s2"; nothing for other names.
[[nodiscard]] std::optional<std::size_t> level_of(const Place& folder);

/// Whether the folder has an attributes.json, levels of a pyramid, or a name with .n5.
[[nodiscard]] bool is_n5(const Place& folder);

/// Opens an array (find_n5_array) at its place (n5_space).  Blocks are raw or packed by gzip, zlib,
/// bzip2, xz, lz4, blosc or zstd; what is not there has label 0.
/// ERRORS: mw::Error(kInput) naming file and field; kUsage when there is no such dataset or level.
[[nodiscard]] std::unique_ptr<LabelVolume> open_n5(const Place& folder, const OpenOptions& options);

/// Returns how many levels the pyramid has that open_n5() looks at; 1 for an array.
/// ERRORS: those of find_n5_array().
[[nodiscard]] std::size_t count_n5_scales(const Place& container, const OpenOptions& options);

}  // namespace mw::io
