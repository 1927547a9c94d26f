// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unites pieces in trees, by the stars of vertices that a sort brings together.
#include "engine/connect/part_finder.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/file/errors.h"

namespace mw::engine {
namespace {

/// Returns how things of this size are worked on in the memory that there is for them.
WorkInOrder work_within(const ConnectTask& task, std::size_t bytes_each) {
  return WorkInOrder::within(task.threads, task.work_bytes, bytes_each);
}

}  // namespace

PartFinder::PartFinder(io::ScratchMesh& mesh, const ConnectTask& task)
    : mesh_(mesh),
      options_(task.options),
      split_(options_.all_split()),
      met_(split_.pairs.size()),
      seen_(options_.watched.size()),
      chunk_work_(work_within(task, TetChunk::kBytes)),
      range_work_(work_within(task, StarRange::kBytes)),
      ranges_(mesh.folder(), task.memory_bytes / 2),
      pinched_(mesh.folder(), task.memory_bytes / 4),
      insides_(mesh.folder(), task.memory_bytes / 16),
      copied_(mesh.folder(), task.memory_bytes / 16),
      held_(mesh.folder(), task.memory_bytes / 8),
      copies_(mesh.folder()),
      tet_pieces_(mesh.folder()) {}

void PartFinder::find(const std::function<void()>& between) {
  take_tets(between);
  look_at_ranges(between);
  count_stiff_labels();
  choose_parts();
  pinched_.each_group<1>([&](std::span<const StarRecord> same) {
    each_star(same,
              [&](std::uint64_t row, std::vector<StarTet>& star) { look_at_pinched(row, star); });
  });
  count_held_facets();
  count_parts();
  tell_apart();
}

void PartFinder::take_tets(const std::function<void()>& between) {
  mesh_.settle();
  const std::uint64_t tets = mesh_.tet_count();
  each_in_order<TetChunk>(
      chunk_work_, (tets + TetChunk::kTets - 1) / TetChunk::kTets,
      [&](std::uint64_t i) {
        const std::uint64_t first = i * TetChunk::kTets;
        TetChunk out;
        out.tets.resize(std::min<std::uint64_t>(TetChunk::kTets, tets - first));
        out.labels.resize(out.tets.size());
        mesh_.read_tets(first, out.tets, out.labels);
        look_at_chunk(first, split_, out);
        return out;
      },
      [&](std::uint64_t, TetChunk&& chunk) {
        between();
        take(std::move(chunk));
      });
  tet_pieces_.flush();
}

void PartFinder::take(TetChunk chunk) {
  if (pieces_.size() + chunk.tets.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kResource, "parts of the mesh: more than 2^32 pieces");
  }
  const auto first_piece = static_cast<std::uint32_t>(pieces_.size());
  first_pieces_.push_back(first_piece);
  for (std::size_t t = 0; t < chunk.tets.size(); ++t) {
    const std::uint32_t piece = first_piece + chunk.pieces[t];
    if (piece == pieces_.size()) {
      pieces_.push_back({.split_parent = piece,
                         .parent = piece,
                         .body_parent = piece,
                         .row = chunk.tets[t][0],
                         .label = chunk.labels[t]});
    }
    ++pieces_[piece].tets;
    chunk.pieces[t] = piece;
  }
  tet_pieces_.append(std::as_bytes(std::span(chunk.pieces)));
  ranges_.add(chunk.ranges);
  for (const RawLabel label : chunk.labels_met) insides_.add({label, 0});
}

void PartFinder::look_at_ranges(const std::function<void()>& between) {
  const StarRules rules{.split = split_, .watched = options_.watched};
  items_in_order<RangeTets, StarFindings>(
      range_work_, [&] { return ranges_.next(); },
      [&](RangeTets&& wanted) { return look_at_stars(load(wanted), rules); },
      [&](StarFindings&& found) {
        between();
        take(found);
      });
}

/// Thread safety: may be called by several threads, once all tets were taken.
StarRange PartFinder::load(const RangeTets& wanted) {
  const std::size_t count = wanted.tets.size();
  StarRange out{.first_row = wanted.range * kRowsARange,
                .tets = std::vector<io::TetRows>(count),
                .labels = std::vector<RawLabel>(count),
                .pieces = std::vector<std::uint32_t>(count),
                .places = {}};
  read_tets(mesh_, wanted.tets, out.tets, out.labels);
  std::vector<std::uint32_t> pieces;
  each_near(wanted.tets, [&](const NearNumbers& near) {
    pieces.resize(near.span);
    tet_pieces_.read_at(near.first * sizeof(std::uint32_t),
                        std::as_writable_bytes(std::span(pieces)));
    for (std::size_t i = near.begin; i < near.end; ++i) {
      out.pieces[i] = pieces[wanted.tets[i] - near.first];
    }
  });
  out.places.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t chunk = wanted.tets[i] / TetChunk::kTets;
    out.places.push_back(
        place_of(chunk, out.pieces[i] - first_pieces_[chunk], wanted.tets[i] % TetChunk::kTets));
  }
  return out;
}

