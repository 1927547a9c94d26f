// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sets of cells on the surface of a cube, by tables.
#include "kernels/start/coarsen/simple_voxel.h"

#include <array>
#include <bit>

namespace mw {
namespace {

struct Tables {
  std::array<NeighbourSet, 27> covered{};   ///< cells that a neighbour shares with the voxel
  std::array<NeighbourSet, 27> incident{};  ///< cells on a cell's boundary or around it
  std::array<NeighbourSet, 3> of_dimension{};
};

constexpr std::array<int, 3> offset(unsigned i) {
  const int n = static_cast<int>(i);
  return {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
}

/// True when the closed cell (or neighbour) towards a contains the cell towards b.
constexpr bool contains(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a[k] != 0 && a[k] != b[k]) return false;
  }
  return true;
}

constexpr Tables make_tables() {
  Tables t;
  for (unsigned i = 0; i < 27; ++i) {
    if (i == kSelf) continue;
    const auto a = offset(i);
    const int dimension = (a[0] == 0 ? 1 : 0) + (a[1] == 0 ? 1 : 0) + (a[2] == 0 ? 1 : 0);
    t.of_dimension[static_cast<std::size_t>(dimension)] |= NeighbourSet{1} << i;
    for (unsigned j = 0; j < 27; ++j) {
      if (j == kSelf) continue;
      const NeighbourSet bit = NeighbourSet{1} << j;
      if (contains(a, offset(j))) t.covered[i] |= bit;
      if (contains(a, offset(j)) || contains(offset(j), a)) t.incident[i] |= bit;
    }
  }
  return t;
}

constexpr Tables kTables = make_tables();

NeighbourSet unite(NeighbourSet members, const std::array<NeighbourSet, 27>& table) {
  NeighbourSet out = 0;
  for (; members != 0; members &= members - 1) {
    out |= table[static_cast<std::size_t>(std::countr_zero(members))];
  }
  return out;
}

bool is_connected(NeighbourSet cells) {
  NeighbourSet seen = cells & ~(cells - 1);
  for (NeighbourSet front = seen; front != 0;) {
    front = unite(front, kTables.incident) & cells & ~seen;
    seen |= front;
  }
  return seen == cells;
}

bool is_simple(NeighbourSet neighbours) {
  return is_contractible(covered_cells(neighbours)) &&
         is_contractible(covered_cells(kAllNeighbours & ~neighbours));
}

}  // namespace

NeighbourSet covered_cells(NeighbourSet neighbours) {
  return unite(neighbours, kTables.covered);
}

bool is_contractible(NeighbourSet cells) {
  const auto count = [cells](std::size_t dimension) {
    return std::popcount(cells & kTables.of_dimension[dimension]);
  };
  return count(0) - count(1) + count(2) == 1 && is_connected(cells);
}

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
