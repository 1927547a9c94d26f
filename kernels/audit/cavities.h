// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What interfaces enclose.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "kernels/audit/junctions.h"
#include "kernels/audit/part_graph.h"

namespace mw::audit {

/// Cavities (b2) by pair of labels, for all pairs with an interface.
using Cavities = std::map<JunctionLabels, std::int64_t>;

/// By Alexander duality in the 3-sphere: the components of the part graph without the pairs of
/// parts that bear these two labels, less one.  Cost: as components_leaving_out().
[[nodiscard]] Cavities cavities_of_interfaces(std::span<const Label> part_class,
                                              const std::vector<PartPair>& face_pairs);

}  // namespace mw::audit