void PartFinder::take(const StarFindings& found) {
  for (const PieceJoint& joint : found.joints) {
    unite(&Piece::parent, joint.one, joint.other);
    if (!joint.is_cut) unite(&Piece::split_parent, joint.one, joint.other);
  }
  for (const RawLabel label : found.insides) insides_.add({label, 1});
  for (const StarRecord& corner : found.pinched) pinched_.add(corner);
  for (const std::size_t pair : found.watched) seen_[pair] = true;
}

void PartFinder::count_stiff_labels() {
  std::array<std::uint64_t, 2> last{};  // the last record of a label has a 1 if any of them has
  const auto close = [&] {
    ++facts_.labels;
    if (last[1] != 0) return;
    ++facts_.stiff_labels;
    if (facts_.stiff.size() < kMostPlaces) facts_.stiff.push_back(last[0]);
  };
  bool is_first = true;
  insides_.each([&](const std::array<std::uint64_t, 2>& record) {
    if (!is_first && record[0] != last[0]) close();
    is_first = false;
    last = record;
  });
  if (!is_first) close();
}

void PartFinder::choose_parts() {
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    const std::uint32_t part = root(&Piece::parent, p);
    pieces_[p].body_parent = part;
    if (part != p) {
      pieces_[part].tets += pieces_[p].tets;
    } else {
      ++facts_.found;
    }
  }
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    if (root(&Piece::parent, p) != p) continue;
    if (facts_.largest_tets < pieces_[p].tets) largest_ = p;
    facts_.largest_tets = std::max(facts_.largest_tets, pieces_[p].tets);
  }
  const PartsRule& rule = options_.parts;
  if (facts_.largest_tets < rule.least_tets) {
    io::fail_usage("--parts ", rule.least_tets, ": no part is that large, the largest has ",
                   facts_.largest_tets);
  }
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    const std::uint32_t part = root(&Piece::parent, p);
    pieces_[p].is_kept =
        (!rule.only_largest || part == largest_) && pieces_[part].tets >= rule.least_tets;
  }
}

void PartFinder::count_parts() {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> others;
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    if (!pieces_[p].is_kept) continue;
    facts_.parts_after += root(&Piece::split_parent, p) == p ? 1U : 0U;
    if (root(&Piece::parent, p) != p) continue;
    ++facts_.parts;
    facts_.tets += pieces_[p].tets;
    facts_.small += pieces_[p].tets < kSmallPartTets ? 1U : 0U;
    if (p == largest_) continue;
    const bool hangs = root(&Piece::body_parent, p) == root(&Piece::body_parent, largest_);
    ++(hangs ? facts_.hanging : facts_.free);
    others.emplace_back(pieces_[p].tets, p);
  }
  std::sort(others.begin(), others.end());
  others.resize(std::min(others.size(), kMostPlaces));
  for (const auto& [tets, p] : others) {
    const bool hangs = root(&Piece::body_parent, p) == root(&Piece::body_parent, largest_);
    facts_.others.push_back(
        {.tets = tets, .is_free = !hangs, .label = pieces_[p].label, .row = pieces_[p].row});
  }
}

void PartFinder::look_at_pinched(std::uint64_t row, std::vector<StarTet>& star) {
  std::erase_if(
      star, [&](const StarTet& tet) { return !pieces_[piece_at(first_pieces_, tet.tet)].is_kept; });
  if (star.empty()) return;
  StarSets joined(star.size()), split(star.size());
  bool is_cut = false;
  each_star_face(star, [&](const StarPair& pair) {
    const bool cuts = are_cut(split_, star, pair);
    is_cut = is_cut || cuts;
    if (cuts) note_cut(star[pair[0]].label, star[pair[1]].label);
    joined.unite(pair[0], pair[1]);
    if (!cuts) split.unite(pair[0], pair[1]);
  });
  for (const StarTet& tet : star) {
    unite(&Piece::body_parent, piece_at(first_pieces_, star[0].tet),
          piece_at(first_pieces_, tet.tet));
  }
  if ((is_cut || options_.open_hinges) && split.count() > 1) double_vertex(row, star, split);
  if (is_cut) count_facets(row, star, split);
  count_hinges(row, star, std::move(joined));
}

void PartFinder::note_cut(RawLabel one, RawLabel other) {
  const std::vector<LabelPair>& pairs = split_.pairs;
  const auto pair =
      std::lower_bound(pairs.begin(), pairs.end(), LabelPair(std::minmax(one, other)));
  if (!split_.all) met_[static_cast<std::size_t>(pair - pairs.begin())] = true;
}

void PartFinder::tell_apart() {
  for (std::size_t i = 0; i < met_.size() && !split_.all; ++i) {
    if (!met_[i]) facts_.apart.push_back(split_.pairs[i]);
  }
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (!seen_[i]) facts_.unmet.push_back(options_.watched[i]);
  }
}

