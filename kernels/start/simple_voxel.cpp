// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Four sets on the surface of a cube.
#include "kernels/start/simple_voxel.h"

namespace mw {
namespace {

bool is_simple(NeighbourSet neighbours) {
  return is_contractible(covered_cells(neighbours)) &&
         is_contractible(covered_cells(kAllNeighbours & ~neighbours));
}

}  // namespace

bool relabel_keeps_topology(const Neighbourhood& labels, Label to) {
  const Label from = labels[kSelf];
  NeighbourSet old_label = 0, new_label = 0;
  for (unsigned i = 0; i < 27; ++i) {
    old_label |= (labels[i] == from ? NeighbourSet{1} : NeighbourSet{0}) << i;
    new_label |= (labels[i] == to ? NeighbourSet{1} : NeighbourSet{0}) << i;
  }
  return is_simple(old_label & kAllNeighbours) && is_simple(new_label);
}

}  // namespace mw
