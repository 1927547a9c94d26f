// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How this library words its errors.
#include "io/file/errors.h"

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
    default:
      throw Error(ErrorKind::kResource, start + "; check the disk and its limits");
  }
}

}  // namespace mw::io
