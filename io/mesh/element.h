// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Nodes of a tet in a file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "kernels/core/error.h"

namespace mw::io {

enum class Element : std::uint8_t {
  kTet4,   ///< its corners
  kTet10,  ///< and the middles of its edges, on straight edges
};

[[nodiscard]] constexpr std::uint64_t node_count(Element element) {
  return element == Element::kTet10 ? 10 : 4;
}

/// "tet4", "tet10".  ERRORS: mw::Error(kUsage).
[[nodiscard]] inline Element parse_element(std::string_view text) {
  if (text == "tet4") return Element::kTet4;
  if (text == "tet10") return Element::kTet10;
  throw Error(ErrorKind::kUsage,
              "'" + std::string(text) + "' is no element; those are tet4 and tet10");
}

/// Cell types of VTK's files; the ten nodes of theirs are in the order of kTetEdges.
inline constexpr std::uint8_t kVtkTetra = 10;
inline constexpr std::uint8_t kVtkQuadraticTetra = 24;

[[nodiscard]] constexpr std::uint8_t vtk_type(Element element) {
  return element == Element::kTet10 ? kVtkQuadraticTetra : kVtkTetra;
}

}  // namespace mw::io
