// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads Gmsh's .msh files of versions 4.1 and 2.2, and writes them as .msh and .msh2.
// Format: https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format
#pragma once

#include <filesystem>

#include "io/file/sink/partial_file.h"
#include "io/mesh/gmsh/msh_common.h"
#include "io/mesh/gmsh/node_classes.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/mesh_data.h"
#include "io/mesh/mesh_extras.h"

namespace mw::io {

/// Reads versions 4.1 and 2.2, as text or binary of either byte order, also gzipped.  Takes the
/// corners of tets of every order, and skips other elements.  Rows are nodes by their tags.  The
/// first physical group of a tet's volume, or the volume's tag where it is in none, gives the
/// label: the number itself, or what the table beside the file has for it (append_label_table).
/// Without a table, names are those of physical volumes.  The record is that of a comment, where
/// write_msh() has left one; the wedges follow from it.  Values are those of sections ElementData
/// with one component, under the names of their views (value_names()).  ERRORS: mw::Error(kInput)
/// with file and place; also for other versions, partitioned meshes, and elements of which none is
/// a tet.
[[nodiscard]] MeshData read_msh(const std::filesystem::path& path);

/// Writes a volume for each label, whose tag and physical group are the label's number
/// (LabelNumbers, from 1 to what leaves room for the surfaces), and a surface for each facet group,
/// with normals out of the lower label.  Where L is the largest number of a label in the file,
/// surfaces are tagged from L + 1 on.  Physical surfaces are L + 1 x_min, L + 2 x_max, .. L + 6
/// z_max, L + 7 outer, each for all labels together, and from L + 8 on the interfaces, in the order
/// of their labels.  Names are GroupNames'; those that are longer than Gmsh reads are "LABEL_7",
/// "FACE_1_2".  Nodes are tagged 1 + row, triangles and tets from 1 on.
/// A mask is one more physical volume, "mask_liver", with a tag above all others: the volumes of
/// its labels are in both.  A comment holds the record where there are masks, wedges or curves.
/// Wedges between the sides of an interface are prisms in a volume of their own, with a tag above
/// those of surfaces and a name such as COHESIVE_1_2.  Between tets of ten nodes they would need
/// nodes between the two sides, and are not written.  Materials are one more ElementData,
/// "hu_material" for values "hu", 0 where there is no value.  The tables of labels and of materials
/// are written beside the mesh.  Entities may be in several pieces, which Gmsh's createTopology()
/// parts, forgetting their groups; createTopology(False) keeps them.
void write_msh(MshFiles& files, GroupedMesh& mesh);

/// Writes the groups, numbers and tables of write_msh() in version 2.2, as text, for programs that
/// read no later one (GetFEM, OpenFOAM's gmshToFoam); Gmsh's own ending for it is .msh2.  Names are
/// PlainNames', as such programs take no blanks and marks: "Left_kidney", "FACE_liver_kidney";
/// sides are x_min and so on.  Elements are triangles, then tets, then wedges.
void write_msh2(MshFiles& files, GroupedMesh& mesh);

}  // namespace mw::io
