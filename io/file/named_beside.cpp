// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files that a header names.
#include "io/file/named_beside.h"

#include <algorithm>

#include "io/file/errors.h"

namespace mw::io {

std::filesystem::path named_beside(const std::filesystem::path& header, std::string_view field,
                                   std::string_view name) {
  const std::filesystem::path relative(name);
  const bool climbs = std::find(relative.begin(), relative.end(), "..") != relative.end();
  if (name.empty() || name.find('\0') != std::string_view::npos || relative.is_absolute() ||
      climbs) {
    fail_input(header.string(), field, text("'", name, "' leads out of the header's folder"),
               "put the file beside the header and name it without a path");
  }
  std::filesystem::path path = header.parent_path() / relative;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    fail_input(header.string(), field, text(path.string(), " is missing or not a file"),
               "put it where the header says, relative to the header");
  }
  return path;
}

}  // namespace mw::io
