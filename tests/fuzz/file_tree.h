// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A folder of files out of one run of bytes, for formats that are more than one file.
#pragma once

#include "tests/fuzz/target.h"
#include "tests/temp_folder.h"

namespace mw::fuzz {

/// Each file begins with a line "@@ PATH", up to the next such line or the end; the line end in
/// front of that belongs to it.  Files of odd names are left out, so that nothing is written
/// outside the folder.  The folder goes away with the object.
class FileTree {
 public:
  explicit FileTree(Bytes bytes);

  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

 private:
  void add(std::string_view name, std::string_view content) const;

  test::TempFolder folder_;
};

}  // namespace mw::fuzz
