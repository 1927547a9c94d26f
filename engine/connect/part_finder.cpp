// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unites pieces in trees, by the stars of vertices that a sort brings together.
#include "engine/connect/part_finder.h"

#include <algorithm>
#include <limits>

#include "io/file/errors.h"

namespace mw::engine {
namespace {

/// Returns the place of a tet: its chunk, then its piece and itself, both counted in the chunk.
std::uint64_t place_of(std::uint64_t chunk, std::uint64_t piece, std::uint64_t tet) {
  return chunk << 32 | piece << 16 | tet;
}

/// A face of a chunk's tet, and that tet.
using ChunkFace = std::array<std::uint64_t, 4>;

/// True if a star whose tets faces join is a ball around the vertex or a half ball, so that no edge
/// has two fans.  The faces opposite to the vertex form a connected surface, whose Euler
/// characteristic is at most 2, or 1 if it has a border; only a sphere or a disc has that much, as
/// each place where the surface is pinched takes at least one from it.
bool is_plain(std::span<const StarTet> star, std::size_t inner_faces) {
  std::vector<std::uint64_t> others;
  for (const StarTet& tet : star) others.insert(others.end(), tet.others.begin(), tet.others.end());
  std::sort(others.begin(), others.end());
  const auto vertices = std::unique(others.begin(), others.end()) - others.begin();
  const std::size_t tets = star.size();
  const std::size_t faces = 3 * tets - inner_faces;
  const bool is_closed = 2 * inner_faces == 3 * tets;
  return static_cast<std::size_t>(vertices) + tets == faces + (is_closed ? 2 : 1);
}

/// True for a vertex inside a label: all faces of its tets are shared, and the tets are of one
/// label.
bool is_inside(std::span<const StarTet> star, std::size_t inner_faces) {
  return 2 * inner_faces == 3 * star.size() &&
         std::all_of(star.begin(), star.end(),
                     [&](const StarTet& tet) { return tet.label == star[0].label; });
}

bool are_cut(const SplitRule& split, std::span<const StarTet> star, const StarPair& pair) {
  return split.any() && split.cuts(star[pair[0]].label, star[pair[1]].label);
}

}  // namespace

PartFinder::PartFinder(ConnectOptions options, std::filesystem::path folder,
                       std::size_t memory_bytes)
    : options_(std::move(options)),
      split_(options_.all_split()),
      met_(split_.pairs.size()),
      seen_(options_.watched.size()),
      folder_(std::move(folder)),
      memory_bytes_(memory_bytes),
      stars_(folder_, memory_bytes_),
      pinched_(folder_, 3 * memory_bytes_ / 8),
      insides_(folder_, memory_bytes_ / 8),
      copied_(folder_, memory_bytes_ / 4),
      held_(folder_, memory_bytes_ / 4),
      copies_(folder_),
      tet_pieces_(folder_) {}

void PartFinder::add(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) {
  for (std::size_t t = 0; t < tets.size(); ++t) {
    tets_.push_back(tets[t]);
    labels_.push_back(labels[t]);
    if (tets_.size() == kChunkTets) close_chunk();
  }
}

/// Returns the piece of each tet of the chunk; pieces are numbered by their first tets.
std::vector<std::uint32_t> PartFinder::pieces_of_chunk() {
  std::vector<ChunkFace> faces;
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    io::TetRows rows = tets_[t];
    std::sort(rows.begin(), rows.end());
    const auto [a, b, c, d] = rows;
    faces.insert(faces.end(), {{a, b, c, t}, {a, b, d, t}, {a, c, d, t}, {b, c, d, t}});
  }
  std::sort(faces.begin(), faces.end());
  StarSets sets(tets_.size());
  for (std::size_t f = 1; f < faces.size(); ++f) {
    const ChunkFace &one = faces[f - 1], &other = faces[f];
    if (!std::equal(one.begin(), one.begin() + 3, other.begin())) continue;
    if (!split_.cuts(labels_[one[3]], labels_[other[3]])) sets.unite(one[3], other[3]);
  }
  const std::vector<std::size_t> numbers = sets.numbers();
  return {numbers.begin(), numbers.end()};
}

void PartFinder::close_chunk() {
  const std::vector<std::uint32_t> numbers = pieces_of_chunk();
  if (pieces_.size() + tets_.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kResource, "parts of the mesh: more than 2^32 pieces");
  }
  const auto first = static_cast<std::uint32_t>(pieces_.size());
  const std::uint64_t chunk = first_pieces_.size();
  first_pieces_.push_back(first);
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    const std::uint32_t piece = first + numbers[t];
    if (piece == pieces_.size()) {
      pieces_.push_back({.split_parent = piece,
                         .parent = piece,
                         .body_parent = piece,
                         .row = tets_[t][0],
                         .label = labels_[t]});
    }
    ++pieces_[piece].tets;
    io::TetRows rows = tets_[t];
    std::sort(rows.begin(), rows.end());
    const auto [a, b, c, d] = rows;
    const std::uint64_t place = place_of(chunk, numbers[t], t);
    stars_.add({a, b, c, d, place, labels_[t]});
    stars_.add({b, a, c, d, place, labels_[t]});
    stars_.add({c, a, b, d, place, labels_[t]});
    stars_.add({d, a, b, c, place, labels_[t]});
    if (options_.parts.leaves_out()) {
      tet_pieces_.append(std::as_bytes(std::span(&piece, 1)));
    }
  }
  note_labels();
  tets_.clear();
  labels_.clear();
}

