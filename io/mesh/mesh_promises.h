// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the run that made a mesh promised of it.
#pragma once

#include <optional>

namespace mw::io {

/// Settings of the run that `verify` asks about: what is checked later is what was promised.
struct MeshPromises {
  std::optional<double> max_distance;  ///< voxels of the lattice; empty: no bound
  double quality_floor = 0;            ///< radius ratio
  bool interfaces = false;             ///< --topology interfaces
  bool smooth = true;                  ///< --surface smooth: thick slices were cut into layers
  bool optimised = true;               ///< not --optimizer none

  friend bool operator==(const MeshPromises&, const MeshPromises&) = default;
};

}  // namespace mw::io
