// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/pieces/pvtu.h"

#include <algorithm>
#include <numeric>

#include "kernels/core/assert.h"

namespace mw::io {
namespace {

using Rows = std::span<std::uint64_t>;

/// Returns four times the barycentre, since only the order of barycentres matters.
Position sum_of_corners(const MeshData& mesh, const TetRows& tet) {
  Position sum{};
  for (const std::uint64_t v : tet) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += mesh.vertices[v][k];
  }
  return sum;
}

class Halving {
 public:
  explicit Halving(const MeshData& mesh) {
    at_.reserve(mesh.tets.size());
    for (const TetRows& tet : mesh.tets) at_.push_back(sum_of_corners(mesh, tet));
  }

  void cut(Rows rows, std::uint64_t pieces, std::vector<std::vector<std::uint64_t>>& out) const {
    if (pieces == 1) {
      out.emplace_back(rows.begin(), rows.end());
      std::sort(out.back().begin(), out.back().end());
      return;
    }
    // Each piece has the same number of tets, and the first ones have one more where some are left.
    const std::uint64_t below = pieces / 2;
    const std::uint64_t count =
        rows.size() / pieces * below + std::min<std::uint64_t>(rows.size() % pieces, below);
    const std::size_t axis = longest_side(rows);
    const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(rows.begin(), middle, rows.end(), [&](std::uint64_t a, std::uint64_t b) {
      return std::pair(at_[a][axis], a) < std::pair(at_[b][axis], b);
    });
    cut(rows.first(count), below, out);
    cut(rows.subspan(count), pieces - below, out);
  }

 private:
  [[nodiscard]] std::size_t longest_side(Rows rows) const {
    Position lo = at_[rows.front()], hi = lo;
    for (const std::uint64_t row : rows) {
      for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], at_[row][k]);
        hi[k] = std::max(hi[k], at_[row][k]);
      }
    }
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (hi[k] - lo[k] > hi[longest] - lo[longest]) longest = k;
    }
    return longest;
  }

  std::vector<Position> at_;
};

}  // namespace

std::vector<std::vector<std::uint64_t>> mesh_parts(const MeshData& mesh, std::uint64_t pieces) {
  MW_ASSERT(pieces >= 1 && pieces <= mesh.tets.size());
  std::vector<std::uint64_t> rows(mesh.tets.size());
  std::iota(rows.begin(), rows.end(), std::uint64_t{0});
  std::vector<std::vector<std::uint64_t>> out;
  out.reserve(pieces);
  Halving(mesh).cut(rows, pieces, out);
  return out;
}

}  // namespace mw::io
