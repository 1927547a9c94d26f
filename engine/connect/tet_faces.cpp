// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Equal rows and equal faces are found in a table with linear probing, whose order nothing tells.
#include "engine/connect/tet_faces.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace mw::engine {
namespace {

/// Numbers that are found again by what they stand for.
class NumberTable {
 public:
  static constexpr std::uint32_t kFree = ~std::uint32_t{0};

  /// REQUIRES: no more than `most` numbers are put into it.
  explicit NumberTable(std::size_t most) : slots_(std::bit_ceil(2 * most + 1), kFree) {}

  /// Returns the place of the number that is alike, or a free one.
  template <class IsAlike>
  [[nodiscard]] std::uint32_t& place(std::uint64_t key, IsAlike is_alike) {
    std::size_t at = (key * kMix) >> 32U & (slots_.size() - 1);
    while (slots_[at] != kFree && !is_alike(slots_[at])) at = (at + 1) & (slots_.size() - 1);
    return slots_[at];
  }

 private:
  static constexpr std::uint64_t kMix = 0x9e3779b97f4a7c15U;
  std::vector<std::uint32_t> slots_;
};

using Face = std::array<std::uint32_t, 3>;

Face face_opposite(const std::array<std::uint32_t, 4>& corners, std::size_t corner) {
  Face out{};
  std::size_t next = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i != corner) out[next++] = corners[i];
  }
  return out;
}

/// Different faces may have one key.
std::uint64_t key_of(const Face& face) {
  const std::uint64_t two = face[0] | std::uint64_t{face[1]} << 32U;
  return (two ^ two >> 29U) * 0xbf58476d1ce4e5b9U + face[2];
}

template <class IsAsked>
EarlierTets find_earlier(const LocalTets& tets, IsAsked is_asked) {
  const auto& corners = tets.corners;
  EarlierTets out(corners.size(), {kNoTet, kNoTet, kNoTet, kNoTet});
  NumberTable faces(4 * corners.size());  // of each face, 4 times its last tet and the corner
  for (std::uint32_t t = 0; t < corners.size(); ++t) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      const Face face = face_opposite(corners[t], k);
      if (!is_asked(face)) continue;
      std::uint32_t& last = faces.place(key_of(face), [&](std::uint32_t other) {
        return face_opposite(corners[other / 4], other % 4) == face;
      });
      if (last != NumberTable::kFree) out[t][k] = last / 4;
      last = 4 * t + k;
    }
  }
  return out;
}

}  // namespace

LocalTets local_tets(std::span<const io::TetRows> tets) {
  LocalTets out;
  out.corners.reserve(tets.size());
  NumberTable numbers(4 * tets.size());
  for (io::TetRows rows : tets) {
    std::sort(rows.begin(), rows.end());
    std::array<std::uint32_t, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      std::uint32_t& number =
          numbers.place(rows[i], [&](std::uint32_t other) { return out.rows[other] == rows[i]; });
      if (number == NumberTable::kFree) {
        number = static_cast<std::uint32_t>(out.rows.size());
        out.rows.push_back(rows[i]);
      }
      corners[i] = number;
    }
    out.corners.push_back(corners);
  }
  return out;
}

EarlierTets earlier_tets(const LocalTets& tets, const std::vector<bool>& is_asked) {
  return find_earlier(tets, [&](const Face& face) {
    return is_asked[face[0]] || is_asked[face[1]] || is_asked[face[2]];
  });
}

EarlierTets earlier_tets(const LocalTets& tets) {
  return find_earlier(tets, [](const Face&) { return true; });
}

}  // namespace mw::engine
