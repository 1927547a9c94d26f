// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Errors that leave a module: bad input, I/O, budget, corruption.  A refused collapse is no error.
#pragma once

#include <stdexcept>
#include <string>

namespace mw {

/// What went wrong, one value for each documented exit code of the program.
enum class ErrorKind {
  kInternal,     ///< an invariant broke (exit 1)
  kUsage,        ///< command line or configuration (exit 2)
  kInput,        ///< input unreadable or unsupported (exit 3)
  kResource,     ///< disk full, budget too small (exit 4)
  kCheckFailed,  ///< a check of a result failed (exit 5)
};

/// An error with a message that names the thing (file, field, window), the reason and the way out.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace mw
