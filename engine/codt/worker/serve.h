// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The worker's side of the protocol of wire.h.
#pragma once

#include "kernels/odt/triangulation.h"

namespace mw::engine::codt {

/// Answers orders on kControlDescriptor until the engine is gone.  If the engine breaks the
/// protocol, the worker dies.
void serve(const Triangulate& triangulate);

}  // namespace mw::engine::codt
