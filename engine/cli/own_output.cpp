// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cli/own_output.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>

#include "kernels/core/error.h"

namespace mw::cli {
namespace {

namespace fs = std::filesystem;

/// What one of these has, a mesh of ours has near its beginning or its end: the record of its run,
/// and words of the formats that have no place for it.
constexpr std::array<std::string_view, 4> kMarks{"mwmesh", "$MeshFormat\n", "\nTetrahedra of ",
                                                 "placeholders: one for each label"};

std::string ends_of(const fs::path& path) {
  constexpr std::streamoff kBytes = 1 << 16;
  std::ifstream file(path, std::ios::binary);
  std::string out(2 * kBytes, '\0');
  file.read(out.data(), kBytes);
  if (!file) return out;
  file.seekg(-kBytes, std::ios::end);
  file.read(out.data() + kBytes, kBytes);
  return out;
}

}  // namespace

void require_own_output(const fs::path& output) {
  std::error_code ignored;
  if (!fs::is_regular_file(output, ignored) || fs::file_size(output, ignored) == 0) return;
  const std::string ends = ends_of(output);
  const bool is_ours = std::any_of(kMarks.begin(), kMarks.end(), [&](std::string_view mark) {
    return ends.find(mark) != ends.npos;
  });
  if (is_ours) return;
  throw Error(ErrorKind::kUsage,
              "-o " + output.string() + ": is there, and no mesh of mwmesh; --force replaces it");
}

}  // namespace mw::cli
