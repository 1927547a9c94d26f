// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Components of a volume that are smaller than a number of voxels: found out of core, what they
// touch, and which label each takes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "io/volume/label_volume.h"

namespace mw::io {

/// Components are voxels of one label that are joined by faces, or by faces, edges and corners.
struct SpeckRule {
  /// The most that `least` may be.
  static constexpr std::uint64_t kMax = std::uint64_t{1} << 62;

  std::uint64_t min = 1;  ///< voxels that a component must have to stay, from 1 to kMax
  bool diagonal = false;  ///< 26 neighbours instead of 6
};

/// Voxels of one speck next to each other along x: all of one label.
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
  std::uint64_t memory = 0;      ///< bytes that are enough to find and to settle them
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

/// One pass over the volume.  A component is followed as long as planes go on with it: it keeps
/// its runs while it is small, then nothing but the fact that it is not.
/// Memory: 40 bytes a run of specks, and some 60 a run of two planes and 120 a component in them;
/// neither goes above limits.memory.
/// ERRORS: mw::Error(kResource) when it would, with the number of specks and the memory that is
/// enough, or of two planes how much they take at least.
[[nodiscard]] Specks find_specks(const LabelVolume& volume, const SpeckRule& rule,
                                 const SpeckLimits& limits);

/// Throws mw::Error(kResource) that tells the number of specks and the bytes that are enough.
[[noreturn]] void fail_too_many_specks(const SpeckRule& rule, std::uint64_t specks,
                                       const SpeckLimits& limits, std::uint64_t enough);

/// One speck and what it touches: another speck, or voxels of a label that are in none.
struct SpeckContact {
  std::uint32_t speck = 0;
  std::uint32_t other = 0;  ///< a speck, or kOfLabel + index in SpeckContacts::labels
  std::uint64_t faces = 0;  ///< 0: only edges or corners, of specks that are joined by them

  static constexpr std::uint32_t kOfLabel = std::uint32_t{1} << 31;
  [[nodiscard]] bool is_label() const { return other >= kOfLabel; }
};

struct SpeckContacts {
  std::vector<SpeckContact> list;  ///< ascending by speck, then other; two specks are there twice
  std::vector<RawLabel> labels;
};

/// One pass over the volume.  Memory: 32 bytes a contact, within what limits leave beside the runs;
/// 40 a label that specks touch; and two planes of runs as find_specks().
/// REQUIRES: specks as find_specks() found them in this volume by this rule.
/// ERRORS: mw::Error(kResource) when that is too much, with the number of specks and the memory
/// that is enough.
[[nodiscard]] SpeckContacts find_contacts(const LabelVolume& volume, const SpeckRule& rule,
                                          const Specks& specks, const SpeckLimits& limits);

/// What the rounds came to.
struct SpeckOutcome {
  std::vector<std::optional<RawLabel>> becomes;  ///< by speck; none: it stays
  int rounds = 0;                                ///< in which some speck changed
};

/// In a round all components that are too small are specks.  Each takes the label that most faces
/// of its voxels to voxels in no speck have, the smaller label of two with as many; one without
/// such faces waits for the next round, in which neighbours that have changed are specks no more:
/// nor is one that touches such a neighbour of its own label by then.  Until nothing changes.
/// The volume is not needed: a speck that changes becomes part of a component that is none, so
/// specks never grow, shrink or merge with each other.
/// labels: by speck.  Cost: O(contacts log contacts) whatever the number of rounds.
[[nodiscard]] SpeckOutcome settle_specks(const std::vector<RawLabel>& labels,
                                         const SpeckContacts& contacts, bool labels_signed);

/// Runs wait in a list and end in a vector, which is larger than what it holds while it grows.
inline constexpr std::uint64_t kBytesPerSpeckRun = 2 * sizeof(SpeckRun);
inline constexpr std::uint64_t kBytesPerSpeckContact = 2 * sizeof(SpeckContact);

/// How many contacts are listed before sums are made of those that are the same: an eighth must
/// come of it, or they would be made for each.
[[nodiscard]] constexpr std::uint64_t contacts_that_fit(std::uint64_t listed) {
  return listed - listed / 8;
}

/// Counts of one search.
struct SpeckMemory {
  std::uint64_t runs = 0;      ///< of specks, and of components that may become some
  std::uint64_t max_runs = 0;  ///< at any time
  std::uint64_t planes = 0;    ///< bytes of two planes, the most at any time
  std::uint64_t contacts = 0;  ///< of specks; at least as many as there are
  std::uint64_t specks = 0;
  std::uint64_t large = 0;  ///< components, or parts of them, that are none

  void add_run() { max_runs = std::max(max_runs, ++runs); }
  /// Limits under which nothing is too much.
  [[nodiscard]] std::uint64_t enough() const {
    // Few specks that touch many times have few contacts.
    const std::uint64_t others = specks + large;
    const std::uint64_t max = specks < (1U << 20) ? specks * others : contacts;
    const std::uint64_t different = std::min(contacts, max);
    const std::uint64_t listed = different + different / 7 + 8;
    return std::max(planes, max_runs * kBytesPerSpeckRun + listed * kBytesPerSpeckContact);
  }
};

}  // namespace mw::io
