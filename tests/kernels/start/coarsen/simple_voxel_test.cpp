// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Flips that the test allows, made in whole small volumes: no Betti number changes.
#include "kernels/start/coarsen/simple_voxel.h"

#include <bit>

#include "tests/kernels/mesh/dense_mesh.h"
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

Neighbourhood around(const SmallVolume& volume, Index3 v) {
  const Index3 one{1, 1, 1};
  Neighbourhood out;
  const LabelBox box = labels_in(volume, {v - one, v + Index3{2, 2, 2}});
  std::copy(box.labels.begin(), box.labels.end(), out.begin());
  return out;
}

Index3 random_voxel(std::mt19937& random, Index3 shape) {
  const auto x = below(random, static_cast<std::uint32_t>(shape.x));
  const auto y = below(random, static_cast<std::uint32_t>(shape.y));
  return {x, y, below(random, static_cast<std::uint32_t>(shape.z))};
}

/// Giving voxel v the label `to`.
struct Flip {
  Index3 v;
  Label from = 0;
  Label to = 0;
  bool allowed = false;
  bool between_others = false;  ///< a third label is around
};

/// The label of a voxel nearby, at random; none when that is the present one, or the exterior.
std::optional<Flip> random_flip(std::mt19937& random, const SmallVolume& volume, Index3 v) {
  const Neighbourhood labels = around(volume, v);
  const Label from = labels[kSelf], to = labels[below(random, 27)];
  if (to == from || to == kExterior) return std::nullopt;
  const bool others = std::any_of(labels.begin(), labels.end(),
                                  [&](Label l) { return l != from && l != to && l != kExterior; });
  return Flip{v, from, to, relabel_keeps_topology(labels, to), others};
}

bool keeps_betti_numbers(const SmallVolume& volume, const Flip& flip) {
  SmallVolume after = volume;
  after.labels[static_cast<std::size_t>(Box3{{0, 0, 0}, volume.shape}.offset(flip.v))] = flip.to;
  return betti(after) == betti(volume);
}

TEST(Promise1Topology, FlipsOfVoxelsKeepEveryRegionOfEveryLabel) {
  std::mt19937 random(1011);
  constexpr std::array<VolumeKind, 4> kKinds{VolumeKind::kNoise, VolumeKind::kBlobs,
                                             VolumeKind::kSponge, VolumeKind::kBlobs};
  int allowed = 0, between_others = 0;
  for (std::uint32_t i = 0; i < 30000 && !HasFailure(); ++i) {
    const std::uint32_t min = i % 8 == 0 ? 4 : 3;
    const Index3 shape = random_shape(random, min, min + 1);
    const SmallVolume volume = random_volume_of(random, kKinds[i % 4], shape, 2 + below(random, 5));
    const auto flip = random_flip(random, volume, random_voxel(random, volume.shape));
    if (!flip || !flip->allowed) continue;
    EXPECT_TRUE(keeps_betti_numbers(volume, *flip)) << volume.text() << " to " << flip->to;
    ++allowed;
    between_others += flip->between_others ? 1 : 0;
  }
  EXPECT_GT(allowed, 1000);
  EXPECT_GT(between_others, 500);
}

/// Two labels, the middle of 3^3 voxels: the test is nearly exact.
TEST(SimpleVoxel, RefusesLittleThatWouldKeepTopology) {
  std::mt19937 random(1012);
  int allowed = 0, refused = 0, refused_in_vain = 0;
  for (int i = 0; i < 2400 && !HasFailure(); ++i) {
    const std::uint32_t ones = 1 + below(random, 9);
    const SmallVolume volume = volume_from(
        {3, 3, 3}, 2, [&](auto, auto, auto) { return below(random, 10) < ones ? 1 : 0; });
    const auto flip = random_flip(random, volume, {1, 1, 1});
    if (!flip) continue;
    const bool unchanged = keeps_betti_numbers(volume, *flip);
    if (flip->allowed) {
      EXPECT_TRUE(unchanged);
      ++allowed;
    } else {
      ++refused;
      refused_in_vain += unchanged ? 1 : 0;
    }
  }
  RecordProperty("allowed", allowed);
  RecordProperty("refused", refused);
  RecordProperty("refused_in_vain", refused_in_vain);
  EXPECT_GT(allowed, 80);
  EXPECT_LT(refused_in_vain, refused / 50);
}

}  // namespace
}  // namespace mw::test
