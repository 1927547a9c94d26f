// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How this library words its errors.
#include "io/file/errors.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace mw::io {

void fail_input(std::string_view file, std::string_view field, std::string_view reason,
                std::string_view way_out) {
  std::string message(file);
  if (!field.empty()) message.append(": ").append(field);
  message.append(": ").append(reason);
  if (!way_out.empty()) message.append("; ").append(way_out);
  throw Error(ErrorKind::kInput, message);
}

void fail_output(std::string_view path, std::string_view action, int error_number) {
  const std::string reason = std::generic_category().message(error_number);
  const std::string start = std::string(path) + ": cannot " + std::string(action) + ": " + reason;
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      throw Error(ErrorKind::kResource, start + "; free some space there or write elsewhere");
    case EACCES:
    case EPERM:
    case ENOENT:
    case ENOTDIR:
    case EISDIR:
    case EROFS:
    case ENAMETOOLONG:
    case ELOOP:
    case EINVAL:
      fail_usage(start + "; give a path in an existing, writable folder");
    case EMFILE:
    case ENFILE:
      throw Error(ErrorKind::kResource, start + "; raise ulimit -n");
    default:
      throw Error(ErrorKind::kResource, start + "; check the disk and its limits");
  }
}

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

}  // namespace mw::io
