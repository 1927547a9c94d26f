// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the two versions of .msh have in common once they are read.
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
};

}  // namespace mw::io