/// Notes the chunk's labels, which it sorts.
void PartFinder::note_labels() {
  std::sort(labels_.begin(), labels_.end());
  const auto end = std::unique(labels_.begin(), labels_.end());
  for (auto label = labels_.begin(); label != end; ++label) insides_.add({*label, 0});
}

void PartFinder::find() {
  if (!tets_.empty()) close_chunk();
  each_star(stars_, [&](std::uint64_t row, std::vector<StarTet>& star) { unite_star(row, star); });
  count_stiff_labels();
  choose_parts();
  each_star(pinched_,
            [&](std::uint64_t row, std::vector<StarTet>& star) { look_at_pinched(row, star); });
  count_held_facets();
  count_parts();
  tell_apart();
}

void PartFinder::each_star(io::ExternalSort<6>& records,
                           const std::function<void(std::uint64_t, std::vector<StarTet>&)>& visit) {
  std::vector<StarTet> star;
  records.each_group<1>([&](std::span<const StarRecord> same) {
    star.clear();
    for (const auto& [row, a, b, c, place, label] : same) {
      star.push_back({{a, b, c}, place, label});
    }
    visit(same[0][0], star);
  });
}

void PartFinder::unite_star(std::uint64_t row, std::vector<StarTet>& star) {
  StarSets sets(star.size());
  std::size_t inner_faces = 0;
  bool is_cut = false;
  each_star_face(star, [&](const StarPair& pair) {
    ++inner_faces;
    sets.unite(pair[0], pair[1]);
    const bool cuts = are_cut(split_, star, pair);
    is_cut = is_cut || cuts;
    if (!seen_.empty()) watch(star[pair[0]].label, star[pair[1]].label);
    const std::uint32_t one = piece_at(star[pair[0]].tet), other = piece_at(star[pair[1]].tet);
    unite(&Piece::parent, one, other);
    if (!cuts) unite(&Piece::split_parent, one, other);
  });
  if (is_inside(star, inner_faces)) insides_.add({star[0].label, 1});
  if (!is_cut && sets.count() == 1 && is_plain(star, inner_faces)) return;
  for (const StarTet& tet : star) {
    pinched_.add({row, tet.others[0], tet.others[1], tet.others[2], tet.tet, tet.label});
  }
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
  std::erase_if(star, [&](const StarTet& tet) { return !pieces_[piece_at(tet.tet)].is_kept; });
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
    unite(&Piece::body_parent, piece_at(star[0].tet), piece_at(tet.tet));
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

void PartFinder::watch(RawLabel one, RawLabel other) {
  if (one == other) return;
  const std::vector<LabelPair>& pairs = options_.watched;
  const LabelPair wanted = std::minmax(one, other);
  const auto pair = std::lower_bound(pairs.begin(), pairs.end(), wanted);
  if (pair == pairs.end() || *pair != wanted) return;
  seen_[static_cast<std::size_t>(pair - pairs.begin())] = true;
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
    const std::uint64_t tet = (place >> 32) * kChunkTets + (place & 0xffffU);
    copied_.add({tet, row, facts_.copies + numbers[t] - 1});
  }
  ++facts_.doubled;
  for (std::size_t copy = 1; copy < sets.count(); ++copy, ++facts_.copies) {
    copies_.append(std::as_bytes(std::span(&row, 1)));
  }
}

bool PartFinder::keeps(std::uint64_t tet) {
  if (!options_.parts.leaves_out()) return true;
  const std::uint64_t chunk = tet / kChunkTets;
  if (chunk != loaded_chunk_) {
    const std::uint64_t first = chunk * kChunkTets;
    const std::uint64_t all = tet_pieces_.size() / sizeof(std::uint32_t);
    loaded_.resize(std::min<std::uint64_t>(kChunkTets, all - first));
    tet_pieces_.read_at(first * sizeof(std::uint32_t), std::as_writable_bytes(std::span(loaded_)));
    loaded_chunk_ = chunk;
  }
  return pieces_[loaded_[tet % kChunkTets]].is_kept;
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

std::uint32_t PartFinder::piece_at(std::uint64_t place) const {
  return first_pieces_[place >> 32] + static_cast<std::uint32_t>(place >> 16 & 0xffffU);
}

}  // namespace mw::engine
