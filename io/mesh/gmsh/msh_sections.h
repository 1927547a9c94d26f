// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the sections of .msh files in both versions into one content.
#pragma once

#include <limits>
#include <map>

#include "io/file/errors.h"
#include "io/mesh/gmsh/msh_input.h"
#include "io/mesh/tagged_mesh.h"

namespace mw::io {

/// What the sections hold.  The mark of a tet is a number, in version 4 that of its entity.
struct MshContent {
  explicit MshContent(const std::string& file) : mesh(file) {}

  TaggedMesh mesh;
  std::map<std::int64_t, std::int64_t> physical_of;  ///< by volume, if in one
  std::map<std::int64_t, std::string> names;         ///< those of physical volumes
  std::uint64_t elements = 0;                        ///< number of elements of all types
  MeshRecord record;                                 ///< what a comment tells, or nothing
  std::vector<std::uint64_t> numbers{};              ///< those of tets as elements
  std::vector<TetValues> values{};                   ///< under the names in the file
};

// ERRORS (all functions): see MshInput.

/// Returns the number of a physical group, whose sign tells the orientation.
[[nodiscard]] inline std::int64_t without_sign(const MshInput& in, std::int64_t group) {
  if (group == std::numeric_limits<std::int64_t>::min()) {
    in.fail(text(group, " is no number of a physical group"));
  }
  return group < 0 ? -group : group;
}

/// Read a section of version 4.1, from behind its first line, such as "$Entities", to its last.
void read_msh4_entities(MshInput& in, MshContent& out);
void read_msh4_nodes(MshInput& in, MshContent& out);
void read_msh4_elements(MshInput& in, MshContent& out);

/// Read a section of version 2.2, which many tools still write; marks are physical groups, or
/// entities where there is none.
void read_msh2_nodes(MshInput& in, MshContent& out);
void read_msh2_elements(MshInput& in, MshContent& out);

/// Reads the sections behind the elements in both versions: from each ElementData with one
/// component the values of tets, NaN for a tet without one.  Sections without a value for any tet
/// are left out, and so are those beyond kMostValues.
void read_msh_values(MshInput& in, MshContent& out);

}  // namespace mw::io
