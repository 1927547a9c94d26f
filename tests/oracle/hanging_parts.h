// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What hangs together in a mesh by the definition: floods over maps of faces, edges and vertices.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <vector>

#include "kernels/audit/subject.h"

namespace mw::audit::test {

/// Tells whether the face that two neighbours share joins them.
using Joins = std::function<bool(std::size_t one, std::size_t other)>;

/// The number of the set of each tet of `among`: tets are in one set when a chain of faces joins
/// them that have all vertices of `common` and that joins() lets.
[[nodiscard]] std::map<std::size_t, std::size_t> sets_joined_by_faces(
    const std::vector<TetRow>& tets, const std::set<std::size_t>& among,
    const std::set<std::uint64_t>& common, const Joins& joins = {});

struct Hinges {
  std::set<std::uint64_t> vertices;
  std::set<std::pair<std::uint64_t, std::uint64_t>> edges;  ///< lower row first
};

/// Edges around which tets are several sets, and vertices around which they are several even when
/// such edges join them.
[[nodiscard]] Hinges hinges_of(const std::vector<TetRow>& tets, const std::set<std::size_t>& among);

/// The tets at each vertex.
[[nodiscard]] std::map<std::uint64_t, std::set<std::size_t>> stars_of(
    const std::vector<TetRow>& tets, const std::set<std::size_t>& among);

}  // namespace mw::audit::test
