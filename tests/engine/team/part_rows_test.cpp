// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rows that several processes find out together are those of VertexRows, which knows all blocks.
#include "engine/team/output/part_rows.h"

#include "tests/engine/output/scattered.h"

namespace mw::engine {
namespace {

using audit::test::below;
using namespace test;

/// Lines dealt out at random, or in runs, as bricks of rows are.
std::vector<std::uint32_t> random_owners(std::mt19937& random, Index3 blocks, std::uint32_t ranks) {
  std::vector<std::uint32_t> out(static_cast<std::size_t>(blocks.y * blocks.z));
  const bool in_runs = below(random, 2) == 0;
  std::uint32_t owner = below(random, ranks);
  for (std::uint32_t& o : out) {
    if (!in_runs || below(random, 4) == 0) owner = below(random, ranks);
    o = owner;
  }
  return out;
}

/// All ranks of one process, and their messages.
class Ranks {
 public:
  Ranks(const Scattered& scattered, const std::vector<std::uint32_t>& owners, std::uint32_t count)
      : scattered_(scattered), count_(count) {
    for (std::uint32_t rank = 0; rank < count; ++rank) {
      shares_.emplace_back(scattered.grid.blocks(), owners, rank);
    }
    claim();
    make_parts();
  }

  /// Each one's list for each other, the other way round.
  template <typename List>
  static std::vector<std::vector<List>> swapped(const std::vector<std::vector<List>>& sent) {
    std::vector<std::vector<List>> out(sent.size());
    for (std::size_t to = 0; to < sent.size(); ++to) {
      for (const auto& lists : sent) out[to].push_back(lists[to]);
    }
    return out;
  }

  void number() {
    for (std::uint32_t r = 0; r < count_; ++r) {
      for_each_block(r, [&](Index3 b) { parts_[r]->count(b, scattered_.at(b)); });
    }
    send(&PartRows::firsts, &PartRows::take_firsts);
    place();
    send(&PartRows::given_rows, &PartRows::take_given_rows);
    send(&PartRows::found_rows, &PartRows::take_found_rows);
  }

  template <typename Visit>
  void for_each_block(std::uint32_t rank, Visit visit) const {
    for_each_own_block(
        shares_[rank], [](std::size_t) {}, visit);
  }

  [[nodiscard]] PartRows& part(std::uint32_t rank) { return *parts_[rank]; }
  [[nodiscard]] const std::vector<std::vector<std::vector<Claim>>>& claims() const {
    return claims_;
  }
  [[nodiscard]] const LineShare& share(std::uint32_t rank) const { return shares_[rank]; }
  [[nodiscard]] std::uint64_t rows() const { return rows_; }

 private:
  void claim() {
    for (std::uint32_t r = 0; r < count_; ++r) {
      uses_.emplace_back(scattered_.grid);
      Claims claims(shares_[r], uses_[r], {});
      for_each_block(r, [&](Index3 b) {
        uses_[r].add(b, uses_[r].lines_of(scattered_.at(b)));
        claims.add(b, scattered_.at(b));
      });
      claims_.push_back(claims.take(count_));
    }
  }

  void make_parts() {
    const auto theirs = swapped(claims_);
    for (std::uint32_t r = 0; r < count_; ++r) {
      parts_.push_back(std::make_unique<PartRows>(shares_[r], uses_[r], claims_[r], theirs[r]));
    }
  }

  template <typename Say, typename Take>
  void send(Say say, Take take) {
    std::vector<ClaimLists> sent;
    for (auto& part : parts_) sent.push_back(((*part).*say)());
    const auto came = swapped(sent);
    for (std::uint32_t r = 0; r < count_; ++r) ((*parts_[r]).*take)(came[r]);
  }

  void place() {
    std::vector<std::vector<std::uint64_t>> counts, first_rows(count_);
    for (auto& part : parts_) counts.push_back(part->new_vertices());
    std::vector<std::size_t> next(count_);
    for (std::size_t line = 0; line < shares_[0].lines(); ++line) {
      const std::uint32_t owner = shares_[0].owner(line);
      first_rows[owner].push_back(rows_);
      rows_ += counts[owner].at(next[owner]++);
    }
    for (std::uint32_t r = 0; r < count_; ++r) parts_[r]->place(first_rows[r]);
  }

