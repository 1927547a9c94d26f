// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tries places one by one; engine/install/folders.cmake says which folders a prefix has.
#include "engine/codt/find_worker.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "io/file/errors.h"

namespace mw::engine::codt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "mwmesh-codt";

bool can_be_run(const fs::path& program) {
  std::error_code ignored;
  return fs::is_regular_file(program, ignored) && ::access(program.c_str(), X_OK) == 0;
}

/// Returns `folder` without `tail` at its end: "/opt/mw/lib" and "lib" give "/opt/mw/".
std::optional<fs::path> prefix_of(const fs::path& folder, const std::string& tail) {
  const std::string text = folder.string();
  if (tail.empty() || !text.ends_with("/" + tail)) return std::nullopt;
  return fs::path(text.substr(0, text.size() - tail.size()));
}

/// Returns an empty path when the system gives no absolute one: a name that was found by PATH does
/// not say where the file is.
fs::path object_of_this_code() {
  Dl_info info{};
  std::error_code ignored;
  if (::dladdr(reinterpret_cast<const void*>(&find_worker), &info) == 0) return {};
  if (!fs::path(info.dli_fname).is_absolute()) return {};
  const fs::path object = fs::canonical(info.dli_fname, ignored);
  return ignored ? fs::path() : object;
}

}  // namespace

WorkerHost this_host() {
  std::error_code ignored;  // without /proc the program is not known
  return {.program = fs::read_symlink("/proc/self/exe", ignored), .object = object_of_this_code()};
}

std::vector<fs::path> worker_paths(const WorkerHost& host) {
  std::vector<fs::path> positions;
  if (!host.program.empty()) positions.push_back(host.program.parent_path() / kProgram);
  const fs::path folder = host.object.parent_path();
  if (!folder.empty()) positions.push_back(folder / kProgram);
  const auto prefix = prefix_of(folder, MW_INSTALLED_LIBRARY);
  if (prefix) positions.push_back(*prefix / MW_INSTALLED_PROGRAMS / kProgram);
  positions.push_back(fs::path(MW_INSTALL_PREFIX) / MW_INSTALLED_PROGRAMS / kProgram);
  return positions;
}

fs::path find_worker() {
  const char* const wanted = std::getenv(kWorkerVariable);  // NOLINT(concurrency-mt-unsafe)
  const auto positions =
      wanted != nullptr ? std::vector<fs::path>{wanted} : worker_paths(this_host());
  for (const fs::path& program : positions) {
    if (can_be_run(program)) return program;
  }
  io::fail_usage("--optimizer tetgen: there is no program " + positions.front().string() +
                 "; it is built with -DMW_WITH_TETGEN=ON, and MW_CODT_WORKER names another place");
}

}  // namespace mw::engine::codt
