// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes tetrahedral .vtkhdf files.
// Format:
// https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/vtkhdf_specifications.html
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/hdf5/hdf5_file.h"
#include "io/mesh/element.h"
#include "io/mesh/field_names.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/vtkhdf/hdf5_output.h"

namespace mw::io {

/// VTKHDF 1.0, one UnstructuredGrid of one partition, which VTK 9.1 and ParaView 5.11 read:
///   /VTKHDF              attributes Version = (1, 0), Type = "UnstructuredGrid"
///     NumberOfPoints, NumberOfCells, NumberOfConnectivityIds   Int64, 1 element
///     Points             Float64 [vertices][3]
///     Connectivity       Int64 [4 tets]; with ten nodes [10 tets], corners and then the middles of
///                        kTetEdges; behind the tets the nodes of wedges (element.h)
///     Offsets            Int64 [cells + 1], where cells are the tets and the wedges behind them
///     Types              UInt8 [cells]: 10, or 24 with ten nodes; for wedges 13, or 31
///     CellData/label     UInt64 or Int64 [cells]; beside it Float64 [cells] for each of the values
///                        and, with wedges, UInt64 `cohesive`: 0, or the number of their interface;
///                        for each mask UInt8 mask_NAME (mask_arrays()): 1 in it, 0 elsewhere
///     FieldData          names of labels, where there are any, as in /mwmesh (add_vtkhdf_facts())
/// There are no time stamps, so equal meshes give equal bytes.
/// Cost: 4 MiB of buffers.  Thread safety: none.
class VtkhdfSink : public ColumnSink {
 public:
  explicit VtkhdfSink(const std::filesystem::path& path, Element element = Element::kTet4)
      : ColumnSink(element), output_(path) {}

  void begin(const MeshHeader& header) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 4 << 20; }

 private:
  Hdf5Output output_;
  ColumnPlaces places_;
};

/// Reads VTKHDF of type UnstructuredGrid, version 1 or 2 (one time step), with its partitions one
/// after the other.  The label is the cell array `label`, else `Label`, `labels`, `material` or
/// `medit:ref`, else the only integer cell array.  Cell arrays of floats with one component are
/// values (value_names()).  The HDF5 library reads in a child process, because damaged files crash
/// it.  Tets with ten nodes are read by their corners, without the middles of edges; curved ones
/// become kTetParts.
/// Memory: batches of 65,536 rows with all their values, whatever the size of the mesh, and a
/// quarter of a byte a node where tets have ten nodes.
/// ERRORS: mw::Error(kInput) with file and place when truncated or corrupt, for cells that are not
/// tetrahedra, without label, or when a row does not exist; what the sink throws.
void read_vtkhdf(const std::filesystem::path& path, MeshSink& sink);

/// Writes names of labels into a group FieldData of `grid`, the arrays of field_names.h that VTK
/// reads.  Their strings have a variable length and are declared ASCII, though they are UTF-8,
/// because VTK 9.1 reads no others.  The HDF5 library does not survive damaged strings of variable
/// length, so this program reads only the numbers there, and names from a copy in `file`,
/// `mwmesh/label_name`: bytes with a NUL behind each.  Likewise the record is `mwmesh/record`.
/// Where there are wedges, FieldData/cohesive_labels has the labels under and on top of them.
/// ENSURES: file and grid have the groups that there are.  ERRORS: see Hdf5Output.
void add_vtkhdf_facts(Hdf5Output& output, const MeshHeader& header, Hdf5Group& file,
                      Hdf5Group& grid);

/// Read names and record; return nothing where the file has none.  `name` is what errors call it.
/// ERRORS: mw::Error(kInput) naming file and data set when they are damaged.
[[nodiscard]] LabelNames read_vtkhdf_names(hid_t file, hid_t grid, const std::string& name);
[[nodiscard]] MeshRecord read_vtkhdf_record(hid_t file, const std::string& name);

}  // namespace mw::io
