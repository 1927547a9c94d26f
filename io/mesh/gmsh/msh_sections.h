// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The sections of .msh files in both versions, and what they have in common once they are read.
#pragma once

#include <map>

#include "io/mesh/gmsh/msh_input.h"
#include "io/mesh/tagged_mesh.h"

namespace mw::io {

/// Marks of tets are numbers, in version 4 of entities.
struct MshContent {
  explicit MshContent(const std::string& file) : mesh(file) {}

  TaggedMesh mesh;
  std::map<std::int64_t, std::int64_t> physical_of;  ///< volumes in a physical group
  std::map<std::int64_t, std::string> names;         ///< of physical volumes
  std::uint64_t elements = 0;                        ///< of all types
  MeshRecord record;                                 ///< what a comment tells, or nothing
  std::vector<std::uint64_t> numbers{};              ///< of tets as elements
  std::vector<TetValues> values{};                   ///< under the names in the file
};

// ERRORS of all: see MshInput.

/// Version 4.1: all from behind the line "$Entities" to that of "$EndEntities"; the others alike.
void read_msh4_entities(MshInput& in, MshContent& out);
void read_msh4_nodes(MshInput& in, MshContent& out);
void read_msh4_elements(MshInput& in, MshContent& out);

/// Version 2.2, in which many tools still write; marks are physical groups, or entities where there
/// is none.
void read_msh2_nodes(MshInput& in, MshContent& out);
void read_msh2_elements(MshInput& in, MshContent& out);

/// The sections behind the elements, of both versions: of each ElementData with one component the
/// values of tets; a tet without one has NaN.  Those that have none of a tet are left out, like
/// what is more than kMostValues.
void read_msh_values(MshInput& in, MshContent& out);

}  // namespace mw::io
