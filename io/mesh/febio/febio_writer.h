// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes the geometry of an FEBio model.
// Format: https://help.febio.org/docs/FEBioUser-4-0/UM40.html
#pragma once

#include "io/mesh/grouped/facet_nodes.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/mesh_extras.h"

namespace mw::io {

/// Writes febio_spec 4.0 with what FEBio Studio needs to import a mesh, and nothing that loads it
/// unless a deck is asked for:
///   Material     a neo-Hookean placeholder for each label, with its name; ids are 1 to the number
///                of labels, as FEBio wants them, from M.feb.labels.csv (label_numbers.h)
///   Mesh         Nodes; Elements tet4 or tet10 for each label; a Surface (tri3 or tri6) for each
///                side of the box, and two for each interface: liver|cyst with normals out of the
///                liver, cyst|liver the other way; an ElementSet mask_liver for each mask; all
///                ids count from 1
///   MeshDomains  the material of each part
///   Boundary, Step, LoadData, Output   only with a deck (MeshExtras::deck): a static step of ten
///                increments; where the mesh does not reach both sides there are node sets, too
/// Parts and surfaces have the names of group_names.h, with _2 and so on behind taken ones.
void write_feb(TabledFile& file, GroupedMesh& mesh);

}  // namespace mw::io