  const Scattered& scattered_;
  std::uint32_t count_;
  std::vector<LineShare> shares_;
  std::vector<VertexUses> uses_;
  std::vector<std::vector<std::vector<Claim>>> claims_;
  std::vector<std::unique_ptr<PartRows>> parts_;
  std::uint64_t rows_ = 0;
};

/// By block: rows, and which of them are new.
struct Expected {
  std::vector<std::vector<std::uint64_t>> rows;
  std::vector<std::vector<std::size_t>> added;
  std::uint64_t count = 0;
};

Expected rows_of_one_process(const Scattered& scattered) {
  VertexRows rows(uses_of(scattered));
  Expected out;
  for_each_index(scattered.grid.blocks(), [&](Index3 b) {
    const std::uint64_t first_new = rows.count();
    out.rows.push_back(rows.assign(b, scattered.at(b)));
    std::vector<std::size_t>& added = out.added.emplace_back();
    for (std::size_t v = 0; v < out.rows.back().size(); ++v) {
      if (out.rows.back()[v] >= first_new) added.push_back(v);
    }
  });
  out.count = rows.count();
  return out;
}

TEST(PartRows, AreTheRowsOfOneProcess) {
  std::mt19937 random(531);
  std::size_t foreign = 0;
  for (std::uint32_t i = 0; i < 600 && !HasFailure(); ++i) {
    const Scattered scattered =
        scatter_vertices(random, random_shape(random, 1, 17), i % 5, 1 + i * 3);
    const Expected expected = rows_of_one_process(scattered);
    const std::uint32_t count = 1 + i % 8;
    const Index3 blocks = scattered.grid.blocks();
    Ranks ranks(scattered, random_owners(random, blocks, count), count);
    ranks.number();
    EXPECT_EQ(ranks.rows(), expected.count);
    for (std::uint32_t r = 0; r < count; ++r) {
      ranks.for_each_block(r, [&](Index3 b) {
        const PartRows::Assigned assigned = ranks.part(r).assign(b, scattered.at(b));
        EXPECT_EQ(assigned.rows, expected.rows[raster(b, blocks)]);
        EXPECT_EQ(assigned.added, expected.added[raster(b, blocks)]);
      });
      EXPECT_EQ(ranks.part(r).remembered(), 0U);
      for (const auto& claims : ranks.claims()[r]) foreign += claims.size();
    }
  }
  EXPECT_GT(foreign, 50000U);
}

/// Promise 6, in bricks of rows: what each process remembers and is told falls with their number.
TEST(PartRows, TakeLessOfEachProcessTheMoreThereAre) {
  std::mt19937 random(533);
  const Scattered scattered = scatter_vertices(random, {8, 64, 64}, 1, 40000);
  const Index3 blocks = scattered.grid.blocks();
  std::uint64_t before = kNoRow;
  for (const std::uint32_t side : {2U, 4U, 8U}) {
    std::vector<std::uint32_t> owners;
    for_each_index(Index3{1, blocks.y, blocks.z}, [&](Index3 line) {
      const auto cut = [&](std::int64_t i, std::int64_t count) {
        return static_cast<std::uint32_t>(i * side / count);
      };
      owners.push_back(cut(line.z, blocks.z) * side + cut(line.y, blocks.y));
    });
    Ranks ranks(scattered, owners, side * side);
    ranks.number();
    std::vector<std::uint64_t> told(side * side);
    for (std::uint32_t r = 0; r < side * side; ++r) {
      for (std::uint32_t judge = 0; judge < side * side; ++judge) {
        told[r] += kBytesPerClaim * ranks.claims()[r][judge].size();
        told[judge] += kBytesPerJudged * ranks.claims()[r][judge].size();
      }
    }
    std::uint64_t most = 0;
    for (std::uint32_t r = 0; r < side * side; ++r) {
      std::uint64_t remembered = 0;
      ranks.for_each_block(r, [&](Index3 b) {
        (void)ranks.part(r).assign(b, scattered.at(b));
        remembered = std::max<std::uint64_t>(remembered, ranks.part(r).remembered());
      });
      most = std::max(most, told[r] + 32 * remembered);
    }
    EXPECT_LT(most, before);
    before = most;
  }
}

/// The claims of brute force: every vertex that an own block references, and whose home's line is
/// another's, once, with the first such block.
TEST(Claims, AreThoseOfASet) {
  std::mt19937 random(532);
  for (std::uint32_t i = 0; i < 200 && !HasFailure(); ++i) {
    const Scattered scattered =
        scatter_vertices(random, random_shape(random, 1, 17), i % 4, 1 + i * 5);
    const std::uint32_t count = 1 + i % 5;
    const Index3 blocks = scattered.grid.blocks();
    const Ranks ranks(scattered, random_owners(random, blocks, count), count);
    const VertexUses homes(scattered.grid);
    for (std::uint32_t r = 0; r < count; ++r) {
      std::vector<std::map<std::pair<std::uint64_t, VertexId>, std::uint64_t>> expected(count);
      for_each_index(blocks, [&](Index3 b) {
        if (!ranks.share(r).is_own(homes.line(b))) return;
        for (const BlockVertex& v : scattered.at(b)) {
          const Index3 home = homes.home(v.position);
          const std::uint32_t judge = ranks.share(r).owner(homes.line(home));
          if (judge != r)
            expected[judge].try_emplace({raster(home, blocks), v.id}, raster(b, blocks));
        }
      });
      for (std::uint32_t judge = 0; judge < count; ++judge) {
        std::vector<Claim> list;
        for (const auto& [vertex, first] : expected[judge]) {
          list.push_back({vertex.first, vertex.second, first});
        }
        EXPECT_EQ(ranks.claims()[r][judge], list);
      }
    }
  }
}

}  // namespace
}  // namespace mw::engine
