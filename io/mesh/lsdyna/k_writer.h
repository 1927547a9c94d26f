// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as a keyword file of LS-DYNA.
// Format: https://lsdyna.ansys.com/manuals/
#pragma once

#include "io/mesh/grouped/facet_nodes.h"
#include "io/mesh/grouped/label_numbers.h"

namespace mw::io {

/// Writes a PART for each label, whose number is the label's in the table beside the file
/// (label_numbers.h) and whose title is its name (PlainNames), with a MAT_ELASTIC of the same
/// number as a placeholder; all have one SECTION_SOLID of ELFORM 10, or 16 for ten nodes.
/// ELEMENT_SOLID has a tet of four nodes in one line, with its last node five times, and one of ten
/// nodes in two lines.  Nodes and tets count from 1.  The nodes of each interface and of each side
/// of the box are a SET_NODE_LIST (two for an interface if the mesh has doubled vertices).  The
/// triangles are a SET_SEGMENT with normals out of the mesh, or two for an interface, where
/// FACE_1_2 has normals out of label 1; titles tell the names.  With ten nodes each triangle is
/// written as four, so that the middles of edges are loaded, too.  A mask is a SET_PART_LIST of the
/// parts of its labels.  All kinds of sets have numbers from 1 on.  Coordinates have ten digits.
/// Memory: 9 MiB.  ERRORS: see AtomicFile; mw::Error(kUsage) above 99,999,999 nodes or tets, which
/// is what eight columns hold, and for a negative coordinate with three digits of exponent.
void write_k(TabledFile& file, GroupedMesh& mesh);

}  // namespace mw::io
