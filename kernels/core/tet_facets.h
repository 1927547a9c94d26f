// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The facets of a tet by its corners.
#pragma once

#include <array>
#include <cstddef>

namespace mw {

/// The corners of the facet opposite to each corner of a positive tet, normal outwards.
inline constexpr std::array<std::array<std::size_t, 3>, 4> kTetFacets{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace mw
