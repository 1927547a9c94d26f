// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The march with many threads, on a oneTBB flow graph.
#pragma once

#include "engine/march/march.h"
#include "engine/system/crew.h"

namespace mw::engine {

/// Does what march() does, by this crew, always through the graph.  REQUIRES: order.size() >= 1.
/// Memory: that of the wavefront, and for each thread two messages and one admission.
void flow_march(const WindowOrder& order, const VisitWindow& visit, const MarchOptions& options,
                Crew& crew);

}  // namespace mw::engine
