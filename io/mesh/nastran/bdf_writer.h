// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as Nastran bulk data.
// Format: https://docs.plm.automation.siemens.com/tdoc/nxnastran/10/help/#uid:index
#pragma once

#include "io/mesh/grouped/facet_nodes.h"
#include "io/mesh/grouped/label_numbers.h"

namespace mw::io {

/// Writes GRID in large fields (ten digits), CTETRA of 4 or 10 nodes, and for each label a PSOLID,
/// whose number is the label's in the table beside the file (label_numbers.h), with a MAT1 of that
/// number as a placeholder.  Nodes and tets count from 1.  The nodes of each interface, of each
/// side of the box, and of what else bounds the mesh are a SET of the case control, from 1 on.
/// Faces of tets on them have a PLOAD4 with a pressure of 1 each, in loads of their own numbers
/// from 1 on: one for each side of the box, two for an interface, one on each side.  Comments tell
/// the names (PlainNames) of parts, sets and loads: FACE_1_2 is where labels 1 and 2 meet, FACE_2_1
/// the same on the side of label 2. Memory: 9 MiB.  ERRORS: see AtomicFile; mw::Error(kUsage) above
/// 99,999,999 nodes, tets or labels, which is what eight columns hold.
void write_bdf(TabledFile& file, GroupedMesh& mesh);

}  // namespace mw::io
