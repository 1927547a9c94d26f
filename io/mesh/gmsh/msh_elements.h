// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Element types of .msh files.
#pragma once

#include <cstdint>

namespace mw::io {

inline constexpr std::int32_t kMshTriangle3 = 2;
inline constexpr std::int32_t kMshTet4 = 4;
inline constexpr std::int32_t kMshTriangle6 = 9;
inline constexpr std::int32_t kMshTet10 = 11;

/// How many nodes an element of the type has; 0 for types not known here.
[[nodiscard]] std::uint64_t msh_nodes_of(std::int64_t type);

/// Tets of any order: the first four nodes are their corners.
[[nodiscard]] bool is_msh_tet(std::int64_t type);

}  // namespace mw::io
