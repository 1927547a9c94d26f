// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The nodes that tets and wedges have in a file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/file/errors.h"

namespace mw::io {

enum class Element : std::uint8_t {
  kTet4,         ///< its corners
  kTet10,        ///< its corners and the middles of its edges, which are straight
  kCurvedTet10,  ///< ten nodes, with edges of interfaces curved (grouped/curved_nodes.h)
};

/// True if tets have nodes on their edges.
[[nodiscard]] constexpr bool has_middles(Element element) {
  return element != Element::kTet4;
}

[[nodiscard]] constexpr std::uint64_t node_count(Element element) {
  return has_middles(element) ? 10 : 4;
}

/// Reads "tet4", "tet10" or "tet10-curved".  ERRORS: mw::Error(kUsage) for another text.
[[nodiscard]] inline Element parse_element(std::string_view text) {
  if (text == "tet4") return Element::kTet4;
  if (text == "tet10") return Element::kTet10;
  if (text == "tet10-curved") return Element::kCurvedTet10;
  fail_usage("'" + std::string(text) + "' is no element; those are tet4, tet10 and tet10-curved");
}

/// VTK's cell types for tets; behind the corners, the second has the middles of kTetEdges.
inline constexpr std::uint8_t kVtkTetra = 10;
inline constexpr std::uint8_t kVtkQuadraticTetra = 24;

[[nodiscard]] constexpr std::uint8_t vtk_type(Element element) {
  return has_middles(element) ? kVtkQuadraticTetra : kVtkTetra;
}

/// Returns the number of nodes of a wedge between tets of that kind.
[[nodiscard]] constexpr std::uint64_t wedge_node_count(Element element) {
  return has_middles(element) ? 12 : 6;
}

/// VTK's cell types for wedges: the second has nodes in the middles of the edges of its two
/// triangles, and none between these.
inline constexpr std::uint8_t kVtkWedge = 13;
inline constexpr std::uint8_t kVtkQuadraticLinearWedge = 31;

[[nodiscard]] constexpr std::uint8_t vtk_wedge_type(Element element) {
  return has_middles(element) ? kVtkQuadraticLinearWedge : kVtkWedge;
}

[[nodiscard]] constexpr bool is_vtk_wedge(std::uint64_t type) {
  return type == kVtkWedge || type == kVtkQuadraticLinearWedge;
}

/// Returns the number of nodes of a tet or, with has_wedges, of a wedge; 0 for other cell types.
[[nodiscard]] constexpr std::uint64_t vtk_nodes_of(std::uint64_t type, bool has_wedges) {
  if (type == kVtkTetra) return node_count(Element::kTet4);
  if (type == kVtkQuadraticTetra) return node_count(Element::kTet10);
  if (!has_wedges || !is_vtk_wedge(type)) return 0;
  return wedge_node_count(type == kVtkWedge ? Element::kTet4 : Element::kTet10);
}

/// The order in which VTK has the nodes of a wedge (NodeRows of grouped/grouped_mesh.h): the normal
/// of its first triangle points away from the second one, unlike in all other formats.
inline constexpr std::array<std::size_t, 12> kVtkWedgeOrder{0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9};

}  // namespace mw::io
