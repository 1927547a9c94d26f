// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Adds up what tiles counted, sorted by junction; two sets that are joined count one less.
#include "engine/verify/junction_ledger.h"

#include <limits>

#include "kernels/core/disjoint_sets.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

using audit::JunctionKind;
using audit::JunctionLabels;

// Two labels make a word, so that words are in the order of the labels.
std::array<std::uint64_t, 2> words_of(const JunctionLabels& l) {
  return {std::uint64_t{l[0]} << 32 | l[1], std::uint64_t{l[2]} << 32 | l[3]};
}
JunctionLabels labels_of(std::uint64_t first, std::uint64_t second) {
  return {static_cast<Label>(first >> 32), static_cast<Label>(first),  //
          static_cast<Label>(second >> 32), static_cast<Label>(second)};
}

std::uint64_t word(JunctionKind kind) {
  return kind == JunctionKind::kMeeting ? 1 : 0;
}
JunctionKind kind_of(std::uint64_t word) {
  return (word & 1U) != 0 ? JunctionKind::kMeeting : JunctionKind::kInterface;
}

}  // namespace

JunctionLedger::JunctionLedger(std::filesystem::path folder, std::size_t memory_bytes)
    : folder_(std::move(folder)), share_(memory_bytes / 2), cells_(folder_, share_) {}

void JunctionLedger::add_sums(Side side, const JunctionLabels& labels, JunctionKind kind,
                              Sums sums) {
  const auto [first, second] = words_of(labels);
  cells_.add({first, second, word(kind) << 1U | static_cast<std::uint64_t>(side),
              static_cast<std::uint64_t>(sums.components), static_cast<std::uint64_t>(sums.euler)});
}

void JunctionLedger::add(Side side, const audit::JunctionsPiece& piece) {
  for (const audit::JunctionTally& t : piece.tallies) {
    add_sums(side, t.labels, t.kind, {t.components, t.euler});
  }
  if (!nodes_) nodes_.emplace(folder_, share_);
  for (const audit::JunctionsPiece::Node& node : piece.shared) {
    const audit::JunctionTally& tally = piece.tallies[node.tally];
    const auto [first, second] = words_of(tally.labels);
    nodes_->add({first, second, node.vertex << 1U | word(tally.kind), sets_ + node.set});
  }
  sets_ += piece.open_sets;
  if (sets_ >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kResource,
                "verify: more than 2^32 parts of interfaces; verify a --crop");
  }
}

void JunctionLedger::close(Side side, audit::Cavities cavities) {
  cavities_[static_cast<std::size_t>(side)] = std::move(cavities);
  DisjointSets sets(sets_);
  std::array<std::uint64_t, 4> last{};
  bool is_first = true;
  const auto join = [&](const std::array<std::uint64_t, 4>& node) {
    const auto set = static_cast<std::uint32_t>(node[3]);
    const auto other = static_cast<std::uint32_t>(last[3]);
    const bool is_same = !is_first && std::equal(node.begin(), node.begin() + 3, last.begin());
    if (is_same && sets.find(set) != sets.find(other)) {
      sets.unite(set, other);
      add_sums(side, labels_of(node[0], node[1]), kind_of(node[2]), {-1, 0});
    }
    last = node;
    is_first = false;
  };
  if (nodes_) nodes_->each(join);
  nodes_.reset();
  sets_ = 0;
}

audit::Betti JunctionLedger::betti_of(const Row& row, Side side) const {
  const Sums& sums = row.sums[static_cast<std::size_t>(side)];
  if (sums.components == 0) return {};
  const audit::Cavities& cavities = cavities_[static_cast<std::size_t>(side)];
  const auto found = cavities.find(row.labels);
  const std::int64_t b2 = found == cavities.end() ? 0 : found->second;
  return {sums.components, sums.components + b2 - sums.euler, b2};
}

void JunctionLedger::report(const Row& row, audit::JunctionReport& out) const {
  const bool is_interface = row.kind == JunctionKind::kInterface;
  const audit::Betti before = betti_of(row, Side::kVolume), after = betti_of(row, Side::kMesh);
  if (before.b0 > 0) ++(is_interface ? out.interfaces : out.meetings);
  if (before == after) return;
  (is_interface ? out.interfaces_changed : out.meetings_changed)
      .push_back({row.labels, before, after});
}

audit::JunctionReport JunctionLedger::compare() {
  audit::JunctionReport out;
  std::optional<Row> row;
  cells_.each([&](const std::array<std::uint64_t, 5>& cells) {
    const JunctionLabels labels = labels_of(cells[0], cells[1]);
    const JunctionKind kind = kind_of(cells[2] >> 1U);
    if (row && (row->labels != labels || row->kind != kind)) {
      report(*row, out);
      row.reset();
    }
    if (!row) row = Row{labels, kind, {}};
    Sums& sums = row->sums[cells[2] & 1U];
    sums.components += static_cast<std::int64_t>(cells[3]);
    sums.euler += static_cast<std::int64_t>(cells[4]);
  });
  if (row) report(*row, out);
  return out;
}

}  // namespace mw::engine
