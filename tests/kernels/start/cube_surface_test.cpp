// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every closed set of cells on a cube's surface, against boundary ranks over GF(2).
#include "kernels/start/cube_surface.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <map>
#include <set>

#include "tests/oracle/cell_complex.h"
#include "tests/oracle/small_volumes.h"

namespace mw::test {
namespace {

using audit::test::CellComplex;

std::array<int, 3> towards(unsigned i) {
  return {static_cast<int>(i % 3) - 1, static_cast<int>(i / 3 % 3) - 1,
          static_cast<int>(i / 9) - 1};
}

std::size_t dimension(unsigned i) {
  std::size_t zeros = 0;
  for (int c : towards(i)) zeros += c == 0 ? 1U : 0U;
  return zeros;
}

/// By geometry: the voxel is [-1, 1]^3, the cell's centre c, and the neighbour [2d - 1, 2d + 1].
bool shares(unsigned neighbour, unsigned cell) {
  const auto d = towards(neighbour), c = towards(cell);
  for (std::size_t k = 0; k < 3; ++k) {
    if (c[k] < 2 * d[k] - 1 || c[k] > 2 * d[k] + 1) return false;
  }
  return true;
}

NeighbourSet bit(unsigned i) {
  return NeighbourSet{1} << i;
}

TEST(CubeSurface, CellsAreThoseThatNeighboursShare) {
  std::mt19937 random(1001);
  for (int trial = 0; trial < 2000; ++trial) {
    const NeighbourSet neighbours =
        (trial < 27 ? bit(static_cast<unsigned>(trial)) : static_cast<NeighbourSet>(random())) &
        kAllNeighbours;
    NeighbourSet expected = 0;
    for (unsigned i = 0; i < 27; ++i) {
      for (unsigned cell = 0; cell < 27; ++cell) {
        if ((neighbours & bit(i)) != 0 && cell != kSelf && shares(i, cell)) expected |= bit(cell);
      }
    }
    ASSERT_EQ(covered_cells(neighbours), expected);
  }
}

/// The surface as a complex; a set of its cells is what bears label 1.
class Surface {
 public:
  Surface() {
    for (std::size_t d = 0; d < 3; ++d) {
      for (unsigned i = 0; i < 27; ++i) {
        if (i != kSelf && dimension(i) == d) add(i, d);
      }
    }
  }

  bool is_contractible(NeighbourSet cells) {
    for (const auto& [i, id] : ids_) complex_.set_label(id, (cells & bit(i)) != 0 ? 1 : 0);
    const audit::Betti betti = complex_.closed(1);
    // Without holes of any dimension; on a sphere that is enough.
    return betti == audit::Betti{1, 0, 0};
  }

 private:
  void add(unsigned i, std::size_t d) {
    std::vector<std::size_t> boundary;
    for (const auto& [face, id] : ids_) {
      if (dimension(face) + 1 == d && shares(i, face)) boundary.push_back(id);
    }
    ids_[i] = complex_.add(d, boundary);
  }

  CellComplex complex_;
  std::map<unsigned, std::size_t> ids_;
};

/// Calls visit for each subset of the bits.
template <typename Visit>
void each_subset(NeighbourSet bits, Visit visit) {
  NeighbourSet subset = 0;
  do {
    visit(subset);
    subset = (subset - bits) & bits;
  } while (subset != 0);
}

/// Any faces, any edges that those leave, any corners that both leave: each closed set once.
TEST(CubeSurface, ContractibleSetsAreThoseWithoutHomology) {
  std::array<NeighbourSet, 3> of_dimension{};
  for (unsigned i = 0; i < 27; ++i) {
    if (i != kSelf) of_dimension[dimension(i)] |= bit(i);
  }
  Surface surface;
  std::set<NeighbourSet> seen;
  int contractible = 0;
  each_subset(of_dimension[2], [&](NeighbourSet faces) {
    const NeighbourSet free_edges = of_dimension[1] & ~covered_cells(faces);
    each_subset(free_edges, [&](NeighbourSet edges) {
      const NeighbourSet free_corners = of_dimension[0] & ~covered_cells(faces | edges);
      each_subset(free_corners, [&](NeighbourSet corners) {
        const NeighbourSet cells = covered_cells(faces | edges | corners);
        ASSERT_TRUE(seen.insert(cells).second);
        const bool expected = surface.is_contractible(cells);
        ASSERT_EQ(is_contractible(cells), expected) << cells;
        contractible += expected ? 1 : 0;
      });
    });
  });
  EXPECT_GT(seen.size(), 10000U);
  EXPECT_GT(contractible, 1000);
}

}  // namespace
}  // namespace mw::test
