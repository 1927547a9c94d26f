// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The files of a MetaImage volume whose slices are files of their own.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mw::io {

/// Whether a value of ElementDataFile names many files: "LIST", or a pattern with %.
[[nodiscard]] bool names_many_files(std::string_view data_file);

/// Names of `count` files, first slice first: the lines behind the header for "LIST", else those of
/// "PATTERN FIRST LAST STEP" (FIRST 1 and STEP 1 where they are missing), where PATTERN has one %d,
/// which may have a width, as in %03d.
/// ERRORS: mw::Error(kInput) naming the file and its field.
[[nodiscard]] std::vector<std::string> slice_names(std::string_view data_file,
                                                   std::string_view behind_header,
                                                   std::int64_t count, std::string_view file);

}  // namespace mw::io