/// An edge is counted at its first vertex.
void PartFinder::count_hinges(std::uint64_t row, std::span<const StarTet> star, StarSets joined) {
  for (const SplitEdge& edge : split_edges(star)) {
    for (const std::size_t tet : edge.tets) joined.unite(edge.tets[0], tet);
    if (edge.other < row) continue;
    ++facts_.hinge_edges;
    add_hinge({.is_edge = true,
               .labels = {star[edge.fans[0]].label, star[edge.fans[1]].label},
               .rows = {row, edge.other}});
  }
  if (joined.count() == 1) return;
  const std::vector<std::size_t> numbers = joined.numbers();
  const auto second = std::find(numbers.begin(), numbers.end(), 1) - numbers.begin();
  ++facts_.hinge_vertices;
  add_hinge({.labels = {star[0].label, star[static_cast<std::size_t>(second)].label},
             .rows = {row, row}});
}

/// Counts the facets of which this is the first vertex, and notes those that this vertex holds.
void PartFinder::count_facets(std::uint64_t row, std::span<const StarTet> star,
                              const StarSets& sets) {
  const std::vector<std::size_t> numbers = sets.numbers();
  each_star_face(star, [&](const StarPair& pair) {
    if (!are_cut(split_, star, pair)) return;
    const StarTet &one = star[pair[0]], &other = star[pair[1]];
    const bool has_wedge = options_.cohesive.has(one.label, other.label);
    std::array<std::uint64_t, 4> facet{row};
    std::set_intersection(one.others.begin(), one.others.end(), other.others.begin(),
                          other.others.end(), facet.begin() + 1);
    std::sort(facet.begin(), facet.begin() + 3);
    if (facet[0] == row) {
      ++facts_.facets;
      facts_.wedges += has_wedge ? 1U : 0U;
    }
    facet[3] = has_wedge ? 1 : 0;
    if (numbers[pair[0]] == numbers[pair[1]]) held_.add(facet);
  });
}

/// A facet opens, and has its wedge, unless both tets keep all three vertices.
void PartFinder::count_held_facets() {
  std::array<std::uint64_t, 4> last{};
  int times = 0;
  held_.each([&](const std::array<std::uint64_t, 4>& facet) {
    times = facet == last ? times + 1 : 1;
    last = facet;
    if (times < 3) return;
    ++facts_.held;
    facts_.closed += facet[3];
  });
  facts_.wedges -= facts_.closed;
}

void PartFinder::add_hinge(const HingePlace& hinge) {
  if (facts_.hinges.size() < kMostPlaces) facts_.hinges.push_back(hinge);
}

/// The set of the first tet keeps the vertex; each other set gets a copy.
void PartFinder::double_vertex(std::uint64_t row, std::span<const StarTet> star,
                               const StarSets& sets) {
  const std::vector<std::size_t> numbers = sets.numbers();
  for (std::size_t t = 0; t < star.size(); ++t) {
    if (numbers[t] == 0) continue;
    const std::uint64_t place = star[t].tet;
    const std::uint64_t tet = (place >> 32) * TetChunk::kTets + (place & 0xffffU);
    copied_.add({tet, row, facts_.copies + numbers[t] - 1});
  }
  ++facts_.doubled;
  for (std::size_t copy = 1; copy < sets.count(); ++copy, ++facts_.copies) {
    copies_.append(std::as_bytes(std::span(&row, 1)));
  }
}

bool PartFinder::keeps(std::uint64_t tet) {
  if (!options_.parts.leaves_out()) return true;
  const std::uint64_t chunk = tet / TetChunk::kTets;
  if (chunk != loaded_chunk_) {
    const std::uint64_t first = chunk * TetChunk::kTets;
    const std::uint64_t all = tet_pieces_.size() / sizeof(std::uint32_t);
    loaded_.resize(std::min<std::uint64_t>(TetChunk::kTets, all - first));
    tet_pieces_.read_at(first * sizeof(std::uint32_t), std::as_writable_bytes(std::span(loaded_)));
    loaded_chunk_ = chunk;
  }
  return pieces_[loaded_[tet % TetChunk::kTets]].is_kept;
}

void PartFinder::each_copied_corner(const std::function<void(const CopiedCorner&)>& visit) {
  copied_.each([&](const std::array<std::uint64_t, 3>& record) {
    visit({.tet = record[0], .row = record[1], .copy = record[2]});
  });
}

std::uint32_t PartFinder::root(Tree tree, std::uint32_t piece) {
  while (pieces_[piece].*tree != piece) {
    std::uint32_t& parent = pieces_[piece].*tree;
    parent = pieces_[parent].*tree;
    piece = parent;
  }
  return piece;
}

void PartFinder::unite(Tree tree, std::uint32_t one, std::uint32_t other) {
  const auto [low, high] = std::minmax({root(tree, one), root(tree, other)});
  pieces_[high].*tree = low;
}

}  // namespace mw::engine
