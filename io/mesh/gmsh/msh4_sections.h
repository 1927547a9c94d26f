// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The sections of .msh 4.1.
#pragma once

#include "io/mesh/gmsh/msh_content.h"

namespace mw::io {

/// All from behind the line "$Entities" to that of "$EndEntities"; the others alike.
/// ERRORS: see MshInput.
void read_msh4_entities(MshInput& in, MshContent& out);
void read_msh4_nodes(MshInput& in, MshContent& out);
void read_msh4_elements(MshInput& in, MshContent& out);

}  // namespace mw::io
