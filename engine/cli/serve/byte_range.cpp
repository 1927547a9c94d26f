// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The part of a file that a request asks for.
#include "engine/cli/serve/byte_range.h"

#include <algorithm>

#include "engine/settings/number_text.h"

namespace mw::cli {

std::optional<ByteRange> asked_range(std::string_view header, std::uint64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  const std::size_t dash = header.find('-');
  if (!header.starts_with(kUnit) || dash == header.npos) return std::nullopt;
  const std::string_view first = header.substr(kUnit.size(), dash - kUnit.size());
  const std::string_view last = header.substr(dash + 1);
  std::uint64_t from = 0, to = 0;
  if (!last.empty() && !engine::read_all(last, to)) return std::nullopt;
  if (first.empty()) {
    if (last.empty()) return std::nullopt;
    return ByteRange{size - std::min(to, size), size};
  }
  if (!engine::read_all(first, from)) return std::nullopt;
  if (!last.empty() && to < from) return std::nullopt;
  const std::uint64_t end = last.empty() || to >= size ? size : to + 1;
  return ByteRange{std::min(from, end), end};
}

}  // namespace mw::cli
