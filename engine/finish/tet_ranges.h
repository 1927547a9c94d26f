// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Looks at all tets of a finished mesh on all threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/system/in_order.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::engine {

/// How a pass looks at tets.
struct TetWork {
  WorkInOrder how{};
  std::function<void()> between = [] {};  ///< called often; may throw

  /// Memory of one range of tets, with the reader of its corners.
  static constexpr std::uint64_t kRangeBytes = std::uint64_t{1} << 20U;
};

/// Tets that follow one another.
struct TetRange {
  static constexpr std::uint64_t kTets = 8192;

  std::uint64_t first = 0;  ///< the number of the first one in the mesh
  std::vector<io::TetRows> tets;
  std::vector<RawLabel> labels;
};

/// Calls merge(work(range, corners)) for ranges of tets, which several threads work on; merge is
/// called by one thread at a time, in the order of the tets.
/// Memory: how.at_once times kRangeBytes and a result.  ERRORS: what they throw; see ScratchMesh.
template <typename Result>
void each_tet_range(
    io::ScratchMesh& mesh, const TetWork& work,
    const std::type_identity_t<std::function<Result(const TetRange&, io::CornerReader&)>>& look,
    const std::type_identity_t<std::function<void(Result&&)>>& merge) {
  mesh.settle();
  const std::uint64_t tets = mesh.tet_count();
  each_in_order<Result>(
      work.how, (tets + TetRange::kTets - 1) / TetRange::kTets,
      [&](std::uint64_t i) {
        TetRange range{.first = i * TetRange::kTets, .tets = {}, .labels = {}};
        range.tets.resize(std::min(TetRange::kTets, tets - range.first));
        range.labels.resize(range.tets.size());
        mesh.read_tets(range.first, range.tets, range.labels);
        io::CornerReader corners(mesh);
        return look(range, corners);
      },
      [&](std::uint64_t, Result&& found) {
        work.between();
        merge(std::move(found));
      });
}

}  // namespace mw::engine
