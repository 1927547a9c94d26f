// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which files may be replaced without asking: those that this program wrote.
#include "engine/cli/options/own_files.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/file/source/file_source.h"
#include "io/volume/npy/open_npy.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

namespace fs = std::filesystem;

/// A file of ours has one of these near its beginning or its end: the record of its run or the
/// program's name, or words of the formats, the first lines of the tables and the names of the
/// figures that have no place for it.
constexpr std::array<std::string_view, 14> kMarks{"mwmesh",
                                                  "Name=\"label\" format=\"appended\" offset=\"",
                                                  io::kOwnNpyStart,
                                                  "$MeshFormat\n",
                                                  "\nTetrahedra of ",
                                                  "placeholders: one for each label",
                                                  "id,number,name,r,g,b,a\n",
                                                  "number,name,side,first,second\n",
                                                  "material,set,from,to,mean,tets,volume\n",
                                                  "node,image_of,x,y,z\n",
                                                  "** a node on a high face moves as its partner",
                                                  "march,x,y,z,start_s,end_s,cpu_s,slot",
                                                  "\"peak_rss_bytes\": ",
                                                  "\"voxels_changed\": "};

/// Returns what a file begins and ends with; nothing where it cannot be read.
std::string ends_of(const fs::path& path) {
  constexpr std::uint64_t kBytes = 1 << 16;
  try {
    const io::FileSource file(path);
    const std::size_t size = std::min(file.size(), kBytes);
    std::string out(2 * size, '\0');
    const auto bytes = std::as_writable_bytes(std::span(out));
    file.read_at(0, bytes.first(size));
    file.read_at(file.size() - size, bytes.last(size));
    return out;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return {};
  }
}

}  // namespace

bool is_filled(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && fs::file_size(path, ignored) > 0;
}

bool is_foreign(const fs::path& path) {
  if (!is_filled(path)) return false;
  const std::string ends = ends_of(path);
  return std::none_of(kMarks.begin(), kMarks.end(),
                      [&](std::string_view mark) { return ends.find(mark) != ends.npos; });
}

}  // namespace mw::cli
