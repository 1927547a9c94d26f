// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How users ask for materials by ranges of a value.
#include "engine/settings/material_text.h"

#include <algorithm>

#include "engine/settings/number_text.h"
#include "io/file/errors.h"

namespace mw::engine {

io::MaterialRule parse_materials(std::string_view text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::size_t colon = std::min(text.find(':', equals), text.size());
  const std::size_t second = std::min(text.find(':', colon + 1), text.size());
  if (equals == text.size() || (colon < text.size() && second == text.size())) {
    io::fail_usage("expected NAME=N or NAME=N:LO:HI, got '", text, "'");
  }
  const std::int64_t count = parse_integer(text.substr(equals + 1, colon - equals - 1));
  if (count < 1 || count > io::kMostMaterials) {
    io::fail_usage("expected 1 to ", io::kMostMaterials, " materials");
  }
  io::MaterialRule out{.values = std::string(text.substr(0, equals)),
                       .count = static_cast<std::uint32_t>(count)};
  if (colon == text.size()) return out;
  out.range = {parse_number(text.substr(colon + 1, second - colon - 1)),
               parse_number(text.substr(second + 1))};
  if ((*out.range)[0] < (*out.range)[1]) return out;
  io::fail_usage("the first value of a range is below the last");
}

}  // namespace mw::engine
