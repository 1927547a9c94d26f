// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/output/part_rows.h"

#include <algorithm>
#include <tuple>

#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

/// Returns the place of a vertex in a list that ascends by home and id; its size if none is there.
template <typename List, typename ClaimOf>
std::size_t find(const List& list, std::uint64_t home, VertexId id, ClaimOf claim_of) {
  const auto at = std::lower_bound(
      list.begin(), list.end(), id,
      [&](const auto& entry, VertexId wanted) { return is_before(claim_of(entry), home, wanted); });
  const bool found = at != list.end() && claim_of(*at).home == home && claim_of(*at).id == id;
  return static_cast<std::size_t>((found ? at : list.end()) - list.begin());
}

ClaimLists lists_like(const std::vector<std::vector<Claim>>& claims) {
  ClaimLists out;
  for (const auto& of_rank : claims) out.emplace_back(of_rank.size(), kNoRow);
  return out;
}

}  // namespace

PartRows::PartRows(const LineShare& share, VertexUses uses, std::vector<std::vector<Claim>> mine,
                   const std::vector<std::vector<Claim>>& theirs)
    : share_(share),
      uses_(std::move(uses)),
      rows_(uses_),
      mine_(std::move(mine)),
      locals_(lists_like(mine_)) {
  std::size_t claims = 0;
  for (const auto& of_rank : theirs) claims += of_rank.size();
  judged_.reserve(claims);
  for (const auto& of_rank : theirs) {
    for (const Claim& claim : of_rank) judged_.push_back({.claim = claim});
  }
  std::sort(judged_.begin(), judged_.end(), [](const Judged& a, const Judged& b) {
    return std::tie(a.claim.home, a.claim.id, a.claim.first) <
           std::tie(b.claim.home, b.claim.id, b.claim.first);
  });
  const auto same = [](const Judged& a, const Judged& b) {
    return a.claim.home == b.claim.home && a.claim.id == b.claim.id;
  };
  judged_.erase(std::unique(judged_.begin(), judged_.end(), same), judged_.end());
  for (const auto& of_rank : theirs) {
    std::vector<std::size_t>& places = theirs_.emplace_back();
    places.reserve(of_rank.size());
    for (const Claim& claim : of_rank) {
      places.push_back(find(judged_, claim.home, claim.id,
                            [](const Judged& j) -> const Claim& { return j.claim; }));
    }
  }
}

void PartRows::count(Index3 block, std::span<const BlockVertex> vertices) {
  if (block.x == 0) lines_.push_back({.first_local = rows_.count()});
  const std::uint64_t first_new = rows_.count();
  const std::vector<std::uint64_t> locals = rows_.assign(block, vertices);
  const std::uint64_t number = raster(block, share_.blocks());
  for (std::size_t v = 0; v < locals.size(); ++v) {
    if (locals[v] >= first_new) note(number, vertices[v], locals[v]);
  }
}

/// Notes the local row of a vertex that no own block before this one references.
void PartRows::note(std::uint64_t block, const BlockVertex& vertex, std::uint64_t local) {
  const Index3 home = uses_.home(vertex.position);
  const std::size_t line = uses_.line(home);
  const std::uint64_t number = raster(home, share_.blocks());
  if (!share_.is_own(line)) {
    const std::vector<Claim>& claims = mine_[share_.owner(line)];
    const std::size_t at =
        find(claims, number, vertex.id, [](const Claim& c) -> const Claim& { return c; });
    MW_ASSERT(at < claims.size() && claims[at].first == block);
    locals_[share_.owner(line)][at] = local;
    return;
  }
  const std::size_t at =
      find(judged_, number, vertex.id, [](const Judged& j) -> const Claim& { return j.claim; });
  if (at == judged_.size()) return;  // no other process references it
  judged_[at].local = local;
  judged_[at].claim.first = std::min(judged_[at].claim.first, block);
}

bool PartRows::is_first_here(const Judged& judged) const {
  return share_.is_own(share_.line_of(judged.claim.first));
}

template <class Get>
ClaimLists PartRows::answers(Get get) const {
  ClaimLists out;
  for (const auto& places : theirs_) {
    std::vector<std::uint64_t>& list = out.emplace_back();
    list.reserve(places.size());
    for (std::size_t at : places) list.push_back(get(judged_[at]));
  }
  return out;
}

ClaimLists PartRows::firsts() const {
  return answers([](const Judged& judged) { return judged.claim.first; });
}

void PartRows::take_firsts(const ClaimLists& firsts) {
  for (std::size_t rank = 0; rank < mine_.size(); ++rank) {
    for (std::size_t i = 0; i < mine_[rank].size(); ++i) {
      if (firsts[rank][i] != mine_[rank][i].first) foreign_.push_back({locals_[rank][i], kNoRow});
    }
  }
  for (const Judged& judged : judged_) {
    if (judged.local != kNoRow && !is_first_here(judged)) {
      foreign_.push_back({judged.local, kNoRow});
    }
  }
  std::sort(foreign_.begin(), foreign_.end(),
            [](const Foreign& a, const Foreign& b) { return a.local < b.local; });
  for (Line& line : lines_) line.foreign_before = foreign_before(line.first_local);
}

