// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts and hinges of a mesh.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/connect/connect_mesh.h"
#include "engine/connect/connect_options.h"
#include "engine/connect/row_ranges.h"
#include "engine/connect/star.h"
#include "engine/connect/star_range.h"
#include "engine/connect/tet_chunk.h"
#include "engine/system/in_order.h"
#include "io/file/scratch/external_sort.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::engine {

// Tets are taken in by chunks.  Tets of a chunk that are joined by faces, except split ones, form a
// piece, and only pieces stay in memory.  The vertices are then looked at in ranges of rows, for
// which a sort brings together the numbers of tets: shared faces unite pieces, and a star that is
// no ball or half ball may be a hinge, or a place where vertices are doubled.  These pinched stars
// wait until all parts are known, since parts that are left out make no hinges.

/// A corner of a tet whose vertex is replaced by a copy.
struct CopiedCorner {
  std::uint64_t tet = 0;   ///< number of the tet, in the order in which tets came
  std::uint64_t row = 0;   ///< row of the vertex
  std::uint64_t copy = 0;  ///< number of the copy
};

/// Finds parts and hinges, and counts facets that open where the options ask for some.
/// Memory: `memory_bytes` for sorts, `work_bytes` for what threads look at, 0.3 MiB, and 40 bytes a
/// piece.  Disk: 4 bytes a tet in `folder`, and some 26 more during find().
/// ENSURES: what is found depends on the mesh alone.  Cost: 0.35 us a tet, most of it on several
/// threads.
class PartFinder {
 public:
  /// The mesh outlives this.
  PartFinder(io::ScratchMesh& mesh, const ConnectTask& task);

  /// Must be called once; between(), which may throw, is called often.
  /// ERRORS: mw::Error(kUsage) when no part has as many tets as the options ask for.
  void find(const std::function<void()>& between);

  // REQUIRES (all that follow): find() was called.
  /// Returns what was found, with rows of vertices but not yet their places.
  [[nodiscard]] ConnectFacts& facts() { return facts_; }
  /// True if the tet is written.  It is fast if it is asked for tets in their order.
  [[nodiscard]] bool keeps(std::uint64_t tet);
  /// Returns for each copy, by number, the row of the vertex that it is a copy of.
  [[nodiscard]] io::ScratchFile& copies() { return copies_; }
  /// Visits corners with a copy, ascending by tet.  It may be called once.
  void each_copied_corner(const std::function<void(const CopiedCorner&)>& visit);

 private:
  struct Piece {
    // Parents in three trees: of pieces joined by faces that are not split, by faces, by vertices.
    std::uint32_t split_parent = 0;
    std::uint32_t parent = 0;
    std::uint32_t body_parent = 0;
    bool is_kept = true;
    std::uint64_t tets = 0;  ///< its tets; at the root of a part, those of the whole part
    std::uint64_t row = 0;   ///< a vertex of its first tet
    RawLabel label = 0;      ///< label of that tet
  };
  using Tree = std::uint32_t Piece::*;

  void take_tets(const std::function<void()>& between);
  void take(TetChunk chunk);
  void look_at_ranges(const std::function<void()>& between);
  [[nodiscard]] StarRange load(const RangeTets& wanted);
  void take(const StarFindings& found);
  void count_stiff_labels();
  void choose_parts();
  void count_parts();
  void look_at_pinched(std::uint64_t row, std::vector<StarTet>& star);
  void note_cut(RawLabel one, RawLabel other);
  void tell_apart();
  void count_hinges(std::uint64_t row, std::span<const StarTet> star, StarSets joined);
  void count_facets(std::uint64_t row, std::span<const StarTet> star, const StarSets& sets);
  void count_held_facets();
  void add_hinge(const HingePlace& hinge);
  void double_vertex(std::uint64_t row, std::span<const StarTet> star, const StarSets& sets);

  [[nodiscard]] std::uint32_t root(Tree tree, std::uint32_t piece);
  void unite(Tree tree, std::uint32_t one, std::uint32_t other);

  io::ScratchMesh& mesh_;
  const ConnectOptions& options_;
  SplitRule split_;         ///< all interfaces that come apart
  std::vector<bool> met_;   ///< by pair of split_: true if a face is between its labels
  std::vector<bool> seen_;  ///< by pair of options_.watched: likewise
  WorkInOrder chunk_work_;
  WorkInOrder range_work_;
  std::vector<std::uint32_t> first_pieces_;  ///< the first piece of each chunk
  std::vector<Piece> pieces_;
  RowRanges ranges_;
  io::ExternalSort<6> pinched_;
  io::ExternalSort<2> insides_;  ///< label; 1 for a vertex inside, 0 for a tet
  io::ExternalSort<3> copied_;   ///< tet, row, copy
  /// Rows of a facet that should open, ascending, and 1 if it should have a wedge; once for each of
  /// its vertices that both of its tets keep.
  io::ExternalSort<4> held_;
  io::ScratchFile copies_;
  io::ScratchFile tet_pieces_;  ///< the piece of each tet
  std::uint64_t loaded_chunk_ = ~std::uint64_t{0};
  std::vector<std::uint32_t> loaded_;  ///< pieces of that chunk's tets
  std::uint32_t largest_ = 0;          ///< the root of the largest part
  ConnectFacts facts_;
};

}  // namespace mw::engine
