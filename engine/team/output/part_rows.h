// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rows of the vertices of one process's blocks, where several write the mesh.
#pragma once

#include <span>
#include <vector>

#include "engine/output/remembered.h"
#include "engine/output/vertex_rows.h"
#include "engine/team/blocks/partition.h"

namespace mw::engine {

/// Says that a process references a vertex.  Blocks are given by raster number.
struct Claim {
  std::uint64_t home = 0;  ///< the block in whose box the vertex lies
  VertexId id = 0;
  std::uint64_t first = 0;  ///< the first of the process's blocks that reference it

  friend bool operator==(const Claim&, const Claim&) = default;
};

[[nodiscard]] inline bool is_before(const Claim& a, std::uint64_t home, VertexId id) {
  return a.home != home ? a.home < home : a.id < id;
}

/// Collects the claims of one process while its blocks are read.
/// Memory: 144 bytes for each vertex that is claimed.
class Claims {
 public:
  /// The references outlive it.
  Claims(const LineShare& share, const VertexUses& homes, HoldMemory hold)
      : share_(share), homes_(homes), hold_(std::move(hold)) {}

  /// Adds the vertices of a block; blocks may come in any order.
  void add(Index3 block, std::span<const BlockVertex> vertices);
  /// Returns the claims by the owner of the home, ascending by home and id, each vertex once.
  [[nodiscard]] std::vector<std::vector<Claim>> take(std::size_t ranks);

 private:
  void make_room(std::size_t more);
  void compact();

  const LineShare& share_;
  const VertexUses& homes_;
  HoldMemory hold_;
  std::vector<Claim> list_;
};

// Rows ascend by the first block that references a vertex, then by id, as VertexRows gives them out
// for all blocks.  Here a process knows only its own blocks, which are whole lines.  It numbers
// their vertices by itself (local rows), and has to learn for which of them the first block is
// another's, and which rows these have.  A vertex that two processes reference is known to its
// judge, the owner of its home line: each other process that references it claims it.
//
//   1  Each process claims.  2  The judge answers which block is the first of all.  Each process
//   then knows how many of its vertices are new in each of its lines, and from the numbers of all
//   lines where its rows begin.  3  The process with the first block tells the judge the row.
//   4  The judge tells the others.

/// A number for each claim: first by rank, then by the place of the claim in that rank's list.
using ClaimLists = std::vector<std::vector<std::uint64_t>>;

/// Stands for a row that is not known, or that this process does not give out.
inline constexpr std::uint64_t kNoRow = ~std::uint64_t{0};

/// The bytes of a claim that is made and of one that is judged, beside VertexRows: the claim, lists
/// of numbers to and from other processes, and these as bytes of messages.
inline constexpr std::uint64_t kBytesPerClaim = 2 * sizeof(Claim) + 8 + 16 + 4 * 8;
inline constexpr std::uint64_t kBytesPerJudged = 2 * sizeof(Claim) + 40 + 8 + 16 + 4 * 8;

/// Sends nothing: the caller carries messages.  Members must be called in the order given here.
/// Memory: kBytesPerClaim and kBytesPerJudged, 24 bytes for each own line, and VertexRows of own
/// blocks.
/// Cost: O(log) a vertex.
class PartRows {
 public:
  /// mine has this process's claims, by the judge's rank; theirs has those that it judges, by the
  /// claimant's rank; uses are those of own blocks.  share outlives it.
  PartRows(const LineShare& share, VertexUses uses, std::vector<std::vector<Claim>> mine,
           const std::vector<std::vector<Claim>>& theirs);

  /// Must be called once for each own block, ascending, with its vertices ascending by id.
  void count(Index3 block, std::span<const BlockVertex> vertices);
  /// Returns for each claim of theirs the first of all blocks that reference the vertex.
  [[nodiscard]] ClaimLists firsts() const;
  /// Takes what the judges' firsts() returned for the claims of this process.
  void take_firsts(const ClaimLists& firsts);
  /// Returns for each own line, ascending, how many vertices have their first block in it.
  [[nodiscard]] std::vector<std::uint64_t> new_vertices() const;
  /// Takes for each own line the row of the first of these vertices.
  void place(std::span<const std::uint64_t> first_rows);
  /// Returns for each claim of this process the row where the first block is own, else kNoRow.
  [[nodiscard]] ClaimLists given_rows() const;
  /// Takes what the other processes' given_rows() returned for the claims that are judged here.
  void take_given_rows(const ClaimLists& rows);
  /// Returns for each claim of theirs the row of the vertex.
  [[nodiscard]] ClaimLists found_rows() const;
  /// Takes what the judges' found_rows() returned for the claims of this process.
  void take_found_rows(const ClaimLists& rows);

  struct Assigned {
    std::vector<std::uint64_t> rows;  ///< rows of the whole mesh, by vertex
    std::vector<std::size_t> added;   ///< vertices whose first block this is
  };
  /// Returns the rows of a block's vertices.  REQUIRES: it is called in the order of count().
  [[nodiscard]] Assigned assign(Index3 block, std::span<const BlockVertex> vertices);

  /// Returns VertexRows::remembered().
  [[nodiscard]] std::size_t remembered() const { return rows_.remembered(); }

 private:
  /// A vertex that is judged here.
  struct Judged {
    Claim claim;                   ///< the claim with the first of all blocks that reference it
    std::uint64_t local = kNoRow;  ///< its local row; kNoRow if no own block references it
    std::uint64_t row = kNoRow;
  };
  /// A vertex that has a local row, but whose first block belongs to another process.
  struct Foreign {
    std::uint64_t local = 0;
    std::uint64_t row = kNoRow;
  };
  /// A line of this process.
  struct Line {
    std::uint64_t first_local = 0;
    std::uint64_t foreign_before = 0;
    std::uint64_t first_row = 0;
  };

  void note(std::uint64_t block, const BlockVertex& vertex, std::uint64_t local);
  /// Returns get(Judged) for each of their claims.
  template <class Get>
  [[nodiscard]] ClaimLists answers(Get get) const;
  [[nodiscard]] bool is_first_here(const Judged& judged) const;
  [[nodiscard]] std::size_t foreign_before(std::uint64_t local) const;
  [[nodiscard]] std::uint64_t row_of(std::uint64_t local) const;

  const LineShare& share_;
  VertexUses uses_;
  VertexRows rows_;
  std::vector<std::vector<Claim>> mine_;
  ClaimLists locals_;                             ///< local rows of mine_
  std::vector<Judged> judged_;                    ///< ascending by home and id
  std::vector<std::vector<std::size_t>> theirs_;  ///< their claims, as places in judged_
  std::vector<Foreign> foreign_;                  ///< ascending by local row
  std::vector<Line> lines_;
};

}  // namespace mw::engine
