// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The one error after which nobody should go on from a work folder.
#pragma once

#include "kernels/core/error.h"

namespace mw::engine {

/// What was stored is not what comes back: "PLACE: corrupt: REASON", exit code of bad input.  Who
/// knows the work folder adds the way out (run.cpp).
class DamagedWork : public Error {
 public:
  DamagedWork(const std::string& where, const std::string& reason)
      : Error(ErrorKind::kInput, where + ": corrupt: " + reason) {}
};

}  // namespace mw::engine
