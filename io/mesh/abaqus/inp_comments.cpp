// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Comments that our .inp files have, and other tools skip.
#include "io/mesh/abaqus/inp_comments.h"

#include "io/mesh/medit/medit_names.h"

namespace mw::io {
namespace {

constexpr std::string_view kMark = "**";

}  // namespace

std::string inp_comment(const LabelName& row, bool is_signed) {
  constexpr std::size_t kMaxBytes = 256;
  std::string line = medit_comment(row, is_signed);
  line.replace(0, 1, kMark);
  line.pop_back();
  return line.size() > kMaxBytes ? std::string() : line;
}

std::optional<LabelName> parse_inp_comment(std::string_view line) {
  if (!line.starts_with(kMark)) return std::nullopt;
  return parse_medit_comment(line.substr(kMark.size()));
}

}  // namespace mw::io
