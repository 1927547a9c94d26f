// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Equal rows and equal faces are found in a table with linear probing, whose order nothing tells.
#include "engine/connect/tet_faces.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>

namespace mw::engine {
namespace {

/// Numbers that are found again by what they stand for.
class NumberTable {
 public:
  static constexpr std::uint32_t kFree = ~std::uint32_t{0};

  /// REQUIRES: no more than `most` numbers are put into it.  It is quick where half as many are.
  explicit NumberTable(std::size_t most) : slots_(std::bit_ceil(most + most / 4 + 1), kFree) {}

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

/// By corner: the others, ascending.
constexpr std::array<std::array<std::uint8_t, 4>, 4> kOthers{
    {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

Face face_opposite(const std::array<std::uint32_t, 4>& corners, std::size_t corner) {
  const auto& others = kOthers[corner];
  return {corners[others[0]], corners[others[1]], corners[others[2]]};
}

/// Different faces may have one key.
std::uint64_t key_of(const Face& face) {
  const std::uint64_t two = face[0] | std::uint64_t{face[1]} << 32U;
  return (two ^ two >> 29U) * 0xbf58476d1ce4e5b9U + face[2];
}

/// Sorts four rows without a branch.
void make_ascending(io::TetRows& rows) {
  const auto order = [&](std::size_t i, std::size_t k) {
    const std::uint64_t low = std::min(rows[i], rows[k]), high = std::max(rows[i], rows[k]);
    rows[i] = low;
    rows[k] = high;
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
}

std::size_t corners_beyond(std::span<const io::TetRows> tets, RowSpan span) {
  std::size_t out = 0;
  for (const io::TetRows& rows : tets) {
    for (const std::uint64_t row : rows) out += row - span.first >= span.count ? 1U : 0U;
  }
  return out;
}

}  // namespace

EarlierTets earlier_tets(const LocalTets& tets, std::uint32_t asked) {
  const auto& corners = tets.corners;
  EarlierTets out(corners.size(), {kNoTet, kNoTet, kNoTet, kNoTet});
  NumberTable faces(4 * corners.size());  // of each face, 4 times its last tet and the corner
  for (std::uint32_t t = 0; t < corners.size(); ++t) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      const Face face = face_opposite(corners[t], k);
      if (std::min({face[0], face[1], face[2]}) >= asked) continue;
      std::uint32_t& last = faces.place(key_of(face), [&](std::uint32_t other) {
        const Face known = face_opposite(corners[other / 4], other % 4);
        return known[0] == face[0] && known[1] == face[1] && known[2] == face[2];
      });
      if (last != NumberTable::kFree) out[t][k] = last / 4;
      last = 4 * t + k;
    }
  }
  return out;
}

LocalTets local_tets(std::span<const io::TetRows> tets, RowSpan first) {
  LocalTets out;
  out.corners.reserve(tets.size());
  out.rows.resize(first.count);
  std::iota(out.rows.begin(), out.rows.end(), first.first);
  NumberTable numbers(corners_beyond(tets, first));
  for (io::TetRows rows : tets) {
    make_ascending(rows);
    std::array<std::uint32_t, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      if (rows[i] - first.first < first.count) {
        corners[i] = static_cast<std::uint32_t>(rows[i] - first.first);
        continue;
      }
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

}  // namespace mw::engine
