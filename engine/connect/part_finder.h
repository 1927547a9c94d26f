// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts and hinges of a mesh that comes tet by tet.
#pragma once

#include <span>

#include "engine/connect/connect_options.h"
#include "engine/connect/star.h"
#include "io/file/scratch/external_sort.h"
#include "io/mesh/mesh_sink.h"

namespace mw::engine {

// Tets are taken in by chunks.  Tets of a chunk that are joined by faces, except split ones, form a
// piece, and only pieces stay in memory.  The star of each vertex then comes out of a sort: its
// faces unite pieces, and a star that is no ball or half ball may be a hinge, or a place where
// vertices are doubled.  These pinched stars wait until all parts are known, since parts that are
// left out make no hinges.

/// A corner of a tet whose vertex is replaced by a copy.
struct CopiedCorner {
  std::uint64_t tet = 0;   ///< number of the tet, in the order in which tets came
  std::uint64_t row = 0;   ///< row of the vertex
  std::uint64_t copy = 0;  ///< number of the copy
};

/// Finds parts and hinges, and counts facets that open where the options ask for some.
/// Memory: `memory_bytes` twice, 0.3 MiB, and 40 bytes a piece.  Disk: 192 bytes a tet in `folder`
/// during find().  ENSURES: what is found depends on the mesh alone, not on how it was divided
/// among calls of add().  Cost: 3 us a tet.
class PartFinder {
 public:
  PartFinder(ConnectOptions options, std::filesystem::path folder, std::size_t memory_bytes);

  void add(std::span<const io::TetRows> tets, std::span<const RawLabel> labels);
  /// Must be called once, when all tets were added.
  /// ERRORS: mw::Error(kUsage) when no part has as many tets as the options ask for.
  void find();

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
  static constexpr std::size_t kChunkTets = 1024;

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

  /// A vertex, the three others of a tet, the place of the tet (place_of()), and its label.
  using StarRecord = std::array<std::uint64_t, 6>;

  void close_chunk();
  void note_labels();
  [[nodiscard]] std::vector<std::uint32_t> pieces_of_chunk();
  void each_star(io::ExternalSort<6>& records,
                 const std::function<void(std::uint64_t, std::vector<StarTet>&)>& visit);
  void unite_star(std::uint64_t row, std::vector<StarTet>& star);
  void count_stiff_labels();
  void choose_parts();
  void count_parts();
  void look_at_pinched(std::uint64_t row, std::vector<StarTet>& star);
  void note_cut(RawLabel one, RawLabel other);
  void tell_apart();
  void count_hinges(std::uint64_t row, std::span<const StarTet> star, StarSets joined);
  void count_facets(std::uint64_t row, std::span<const StarTet> star, const StarSets& sets);
  void count_held_facets();
  void watch(RawLabel one, RawLabel other);
  void add_hinge(const HingePlace& hinge);
  void double_vertex(std::uint64_t row, std::span<const StarTet> star, const StarSets& sets);

  [[nodiscard]] std::uint32_t root(Tree tree, std::uint32_t piece);
  void unite(Tree tree, std::uint32_t one, std::uint32_t other);
  [[nodiscard]] std::uint32_t piece_at(std::uint64_t place) const;

  ConnectOptions options_;
  SplitRule split_;         ///< all interfaces that come apart
  std::vector<bool> met_;   ///< by pair of split_: true if a face is between its labels
  std::vector<bool> seen_;  ///< by pair of options_.watched: likewise
  std::filesystem::path folder_;
  std::size_t memory_bytes_;
  std::vector<io::TetRows> tets_;  ///< tets of the chunk that is filled
  std::vector<RawLabel> labels_;
  std::vector<std::uint32_t> first_pieces_;  ///< the first piece of each chunk
  std::vector<Piece> pieces_;
  io::ExternalSort<6> stars_;
  io::ExternalSort<6> pinched_;
  io::ExternalSort<2> insides_;  ///< label; 1 for a vertex inside, 0 for a tet
  io::ExternalSort<3> copied_;   ///< tet, row, copy
  /// Rows of a facet that should open, ascending, and 1 if it should have a wedge; once for each of
  /// its vertices that both of its tets keep.
  io::ExternalSort<4> held_;
  io::ScratchFile copies_;
  io::ScratchFile tet_pieces_;  ///< the piece of each tet; only where parts are left out
  std::uint64_t loaded_chunk_ = ~std::uint64_t{0};
  std::vector<std::uint32_t> loaded_;  ///< pieces of that chunk's tets
  std::uint32_t largest_ = 0;          ///< the root of the largest part
  ConnectFacts facts_;
};

}  // namespace mw::engine
