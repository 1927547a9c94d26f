// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/system/file_failure.h"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

namespace mw::engine {
namespace {

bool is_about_path(const std::error_code& code) {
  constexpr std::array kReasons{
      std::errc::permission_denied,         std::errc::operation_not_permitted,
      std::errc::no_such_file_or_directory, std::errc::not_a_directory,
      std::errc::filename_too_long,         std::errc::too_many_symbolic_link_levels};
  return std::any_of(kReasons.begin(), kReasons.end(),
                     [&](std::errc reason) { return code == reason; });
}

}  // namespace

Error file_failure(const std::filesystem::filesystem_error& failure) {
  // A relative path has no name here when the working folder itself is gone.
  std::string name = failure.path1().string();
  if (name.empty()) name = "the working folder";
  const bool is_input = is_about_path(failure.code());
  return {is_input ? ErrorKind::kInput : ErrorKind::kResource,
          name + ": " + failure.code().message() +
              (is_input ? "; check the path, and who may look at it" : "; check the disk")};
}

}  // namespace mw::engine