std::size_t PartRows::foreign_before(std::uint64_t local) const {
  const auto at =
      std::lower_bound(foreign_.begin(), foreign_.end(), local,
                       [](const Foreign& f, std::uint64_t wanted) { return f.local < wanted; });
  return static_cast<std::size_t>(at - foreign_.begin());
}

std::vector<std::uint64_t> PartRows::new_vertices() const {
  std::vector<std::uint64_t> out;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const bool is_last = i + 1 == lines_.size();
    const std::uint64_t end = is_last ? rows_.count() : lines_[i + 1].first_local;
    const std::uint64_t foreign = is_last ? foreign_.size() : lines_[i + 1].foreign_before;
    out.push_back(end - lines_[i].first_local - (foreign - lines_[i].foreign_before));
  }
  return out;
}

void PartRows::place(std::span<const std::uint64_t> first_rows) {
  MW_ASSERT(first_rows.size() == lines_.size());
  for (std::size_t i = 0; i < lines_.size(); ++i) lines_[i].first_row = first_rows[i];
  rows_ = VertexRows(uses_);
}

std::uint64_t PartRows::row_of(std::uint64_t local) const {
  const std::size_t before = foreign_before(local);
  if (before < foreign_.size() && foreign_[before].local == local) return foreign_[before].row;
  const auto next =
      std::upper_bound(lines_.begin(), lines_.end(), local,
                       [](std::uint64_t wanted, const Line& l) { return wanted < l.first_local; });
  const Line& line = *(next - 1);
  return line.first_row + (local - line.first_local) - (before - line.foreign_before);
}

ClaimLists PartRows::given_rows() const {
  ClaimLists out = locals_;
  for (auto& list : out) {
    for (std::uint64_t& number : list) number = row_of(number);  // kNoRow for foreign ones
  }
  return out;
}

void PartRows::take_given_rows(const ClaimLists& rows) {
  for (std::size_t rank = 0; rank < theirs_.size(); ++rank) {
    for (std::size_t i = 0; i < theirs_[rank].size(); ++i) {
      if (rows[rank][i] != kNoRow) judged_[theirs_[rank][i]].row = rows[rank][i];
    }
  }
  for (Judged& judged : judged_) {
    if (judged.local == kNoRow) continue;
    if (is_first_here(judged)) {
      judged.row = row_of(judged.local);
    } else {
      foreign_[foreign_before(judged.local)].row = judged.row;
    }
  }
}

ClaimLists PartRows::found_rows() const {
  return answers([](const Judged& judged) { return judged.row; });
}

void PartRows::take_found_rows(const ClaimLists& rows) {
  for (std::size_t rank = 0; rank < locals_.size(); ++rank) {
    for (std::size_t i = 0; i < locals_[rank].size(); ++i) {
      const std::size_t at = foreign_before(locals_[rank][i]);
      if (at < foreign_.size() && foreign_[at].local == locals_[rank][i]) {
        foreign_[at].row = rows[rank][i];
      }
    }
  }
}

PartRows::Assigned PartRows::assign(Index3 block, std::span<const BlockVertex> vertices) {
  const std::uint64_t first_new = rows_.count();
  Assigned out{.rows = rows_.assign(block, vertices), .added = {}};
  for (std::size_t v = 0; v < out.rows.size(); ++v) {
    const std::uint64_t local = out.rows[v];
    out.rows[v] = row_of(local);
    if (local < first_new) continue;
    const std::size_t at = foreign_before(local);
    if (at == foreign_.size() || foreign_[at].local != local) out.added.push_back(v);
  }
  return out;
}

void Claims::add(Index3 block, std::span<const BlockVertex> vertices) {
  make_room(vertices.size());
  const std::uint64_t number = raster(block, share_.blocks());
  for (const BlockVertex& v : vertices) {
    const Index3 home = homes_.home(v.position);
    if (share_.is_own(homes_.line(home))) continue;
    list_.push_back({raster(home, share_.blocks()), v.id, number});
  }
}

/// A full list becomes twice as long as what is left of it, so each claim is sorted a few times.
void Claims::make_room(std::size_t more) {
  if (list_.size() + more <= list_.capacity()) return;
  compact();
  const std::size_t wanted = 2 * list_.size() + more;
  if (wanted <= list_.capacity()) return;
  if (hold_) hold_((list_.capacity() + wanted) * sizeof(Claim));
  list_.reserve(wanted);
}

void Claims::compact() {
  std::sort(list_.begin(), list_.end(), [](const Claim& a, const Claim& b) {
    return std::tie(a.home, a.id, a.first) < std::tie(b.home, b.id, b.first);
  });
  const auto end = std::unique(list_.begin(), list_.end(), [](const Claim& a, const Claim& b) {
    return a.home == b.home && a.id == b.id;
  });
  list_.erase(end, list_.end());
}

std::vector<std::vector<Claim>> Claims::take(std::size_t ranks) {
  compact();
  if (hold_) hold_((list_.capacity() + list_.size()) * sizeof(Claim));
  const auto owner = [&](const Claim& c) { return share_.owner(share_.line_of(c.home)); };
  std::vector<std::size_t> counts(ranks);
  for (const Claim& c : list_) ++counts[owner(c)];
  std::vector<std::vector<Claim>> out(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank) out[rank].reserve(counts[rank]);
  for (const Claim& c : list_) out[owner(c)].push_back(c);
  list_ = {};
  return out;
}

}  // namespace mw::engine
