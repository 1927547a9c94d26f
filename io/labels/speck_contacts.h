// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What specks touch, and with how many faces.
#pragma once

#include <vector>

#include "io/labels/speck_finder.h"

namespace mw::io {

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

}  // namespace mw::io
