// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the program asks of a run beside its options.
#pragma once

#include "engine/cli/requests.h"

namespace mw::cli {

/// Fills in what follows from other values, and checks them and the names of files together.
/// ERRORS: mw::Error(kUsage) naming flag and path.
void settle(MeshRequest& request);

}  // namespace mw::cli
