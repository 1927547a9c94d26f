// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parses JSON, and says in which file it is broken.
#include "io/json/json_file.h"

#include <nlohmann/json.hpp>

#include "io/file/errors.h"
#include "io/file/file_source.h"

namespace mw::io {
namespace {

/// The library's words without its name and number in front: "[json.exception...] ".
std::string_view reason_of(const nlohmann::json::exception& error) {
  const std::string_view what = error.what();
  const std::size_t end = what.find("] ");
  return end == what.npos ? what : what.substr(end + 2);
}

}  // namespace

nlohmann::json parse_json(std::string_view text, std::string_view file) {
  const auto check_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth <= kMaxJsonDepth) return true;
    fail_input(file, "JSON", mw::io::text("nested deeper than ", kMaxJsonDepth, " levels"),
               "the file is damaged");
  };
  try {
    return nlohmann::json::parse(text, check_depth);
  } catch (const nlohmann::json::exception& error) {
    fail_input(file, "JSON", reason_of(error), "the file is damaged or not JSON");
  }
}

nlohmann::json read_json(const std::filesystem::path& path) {
  const FileSource source(path);
  const std::optional<std::string> content = read_whole(source, kMaxJsonBytes);
  if (!content) {
    fail_input(source.name(), "JSON",
               text("the file has ", source.size(), " bytes, and at most ", kMaxJsonBytes,
                    " are read of a description"),
               "check that it is the store's own");
  }
  return parse_json(*content, source.name());
}

}  // namespace mw::io
