// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Components of a volume that are smaller than a number of voxels: how they are found out of core,
// what they touch, which label they become, and the volume without them (--drop-specks).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "io/volume/label_volume.h"

namespace mw::io {

/// Components are voxels of one label that are joined by faces, or by faces, edges and corners.
struct SpeckRule {
  /// The most that `min` may be.
  static constexpr std::uint64_t kMax = std::uint64_t{1} << 62;

  std::uint64_t min = 1;  ///< voxels that a component must have to stay, from 1 to kMax
  bool diagonal = false;  ///< 26 neighbours instead of 6
};

/// Voxels of one speck, next to each other along x.
struct SpeckRun {
  std::int32_t begin = 0;
  std::int32_t end = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  std::uint32_t speck = 0;
};

/// All specks, numbered from 0 on.
struct Specks {
  std::vector<SpeckRun> runs;    ///< ascending by z, y, begin
  std::vector<RawLabel> labels;  ///< by speck
  std::uint64_t memory = 0;      ///< bytes that are enough to find them and their contacts
};

/// How a search for specks is bounded; it changes no result.
struct SpeckLimits {
  std::uint64_t memory = 256ULL << 20U;  ///< bytes
  std::int64_t slab_voxels = 1 << 20;    ///< of one read
  bool is_of_budget = false;             ///< memory is a quarter of --memory, as errors will say

  [[nodiscard]] static SpeckLimits of_budget(std::uint64_t budget) {
    return {.memory = budget / kShare, .is_of_budget = true};
  }
  static constexpr std::uint64_t kShare = 4;
};

/// Finds the specks in one pass over the volume.  A component that reaches the last planes read
/// keeps its runs while it is small; once it is large, only that fact is kept.
/// Memory: 40 bytes a run of specks, and some 60 a run of two planes and 120 a component in them;
/// neither goes above limits.memory.
/// ERRORS: mw::Error(kResource) when either would, with the number of specks and the memory that is
/// enough, or with the memory that two planes take at least.
[[nodiscard]] Specks find_specks(const LabelVolume& volume, const SpeckRule& rule,
                                 const SpeckLimits& limits);

/// Throws mw::Error(kResource), which tells the number of specks and the bytes that are enough.
[[noreturn]] void fail_too_many_specks(const SpeckRule& rule, std::uint64_t specks,
                                       const SpeckLimits& limits, std::uint64_t enough);

/// One speck and what it touches: another speck, or voxels of a label that are in none.
struct SpeckContact {
  std::uint32_t speck = 0;
  std::uint32_t other = 0;  ///< a speck, or kOfLabel + index in SpeckContacts::labels
  std::uint64_t faces = 0;  ///< 0 for two specks that share only edges or corners

  static constexpr std::uint32_t kOfLabel = std::uint32_t{1} << 31;
  [[nodiscard]] bool is_label() const { return other >= kOfLabel; }
};

struct SpeckContacts {
  std::vector<SpeckContact> list;  ///< ascending by speck, then other; twice for two specks
  std::vector<RawLabel> labels;
};

/// Finds the contacts in one pass over the volume.  Memory: 32 bytes a contact, within what limits
/// leave beside the runs; 40 a label that specks touch; and two planes of runs as find_specks().
/// REQUIRES: specks as find_specks() found them in this volume by this rule.
/// ERRORS: mw::Error(kResource) when that is too much, with the number of specks and the memory
/// that is enough.
[[nodiscard]] SpeckContacts find_contacts(const LabelVolume& volume, const SpeckRule& rule,
                                          const Specks& specks, const SpeckLimits& limits);

/// The result of the rounds.
struct SpeckOutcome {
  std::vector<std::optional<RawLabel>> becomes;  ///< by speck; nothing if it stays
  int rounds = 0;                                ///< in which some speck changed
};

/// Settles the specks in rounds, until nothing changes.  In a round each speck takes the label with
/// which it shares most faces, among voxels in no speck, the smaller label of two with as many; a
/// speck without such faces waits.  In the next round a changed speck counts as none, as does a
/// waiting one that it touches and whose label it has taken.
/// The volume is not needed: a speck that changes becomes part of a larger component, so that
/// specks never grow, shrink or merge with each other.
/// labels has one for each speck.  Cost: O(contacts log contacts) whatever the number of rounds.
[[nodiscard]] SpeckOutcome settle_specks(const std::vector<RawLabel>& labels,
                                         const SpeckContacts& contacts, bool labels_signed);

/// The memory of a run and of a contact.  Runs wait in a list and end in a vector, which is larger
/// than its content while it grows.
inline constexpr std::uint64_t kBytesPerSpeckRun = 2 * sizeof(SpeckRun);
inline constexpr std::uint64_t kBytesPerSpeckContact = 2 * sizeof(SpeckContact);

/// Returns how many different contacts fit into a list of `listed`.  To add up those that are equal
/// must free an eighth of the list, or it would be done for nearly every contact.
[[nodiscard]] constexpr std::uint64_t contacts_that_fit(std::uint64_t listed) {
  return listed - listed / 8;
}

/// Counts of one search.
struct SpeckMemory {
  std::uint64_t runs = 0;      ///< of specks, and of components that may become specks
  std::uint64_t max_runs = 0;  ///< at any time
  std::uint64_t planes = 0;    ///< bytes of two planes, the most at any time
  std::uint64_t contacts = 0;  ///< of specks, some counted several times
  std::uint64_t specks = 0;
  std::uint64_t large = 0;  ///< components, or parts of them, that are no specks

  void add_run() { max_runs = std::max(max_runs, ++runs); }
  /// Returns the limit of memory under which the search does not fail.
  [[nodiscard]] std::uint64_t enough() const {
    // Few specks that touch many times have few contacts.
    const std::uint64_t others = specks + large;
    const std::uint64_t max = specks < (1U << 20) ? specks * others : contacts;
    const std::uint64_t different = std::min(contacts, max);
    const std::uint64_t listed = different + different / 7 + 8;
    return std::max(planes, max_runs * kBytesPerSpeckRun + listed * kBytesPerSpeckContact);
  }
};

/// What was changed.
struct SpeckFacts {
  std::uint64_t components = 0;
  std::uint64_t voxels = 0;
  int rounds = 0;
};

/// settle_specks() has the rule.  The volume is read twice at the start, plane by plane, which for
/// a file whose fastest axis is z takes several times as long as for others.  The volume is never
/// held; only the runs of voxels that change are.
/// Thread safety: as the volume below, which must outlive it.
class DespeckledVolume : public VolumeView {
 public:
  /// Memory: see find_specks() and find_contacts(); afterwards 20 bytes a run and 8 a speck.
  /// ERRORS: those of find_specks() and find_contacts(), and what the volume throws.
  DespeckledVolume(const LabelVolume& volume, const SpeckRule& rule,
                   const SpeckLimits& limits = {});

  [[nodiscard]] const SpeckFacts& facts() const { return facts_; }
  void read(const Box3& box, std::span<RawLabel> out) const override;
  /// Returns the bytes that this object holds.
  [[nodiscard]] std::uint64_t held_bytes() const;

 private:
  void find_planes();
  void change_row(Index3 first, std::span<RawLabel> row) const;

  std::vector<SpeckRun> runs_;     ///< the runs that change, ascending by z, y, begin
  std::vector<RawLabel> becomes_;  ///< by speck
  std::vector<std::size_t> plane_begin_;
  SpeckFacts facts_;
};

}  // namespace mw::io
