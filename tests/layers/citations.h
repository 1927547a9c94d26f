// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What comments and documents say of other files: that it is there.
#pragma once

#include "tests/testing.h"

namespace mw::layers {

/// A document that a text names, `kernels/README.md`, maybe with the title of a section behind it:
/// `kernels/README.md, "Words"`.
struct Citation {
  std::string file;
  std::string section;  ///< empty: none is named

  friend bool operator==(const Citation&, const Citation&) = default;
};

/// The documents that a source names, lines of a comment being one text.
[[nodiscard]] std::vector<Citation> citations_of(const std::string& source);

/// The titles of a Markdown document's sections.
[[nodiscard]] std::vector<std::string> titles_of(const std::string& document);

/// What stands between backquotes and has the look of a path from the root of the sources.
[[nodiscard]] std::vector<std::string> paths_in(const std::string& document);

/// What stands between backquotes and has the look of a test's name, `Suite.Name`.
[[nodiscard]] std::vector<std::string> tests_in(const std::string& document);

}  // namespace mw::layers
