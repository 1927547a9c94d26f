// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the topology of a mesh promises (P1).
#pragma once

namespace mw {

enum class KeptTopology {
  kLabels,      ///< the closed and the open region of every label
  kInterfaces,  ///< also the places where labels meet, and every pairwise interface
};

}  // namespace mw
