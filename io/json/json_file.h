// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// JSON documents that describe a store, read with bounds.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

namespace mw::io {

/// The largest document that is read.  A parsed one takes up to 32 times its text.
inline constexpr std::uint64_t kMaxJsonBytes = 4ULL << 20U;
/// The deepest nesting that is read.
inline constexpr int kMaxJsonDepth = 64;

/// ERRORS: mw::Error(kInput) naming `file` and the place in it when the text is no JSON, or nested
/// deeper than kMaxJsonDepth.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, std::string_view file);

/// ERRORS: those of parse_json; kInput when the file is missing or larger than kMaxJsonBytes.
[[nodiscard]] nlohmann::json read_json(const std::filesystem::path& path);

}  // namespace mw::io
