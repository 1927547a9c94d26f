// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which version of mwmesh this is.
#include "engine/version.h"

namespace mw::engine {

const char* version() {
  return MW_VERSION;
}

}  // namespace mw::engine
