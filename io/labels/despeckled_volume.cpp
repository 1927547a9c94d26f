// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rounds over the graph of specks, each of which goes out from the specks that the one before has
// settled; and lays the new labels over what is read.
#include <algorithm>
#include <span>
#include <utility>

#include "io/labels/specks.h"
#include "kernels/core/assert.h"
#include "kernels/core/sort_distinct.h"

namespace mw::io {
namespace {

class Rounds {
 public:
  Rounds(const std::vector<RawLabel>& labels, const SpeckContacts& contacts, bool labels_signed)
      : labels_(labels),
        contacts_(contacts),
        flip_(labels_signed ? RawLabel{1} << 63U : 0),
        is_settled_(labels.size()) {
    outcome_.becomes.resize(labels.size());
    begin_.resize(labels.size() + 1);
    for (const SpeckContact& c : contacts.list) ++begin_[c.speck + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  }

  SpeckOutcome run() {
    std::vector<std::uint32_t> candidates(labels_.size());
    for (std::uint32_t i = 0; i < candidates.size(); ++i) candidates[i] = i;
    std::vector<std::uint32_t> settled = change(candidates);
    while (!settled.empty()) {
      ++outcome_.rounds;
      const std::vector<std::uint32_t> joined = join(settled);
      settled.insert(settled.end(), joined.begin(), joined.end());
      settled = change(waiting_around(settled));
    }
    return std::move(outcome_);
  }

 private:
  [[nodiscard]] std::span<const SpeckContact> around(std::uint32_t speck) const {
    return std::span(contacts_.list).subspan(begin_[speck], begin_[speck + 1] - begin_[speck]);
  }

  /// Gives all candidates at once the label that they can take; returns those that take one.
  std::vector<std::uint32_t> change(const std::vector<std::uint32_t>& candidates) {
    std::vector<std::uint32_t> changed;
    for (const std::uint32_t speck : candidates) {
      outcome_.becomes[speck] = choice(speck);
      if (outcome_.becomes[speck]) changed.push_back(speck);
    }
    for (const std::uint32_t speck : changed) is_settled_[speck] = true;
    return changed;
  }

  /// Returns the label that surrounds a speck most; nothing when all around it are waiting.
  [[nodiscard]] std::optional<RawLabel> choice(std::uint32_t speck) const {
    std::vector<std::pair<RawLabel, std::uint64_t>> faces;  // with labels flipped, to sort them
    for (const SpeckContact& c : around(speck)) {
      if (c.faces == 0 || (!c.is_label() && !is_settled_[c.other])) continue;
      faces.emplace_back(label_of(c) ^ flip_, c.faces);
    }
    std::sort(faces.begin(), faces.end());
    std::optional<RawLabel> best;
    std::uint64_t max = 0;
    for (std::size_t i = 0; i < faces.size();) {
      const RawLabel label = faces[i].first;
      std::uint64_t sum = 0;
      for (; i < faces.size() && faces[i].first == label; ++i) sum += faces[i].second;
      if (sum <= max) continue;
      max = sum;
      best = label ^ flip_;
    }
    return best;
  }

  /// REQUIRES: the other of c is a label or a settled speck.
  [[nodiscard]] RawLabel label_of(const SpeckContact& c) const {
    if (c.is_label()) return contacts_.labels[c.other - SpeckContact::kOfLabel];
    return outcome_.becomes[c.other].value_or(labels_[c.other]);
  }

  /// Settles the waiting specks whose own label a changed neighbour has taken, so that they belong
  /// to a larger component; returns them.
  std::vector<std::uint32_t> join(const std::vector<std::uint32_t>& changed) {
    std::vector<std::uint32_t> joined;
    for (const std::uint32_t speck : changed) {
      for (const SpeckContact& c : around(speck)) {
        if (c.is_label() || is_settled_[c.other]) continue;
        if (labels_[c.other] != outcome_.becomes[speck]) continue;
        is_settled_[c.other] = true;
        joined.push_back(c.other);
      }
    }
    return joined;
  }

  [[nodiscard]] std::vector<std::uint32_t> waiting_around(
      const std::vector<std::uint32_t>& settled) const {
    std::vector<std::uint32_t> out;
    for (const std::uint32_t speck : settled) {
      for (const SpeckContact& c : around(speck)) {
        if (!c.is_label() && !is_settled_[c.other]) out.push_back(c.other);
      }
    }
    sort_distinct(out);
    return out;
  }

  const std::vector<RawLabel>& labels_;
  const SpeckContacts& contacts_;
  RawLabel flip_;
  std::vector<std::size_t> begin_;  ///< where each speck's contacts begin
  std::vector<bool> is_settled_;    ///< by speck: it belongs to a larger component
  SpeckOutcome outcome_;
};

}  // namespace

SpeckOutcome settle_specks(const std::vector<RawLabel>& labels, const SpeckContacts& contacts,
                           bool labels_signed) {
  return Rounds(labels, contacts, labels_signed).run();
}

DespeckledVolume::DespeckledVolume(const LabelVolume& volume, const SpeckRule& rule,
                                   const SpeckLimits& limits)
    : VolumeView(volume) {
  Specks specks = find_specks(volume, rule, limits);
  SpeckOutcome outcome;
  if (!specks.runs.empty()) {
    outcome = settle_specks(specks.labels, find_contacts(volume, rule, specks, limits),
                            has_signed_labels(volume.info()));
  }
  std::erase_if(specks.runs, [&](const SpeckRun& run) { return !outcome.becomes[run.speck]; });
  runs_ = std::move(specks.runs);
  runs_.shrink_to_fit();
  facts_.rounds = outcome.rounds;
  for (const auto& label : outcome.becomes) {
    becomes_.push_back(label.value_or(0));
    if (label) ++facts_.components;
  }
  for (const SpeckRun& run : runs_) {
    facts_.voxels += static_cast<std::uint64_t>(run.end - run.begin);
  }
  find_planes();
}

void DespeckledVolume::find_planes() {
  plane_begin_.assign(static_cast<std::size_t>(info().shape.z) + 1, 0);
  for (const SpeckRun& run : runs_) ++plane_begin_[static_cast<std::size_t>(run.z) + 1];
  for (std::size_t z = 1; z < plane_begin_.size(); ++z) plane_begin_[z] += plane_begin_[z - 1];
}

std::uint64_t DespeckledVolume::held_bytes() const {
  return runs_.capacity() * sizeof(SpeckRun) + becomes_.capacity() * sizeof(RawLabel) +
         plane_begin_.size() * sizeof(std::size_t);
}

void DespeckledVolume::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  below().read(box, out);
  const auto row = static_cast<std::size_t>(box.shape().x);
  for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
    const auto at = static_cast<std::size_t>(z);
    if (plane_begin_[at] == plane_begin_[at + 1]) continue;
    for (std::int64_t y = box.lo.y; y < box.hi.y; ++y) {
      const Index3 first{box.lo.x, y, z};
      change_row(first, out.subspan(static_cast<std::size_t>(box.offset(first)), row));
    }
  }
}

void DespeckledVolume::change_row(Index3 first, std::span<RawLabel> row) const {
  const auto at = static_cast<std::size_t>(first.z);
  const std::span plane =
      std::span(runs_).subspan(plane_begin_[at], plane_begin_[at + 1] - plane_begin_[at]);
  const std::int64_t end = first.x + static_cast<std::int64_t>(row.size());
  auto run = std::partition_point(plane.begin(), plane.end(), [&](const SpeckRun& r) {
    return std::pair<std::int64_t, std::int64_t>(r.y, r.end) <= std::pair(first.y, first.x);
  });
  for (; run != plane.end() && run->y == first.y && run->begin < end; ++run) {
    const std::int64_t lo = std::max<std::int64_t>(run->begin, first.x);
    const std::int64_t hi = std::min<std::int64_t>(run->end, end);
    std::fill_n(row.begin() + (lo - first.x), hi - lo, becomes_[run->speck]);
  }
}

}  // namespace mw::io
