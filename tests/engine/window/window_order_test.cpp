// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Both orders by brute force: windows that share a block are ordered, and nothing else is claimed.
#include "engine/window/window_order.h"
#include "engine/march/march.h"
#include "tests/engine/march/grids.h"
#include "tests/engine/march/watched_march.h"

namespace mw::engine {
namespace {

using namespace test;

/// Both orders of every grid of up to 5 x 5 x 4 windows.
template <typename Check>
void for_small_orders(Check check) {
  for_each_index(Index3{5, 5, 4}, [&](Index3 i) {
    const Index3 windows = i + Index3{1, 1, 1};
    for (Order order : kOrders) {
      SCOPED_TRACE(::testing::Message() << windows.x << " x " << windows.y << " x " << windows.z
                                        << (order == Order::kRaster ? " raster" : " colour"));
      check(WindowOrder(grid_of(windows), order));
    }
  });
}

std::set<std::size_t> block_places(const WindowGrid& grid, Index3 window) {
  std::set<std::size_t> out;
  for (Index3 b : grid.blocks_of(window)) out.insert(raster(b, grid.blocks()));
  return out;
}

/// Windows that share a block, the later in sequence after the earlier.
Relation by_blocks(const WindowOrder& order) {
  std::vector<std::set<std::size_t>> blocks;
  for (std::uint64_t w = 0; w < order.size(); ++w) {
    blocks.push_back(block_places(order.grid(), order.window(w)));
  }
  Relation out(order.size(), std::vector<bool>(order.size(), false));
  for (std::size_t w = 0; w < out.size(); ++w) {
    for (std::size_t v = 0; v < w; ++v) {
      out[w][v] = std::any_of(blocks[w].begin(), blocks[w].end(),
                              [&](std::size_t b) { return blocks[v].count(b) > 0; });
    }
  }
  return out;
}

TEST(WindowOrder, SequenceVisitsEveryWindowOnce) {
  for_small_orders([](const WindowOrder& order) {
    std::set<std::size_t> seen;
    for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
      const Index3 w = order.window(rank);
      ASSERT_TRUE((Box3{{0, 0, 0}, order.grid().windows()}.contains(w)));
      EXPECT_EQ(order.rank(w), rank);
      seen.insert(raster(w, order.grid().windows()));
    }
    EXPECT_EQ(seen.size(), order.size());
  });
}

TEST(WindowOrder, RasterSequenceIsThePapers) {
  const WindowOrder order(grid_of({4, 3, 2}), Order::kRaster);
  std::uint64_t rank = 0;
  for_each_index(Index3{4, 3, 2}, [&](Index3 w) { EXPECT_EQ(order.rank(w), rank++); });
}

/// Edges follow the sequence, hence have no circle.
TEST(WindowOrder, EdgesFollowTheSequence) {
  for_small_orders([](const WindowOrder& order) {
    std::set<std::pair<std::uint64_t, std::uint64_t>> backward, forward;
    for (std::uint64_t w = 0; w < order.size(); ++w) {
      for (Index3 p : order.predecessors(order.window(w))) {
        EXPECT_LT(order.rank(p), w);
        EXPECT_TRUE(backward.emplace(order.rank(p), w).second);
      }
      for (Index3 s : order.successors(order.window(w))) {
        EXPECT_TRUE(forward.emplace(w, order.rank(s)).second);
      }
    }
    EXPECT_TRUE(forward == backward);
  });
}

/// Paths exist where blocks are shared, directly or through others, and nowhere else.
TEST(WindowOrder, PathsAreThoseOfSharedBlocks) {
  for_small_orders([](const WindowOrder& order) {
    EXPECT_TRUE(transitive_closure(by_edges(order)) == transitive_closure(by_blocks(order)));
  });
}

/// Earlier and later neighbours are the windows that share a block with this one and come before
/// and after it.
TEST(WindowOrder, NeighboursAreThoseOfLowerAndHigherRank) {
  for_small_orders([](const WindowOrder& order) {
    const Relation shares = by_blocks(order);
    const auto ranks = [&](const std::vector<Index3>& windows) {
      std::multiset<std::uint64_t> out;
      for (Index3 v : windows) out.insert(order.rank(v));
      return out;
    };
    for (std::uint64_t w = 0; w < order.size(); ++w) {
      std::multiset<std::uint64_t> earlier, later;
      for (std::uint64_t v = 0; v < order.size(); ++v) {
        if (v < w && shares[w][v]) earlier.insert(v);
        if (v > w && shares[v][w]) later.insert(v);
      }
      EXPECT_EQ(ranks(order.earlier_neighbours(order.window(w))), earlier);
      EXPECT_EQ(ranks(order.later_neighbours(order.window(w))), later);
    }
  });
}

/// step() is the longest path to a window, steps() - 1 - step() the longest from it.
TEST(WindowOrder, StepsAreLongestPaths) {
  for_small_orders([](const WindowOrder& order) {
    const Relation before = by_edges(order);
    std::vector<std::int64_t> to(order.size(), 0), from(order.size(), 0);
    for (std::size_t w = 0; w < to.size(); ++w) {
      for (std::size_t v = 0; v < w; ++v) {
        if (before[w][v]) to[w] = std::max(to[w], to[v] + 1);
      }
    }
    for (std::size_t w = from.size(); w-- > 0;) {
      for (std::size_t v = 0; v < w; ++v) {
        if (before[w][v]) from[v] = std::max(from[v], from[w] + 1);
      }
    }
    EXPECT_EQ(order.steps(), 1 + *std::max_element(to.begin(), to.end()));
    for (std::size_t w = 0; w < to.size(); ++w) {
      EXPECT_EQ(order.step(order.window(w)), to[w]);
      EXPECT_EQ(order.steps() - 1 - order.step(order.window(w)), from[w]);
    }
  });
}

TEST(ColourOrder, HasEightStepsAtAnySize) {
  for (const Index3 windows : {Index3{2, 2, 2}, {4, 4, 4}, {101, 57, 88}}) {
    EXPECT_EQ(WindowOrder(grid_of(windows), Order::kColour).steps(), 8);
  }
  EXPECT_EQ(WindowOrder(grid_of({9, 1, 1}), Order::kColour).steps(), 2);
  EXPECT_EQ(WindowOrder(grid_of({1, 1, 1}), Order::kColour).steps(), 1);
}

/// Layers of blocks between their first and their last use in sequence, at the worst moment.
std::size_t layers_in_use(const WindowOrder& order) {
  std::map<std::int64_t, std::uint64_t> first, last;
  for (std::uint64_t w = 0; w < order.size(); ++w) {
    for (Index3 b : order.grid().blocks_of(order.window(w))) {
      first.emplace(b.z, w);
      last[b.z] = w;
    }
  }
  std::size_t max = 0;
  for (std::uint64_t w = 0; w < order.size(); ++w) {
    std::size_t open = 0;
    for (const auto& [z, begin] : first) open += begin <= w && w <= last[z] ? 1U : 0U;
    max = std::max(max, open);
  }
  return max;
}

TEST(ColourOrder, KeepsThreeLayersOfBlocksInUse) {
  EXPECT_EQ(layers_in_use(WindowOrder(grid_of({5, 4, 20}), Order::kColour)), 3U);
  EXPECT_EQ(layers_in_use(WindowOrder(grid_of({5, 4, 20}), Order::kRaster)), 2U);
}

// What stops a march, and what it then throws.

struct Failure {
  std::uint64_t rank;
};

/// The rank that march() throws; nothing when it does not throw.
std::optional<std::uint64_t> thrown_rank(const WindowOrder& order, const VisitWindow& visit,
                                         const MarchOptions& options) {
  try {
    march(order, visit, options);
  } catch (const Failure& failure) {
    return failure.rank;
  }
  return std::nullopt;
}

/// The march knows of a failure when it lets the window's admission go.  Until then others may
/// start, as many as the failing thread's pause leaves time for.
TEST(MarchErrors, StopsWhenAVisitThrows) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    RandomDelay delay(425, 300);
    Watch watch(order);
    bool known = false;
    const AdmitWindow admit = [&](Index3 w) -> Admission {
      EXPECT_FALSE(known);
      if (order.rank(w) != 11) return std::make_shared<int>(0);
      return {&known, [](void* k) { *static_cast<bool*>(k) = true; }};
    };
    const VisitWindow visit = [&](Index3 w) {
      watch.begin(w);
      delay();
      if (order.rank(w) == 11) throw Failure{11};
      watch.end(w);
    };
    EXPECT_EQ(thrown_rank(order, visit, {.threads = threads, .admit = admit}), 11U);
    EXPECT_TRUE(known);
    EXPECT_EQ(watch.finished() + 1, watch.started()) << "those that were running ended";
  });
}

