// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a mesh as XDMF over HDF5, with tags as dolfinx reads them.
// Format: https://www.xdmf.org/index.php/XDMF_Model_and_Format
#pragma once

#include <string>
#include <vector>

#include "io/mesh/grouped/group_names.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/vtkhdf/hdf5_output.h"

namespace mw::io {

/// Writes XDMF 3 into M.xdmf, which gets its name last.  One domain has three grids:
///   mesh        the tets; cell attribute `label`, the labels themselves (UInt64 or Int64), one for
///               each of the values (Float64), and mask_NAME for each mask (UInt8, 1 in it)
///   cell_tags   the same tets; cell attribute `cell_tags`, Int32 numbers (label_numbers.h)
///   facet_tags  the triangles; cell attribute `facet_tags`, Int32 numbers (group_names.h)
/// The last two have an Information for each number: its Name is that of the group, its Value the
/// number.  The domain has an Information `mwmesh`, the record of the run (mesh_record.h).
/// The arrays of all grids are in M.h5:
///   /Mesh/mesh/geometry            Float64 [nodes][3]
///   /Mesh/mesh/topology            Int64 [tets][4 or 10], ten nodes in the order of kTetEdges
///   /Mesh/mesh/label               UInt64 or Int64 [tets]
///   /MeshTags/cell_tags/Values     Int32 [tets]
///   /MeshTags/facet_tags/topology  Int64 [facets][3 or 6], normal out of the lower label
///   /MeshTags/facet_tags/Values    Int32 [facets]
///   /Values/NAME                   Float64 [tets], for each of the values
///   /Masks/1, /Masks/2, ...        UInt8 [tets], for each mask
/// The root of M.h5 has an attribute `writer`, which is "mwmesh", and M.cells.xdmf a comment at its
/// end that says so, too, for those who want to know whose these files are.
/// M.cells.xdmf has only the grid `mesh`, for readers that take one grid from a file (meshio).  The
/// tables are M.xdmf.labels.csv and M.facets.csv.
/// ERRORS: see AtomicFile; mw::Error(kUsage) for a name with ':', at which readers would end that
/// of M.h5.
class XdmfWriter {
 public:
  XdmfWriter(const std::filesystem::path& path, const MeshExtras& extras);
  /// Writes the mesh and commits the files.  Called once.
  void write(GroupedMesh& mesh);

 private:
  // Each of these writes a data set and returns it.
  [[nodiscard]] Hdf5DataSet nodes(GroupedMesh& mesh);
  [[nodiscard]] Hdf5DataSet topology(GroupedMesh& mesh);
  [[nodiscard]] Hdf5DataSet labels(const GroupedMesh& mesh);
  [[nodiscard]] Hdf5DataSet value(GroupedMesh& mesh, std::size_t column);
  [[nodiscard]] Hdf5DataSet mask_cells(const GroupedMesh& mesh, const MaskLabels& mask,
                                       const std::string& name);
  [[nodiscard]] Hdf5DataSet cell_tags(const GroupedMesh& mesh, const LabelNumbers& numbers);
  [[nodiscard]] Hdf5DataSet facets(GroupedMesh& mesh);
  [[nodiscard]] Hdf5DataSet facet_tags(const GroupedMesh& mesh, const GroupNames& names);

  void write_grids(const GroupedMesh& mesh, const GroupNames& names, const LabelNumbers& numbers);

  std::filesystem::path path_;
  AtomicFile file_;
  AtomicFile cells_;
  Hdf5Output numbers_;
  AtomicFile labels_;
  AtomicFile facets_;
};

/// Return the paths of M.h5 and M.cells.xdmf for M.xdmf.
[[nodiscard]] std::filesystem::path xdmf_numbers_path(const std::filesystem::path& xdmf);
[[nodiscard]] std::filesystem::path xdmf_cells_path(const std::filesystem::path& xdmf);

}  // namespace mw::io
