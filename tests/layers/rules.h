// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which file may include what.
#pragma once

#include "tests/testing.h"

namespace mw::layers {

/// One #include line: the name between the quotes or angle brackets.
struct Include {
  std::string name;
  bool quoted = false;

  friend bool operator==(const Include&, const Include&) = default;
};

/// The include lines of a file's text.
[[nodiscard]] std::vector<Include> includes_of(const std::string& text);

/// Why the file (its path from the root of the sources) may not include this; nothing if it may.
[[nodiscard]] std::optional<std::string> why_forbidden(const std::string& file,
                                                       const Include& include);

}  // namespace mw::layers
