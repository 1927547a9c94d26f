// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The sections of .msh 2.2, in which many tools still write.
#pragma once

#include "io/mesh/gmsh/msh_content.h"

namespace mw::io {

/// As read_msh4_nodes(); marks are physical groups, or entities where there is none.
/// ERRORS: see MshInput.
void read_msh2_nodes(MshInput& in, MshContent& out);
void read_msh2_elements(MshInput& in, MshContent& out);

}  // namespace mw::io
