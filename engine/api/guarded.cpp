// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Errors of the engine as those of the library.
#include "engine/api/guarded.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "engine/settings/setting_table.h"
#include "io/file/errors.h"

namespace mw::api {
namespace {

bool is_letter(char c) {
  return std::islower(static_cast<unsigned char>(c)) != 0;
}

/// Returns whether the library has a setting or an option of this name, or a member that stands for
/// it.  Other flags are those of commands that a message tells.
bool is_of_library(std::string_view flag) {
  constexpr std::string_view kOptions[] = {
      "background",  "cache",       "certify",   "changed", "cohesive", "crop",    "dataset",
      "deck",        "drop-specks", "element",   "force",   "frame",    "from",    "keep",
      "keep-bytes",  "labels",      "materials", "memory",  "merge",    "names",   "object",
      "open-hinges", "origin",      "overlap",   "pairs",   "parts",    "preset",  "report",
      "resume",      "sample",      "scale",     "spacing", "split",    "threads", "values",
      "trust-paths", "use-form",    "weld",      "workdir"};
  const auto& settings = engine::setting_table();
  return std::ranges::find(kOptions, flag) != std::end(kOptions) ||
         std::ranges::find(settings, flag, &engine::Setting::name) != settings.end();
}

mwmesh::ErrorKind kind_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kInternal:
      return mwmesh::ErrorKind::kInternal;
    case ErrorKind::kUsage:
      return mwmesh::ErrorKind::kUsage;
    case ErrorKind::kInput:
      return mwmesh::ErrorKind::kInput;
    case ErrorKind::kResource:
      return mwmesh::ErrorKind::kResource;
    case ErrorKind::kCheckFailed:
      return mwmesh::ErrorKind::kCheckFailed;
  }
  return mwmesh::ErrorKind::kInternal;
}

}  // namespace

std::string library_words(std::string message) {
  for (std::size_t at = message.find("--"); at != message.npos; at = message.find("--", at)) {
    const std::size_t end = static_cast<std::size_t>(
        std::find_if(message.begin() + static_cast<std::ptrdiff_t>(at) + 2, message.end(),
                     [](char c) { return !is_letter(c) && c != '-'; }) -
        message.begin());
    const bool starts_word = at == 0 || message[at - 1] == ' ' || message[at - 1] == '(';
    if (!starts_word || !is_of_library(std::string_view(message).substr(at + 2, end - at - 2))) {
      at += 2;
      continue;
    }
    std::replace(message.begin() + static_cast<std::ptrdiff_t>(at) + 2,
                 message.begin() + static_cast<std::ptrdiff_t>(end), '-', '_');
    message.erase(at, 2);
    if (std::string_view(message).substr(at, end - at - 2) != "from") continue;
    message.insert(end - 2, "_kept");
  }
  return message;
}

const std::filesystem::path& checked_path(const std::filesystem::path& path, const char* name) {
  if (path.native().find('\0') == path.native().npos) return path;
  io::fail_usage(std::string(name) + " " + path.c_str() + ": has a zero byte in it");
}

mwmesh::Error library_error(const Error& error) {
  return {kind_of(error.kind()), library_words(error.what())};
}

}  // namespace mw::api
