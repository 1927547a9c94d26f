// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which file may include what.
#include "tests/layers/rules.h"

#include <initializer_list>
#include <regex>

namespace mw::layers {
namespace {

/// Part of a program of its own: TetGen is unsafe among threads, and under the AGPL.
constexpr const char* kTetgenUser = "engine/codt/worker/constrained_delaunay.cpp";

using Names = std::initializer_list<std::string_view>;

bool is_any(const std::string& name, Names names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A name that ends in '/' stands for everything below it.
bool is_below(const std::string& name, Names folders) {
  return std::any_of(folders.begin(), folders.end(), [&](std::string_view folder) {
    return folder.ends_with('/') ? name.starts_with(folder) : name == folder;
  });
}

std::string folder_of(const std::string& path) {
  return path.substr(0, path.rfind('/') + 1);
}

/// <vector>, <cstdint>; not <unistd.h> or <zlib.h>.
bool is_standard(const std::string& name) {
  return name.find_first_of("./") == name.npos;
}

/// Part of a program of its own, for machines that have MPI.
constexpr const char* kMpiUser = "engine/mpi/";

/// JSON for all others; its library is slow to compile.
constexpr const char* kJsonUser = "io/json/json.cpp";

/// What the system offers beside C++.
bool is_posix(const std::string& name) {
  return name.starts_with("sys/") ||
         is_any(name, {"dirent.h", "dlfcn.h", "errno.h", "fcntl.h", "linux/magic.h", "malloc.h",
                       "poll.h", "pthread.h", "signal.h", "spawn.h", "stdlib.h", "unistd.h"});
}

bool touches_files_or_clocks(const std::string& name) {
  return is_any(name, {"chrono", "cstdio", "ctime", "filesystem", "fstream", "iostream"});
}

/// Headers of io that name concrete formats though they lie beside the interfaces.
bool is_concrete_io(const std::string& name) {
  if (is_any(name, {"io/volume/open_volume.h", "io/mesh/open_mesh.h"})) return true;
  const std::string folder = folder_of(name);
  if (folder == "io/mesh/grouped/") return false;  // facets by what they bound, whatever the format
  return (folder.starts_with("io/volume/") && folder != "io/volume/") ||
         (folder.starts_with("io/mesh/") && folder != "io/mesh/") ||
         folder.starts_with("io/surface/");
}

bool kernels_may(const std::string& file, const Include& include) {
  const std::string& name = include.name;
  const bool is_audit = file.starts_with("kernels/audit/");
  if (include.quoted) {
    if (file.starts_with("kernels/core/")) return is_below(name, {"kernels/core/"});
    if (is_audit) return is_below(name, {"kernels/core/", "kernels/audit/"});
    return is_below(name, {"kernels/"}) && !is_below(name, {"kernels/audit/"});
  }
  if (is_audit && is_below(name, {"boost/multiprecision/"})) return true;
  if (is_below(name, {"Eigen/"})) return true;
  if (file == "kernels/core/assert.h" && name == "cstdio") return true;  // its last words
  return is_standard(name) && !touches_files_or_clocks(name);
}

bool io_may(const Include& include) {
  const std::string& name = include.name;
  // Nodes of curved tets are found, tets are cut and surfaces made coarser where a file is written.
  if (include.quoted) {
    return is_below(
        name, {"io/", "kernels/core/", "kernels/curve/", "kernels/decimate/", "kernels/quality/"});
  }
  return is_standard(name) || is_posix(name) ||
         is_below(name, {"blosc.h", "bzlib.h", "curl/", "dcmtk/", "draco/", "hdf5.h", "lz4.h",
                         "lzma.h", "openssl/", "png.h", "pugixml.hpp", "tiffio.h", "zlib.h",
                         "zstd.h", "zstd_errors.h"});
}

/// The processes of one run; only engine/mpi/, whose program starts them, includes it.
constexpr std::string_view kTeam = "engine/team/";

/// A room of the engine, and what it sees of the others.
struct Room {
  std::string_view folder;
  Names sees;
};

const Room kRooms[] = {
    {"engine/system/", {}},
    {"engine/settings/", {}},
    {"engine/codt/", {}},
    {"engine/march/",
     {"engine/settings/", "engine/system/", "engine/window/window_grid.h",
      "engine/window/window_order.h"}},
    // The store keeps blocks for windows, but knows nothing of what a window does.
    {"engine/store/",
     {"engine/settings/", "engine/window/window_order.h", "engine/window/block_store.h",
      "engine/window/other_grid.h", "engine/window/window_grid.h"}},
    {"engine/labels/", {"engine/settings/", "engine/system/"}},
    {"engine/window/", {"engine/settings/", "engine/system/", "engine/labels/"}},
    // Facts about visits by their blocks and labels; knows nothing of what a window does.
    {"engine/keep/",
     {"engine/settings/", "engine/system/", "engine/labels/", "engine/store/",
      "engine/window/window_grid.h"}},
    {"engine/forecast/",
     {"engine/settings/", "engine/labels/", "engine/march/", "engine/store/run_layout.h",
      "engine/window/window_order.h"}},
    {"engine/output/", {"engine/system/", "engine/window/window_grid.h"}},
    // Looks at a finished mesh, and knows no run.
    {"engine/connect/", {"engine/settings/", "engine/system/"}},
    // All that is done to a finished mesh before a file of it is written; it knows no run, either.
    {"engine/finish/",
     {"engine/connect/", "engine/output/label_selection.h", "engine/sample/", "engine/settings/",
      "engine/system/", "engine/verify/"}},
    // Values of tets from images beside the labels.
    {"engine/sample/", {"engine/system/"}},
    {"engine/verify/", {"engine/labels/", "engine/system/"}},
    {"engine/report/",
     {"engine/connect/connect_options.h", "engine/finish/", "engine/labels/voxel_lattice.h",
      "engine/run/run.h", "engine/sample/", "engine/settings/", "engine/system/", "engine/verify/",
      "engine/version.h"}},
    // The run puts the rooms together, and knows no more of other processes than an interface.
    {"engine/run/",
     {"engine/codt/", "engine/forecast/", "engine/keep/", "engine/labels/", "engine/march/",
      "engine/output/", "engine/settings/", "engine/store/", "engine/system/", "engine/window/"}},
    // What implements that interface for many processes; nobody but their program includes it.
    {kTeam,
     {"engine/forecast/", "engine/labels/", "engine/march/", "engine/run/", "engine/settings/",
      "engine/store/", "engine/window/"}},
    // What of a mesh is seen, and from where: commands, pages and the library have it drawn.
    {"engine/picture/", {"engine/report/figures.h"}},
    // The main job as program and library start it.
    {"engine/job/", {"engine/"}},
};

bool room_may(const std::string& file, const std::string& name) {
  for (const Room& room : kRooms) {
    if (!file.starts_with(room.folder)) continue;
    return name.starts_with(room.folder) || is_below(name, room.sees);
  }
  return folder_of(file) == "engine/";
}

bool engine_may(const std::string& file, const Include& include) {
  const std::string& name = include.name;
  if (!include.quoted) {
    return is_standard(name) || is_posix(name) ||
           is_below(name, {"tbb/", "oneapi/", "boost/interprocess/"});
  }
  if (is_below(name, {"engine/cli/", "engine/api/", "engine/request/"}) || is_concrete_io(name))
    return false;
  if (is_below(name, {kTeam}) && !is_below(file, {kTeam})) return false;
  if (is_below(name, {"engine/codt/worker/"}) && !is_below(file, {"engine/codt/worker/"}))
    return false;
  if (name.starts_with("engine/")) return room_may(file, name);
  return is_below(name, {"kernels/", "io/"});
}

bool mpi_may(const Include& include) {
  const std::string& name = include.name;
  if (!include.quoted) return is_standard(name) || is_posix(name) || name == "mpi.h";
  return is_below(name, {"engine/cli/", kTeam, "engine/mpi/", "kernels/core/"});
}

/// One file reads the command line for all commands: the library that does is slow to compile.  One
/// speaks HTTP.
bool cli_may(const std::string& file, const Include& include) {
  if (include.name.starts_with("CLI/")) return file == "engine/cli/command_line.cpp";
  if (include.name == "microhttpd.h") return file == "engine/cli/serve/folder_server.cpp";
  return !include.quoted || (is_below(include.name, {"kernels/", "io/", "engine/"}) &&
                             !is_below(include.name, {"engine/api/", kTeam}));
}

/// Requests and the library know what opens any format, but none by itself.
bool api_may(const Include& include) {
  const std::string& name = include.name;
  if (!include.quoted) return is_standard(name) || is_posix(name);
  if (is_any(name, {"io/volume/open_volume.h", "io/mesh/open_mesh.h"})) return true;
  return is_below(name, {"kernels/", "io/", "engine/"}) && !is_concrete_io(name) &&
         !is_below(name, {"engine/cli/", kTeam});
}

bool may(const std::string& file, const Include& include) {
  if (file.starts_with("kernels/")) return kernels_may(file, include);
  if (file.starts_with("io/")) return io_may(include);
  // What users of the library see: C, and C++ over it.
  if (file == "engine/mwmesh_c.h") return is_any(include.name, {"stddef.h", "stdint.h"});
  if (file == "engine/mwmesh.h") {
    return include.quoted ? include.name == "mwmesh_c.h" : is_standard(include.name);
  }
  // What both are asked: the program by flags and files of options, the library by texts.
  if (file.starts_with("engine/request/")) {
    return api_may(include) && !is_below(include.name, {"engine/api/"});
  }
  if (file.starts_with("engine/api/")) return api_may(include);
  if (file.starts_with("engine/cli/")) return cli_may(file, include);
  if (file.starts_with(kMpiUser)) return mpi_may(include);
  return file.starts_with("engine/") && engine_may(file, include);
}

}  // namespace

std::vector<Include> includes_of(const std::string& text) {
  static const std::regex include(R"(^\s*#\s*include\s*(["<])([^">]+)[">])");
  std::vector<Include> out;
  std::istringstream lines(text);
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_search(line, match, include)) continue;
    out.push_back({.name = match[2], .quoted = match[1] == "\""});
  }
  return out;
}

std::optional<std::string> why_forbidden(const std::string& file, const Include& include) {
  if (include.name == "tetgen.h") {
    if (file == kTetgenUser) return std::nullopt;
    return file + " includes tetgen.h, which only " + kTetgenUser + " may";
  }
  if (include.name.starts_with("nlohmann/")) {
    if (file == kJsonUser) return std::nullopt;
    return file + " includes " + include.name + ", which only " + kJsonUser + " may";
  }
  if (may(file, include)) return std::nullopt;
  return file + " may not include " + include.name;
}

}  // namespace mw::layers
