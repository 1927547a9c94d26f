// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as a blocked database file of Ansys Mechanical APDL.
// Format: https://ansyshelp.ansys.com/public/Views/Secured/corp/v242/en/ans_prog/Hlp_P_INT3_3.html
#pragma once

#include "io/mesh/grouped/facet_nodes.h"
#include "io/mesh/grouped/label_numbers.h"

namespace mw::io {

/// Writes NBLOCK, and EBLOCK with tets of type 1: SOLID285, or SOLID187 with ten nodes.  The
/// material of a tet is the number of its label in the table beside the file (label_numbers.h),
/// from 1 to the number of labels, with EX and PRXY as placeholders; a component of elements has
/// the label's name (PlainNames, with at most 32 characters, and '_' for '-'), and that of a mask
/// is MASK_liver.  The nodes of each interface and side of the box are a component of nodes, such
/// as X_MIN (two for an interface if the mesh has doubled vertices).  The triangles are elements
/// MESH200 of type 2, which no solution sees, in a component F_X_MIN; an interface has two,
/// F_FACE_1_2 with normals out of label 1, and F_FACE_2_1 the other way.  Nodes and elements count
/// from 1, tets first. Memory: 9 MiB.  ERRORS: see AtomicFile; mw::Error(kUsage) above 99,999,999
/// nodes or elements, since fields have nine columns and one stays blank.
void write_cdb(TabledFile& file, GroupedMesh& mesh);

}  // namespace mw::io