/// All of the first colour's eight windows throw at once; the earliest in sequence is thrown on.
TEST(MarchErrors, ThrowsTheEarliestOfSeveralErrors) {
  const WindowOrder order(grid_of({4, 4, 4}), Order::kColour);
  for (int repeat = 0; repeat < 10; ++repeat) {
    Meeting meeting(8);
    const VisitWindow visit = [&](Index3 w) {
      EXPECT_TRUE(meeting.come());
      throw Failure{order.rank(w)};
    };
    EXPECT_EQ(thrown_rank(order, visit, {.threads = 8}), 0U);
  }
}

TEST(MarchErrors, StopsWhenTheListenerThrows) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    Watch watch(order);
    std::uint64_t told = 0;
    const VisitWindow visit = [&](Index3 w) {
      watch.begin(w);
      watch.end(w);
    };
    const OnVisited stop = [&](const Visited&) {
      if (++told == 5) throw Failure{99};
    };
    EXPECT_EQ(thrown_rank(order, visit, {.threads = threads, .visited = stop}), 99U);
    EXPECT_EQ(told, 5U) << "told after it threw";
    EXPECT_LT(watch.started(), 5U + static_cast<std::uint64_t>(threads));
    EXPECT_EQ(watch.finished(), watch.started());
  });
}

TEST(MarchErrors, StopsWhenAdmissionThrows) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    Watch watch(order);
    const VisitWindow visit = [&](Index3 w) {
      watch.begin(w);
      watch.end(w);
    };
    const AdmitWindow admit = [&](Index3 w) -> Admission {
      if (order.rank(w) == 7) throw Failure{7};
      return std::make_shared<int>(0);
    };
    EXPECT_EQ(thrown_rank(order, visit, {.threads = threads, .admit = admit}), 7U);
    EXPECT_EQ(watch.finished(), watch.started());
    EXPECT_LT(watch.started(), order.size());
  });
}

}  // namespace
}  // namespace mw::engine
