// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as the mesh of an Abaqus input file.
#pragma once

#include <filesystem>
#include <string>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// Nodes are 1 + row, elements C3D4 or C3D10 from 1 on, in a set LABEL_7 a label (LABEL_M7 of
/// -7).  An interface is a surface FACE_1_2 of faces of the lower label's elements, so its normals
/// point out of that; a side of the box is one surface X_MIN .. Z_MAX (or OUTER) of all labels.  Of
/// each the nodes are a node set of the same name.  Labels' names and colours are comments, as in
/// MEDIT files.
/// Memory: 9 MiB.  ERRORS: see AtomicFile; mw::Error(kUsage) above 999,999,999 nodes or elements,
/// which is all that Abaqus has numbers for.
class InpWriter : public GroupedWriter {
 public:
  explicit InpWriter(const std::filesystem::path& path)
      : folder_(path.parent_path()), name_(path.string()), file_(path) {}

  void write(GroupedMesh& mesh) override;

 private:
  void check_counts(const GroupedMesh& mesh) const;
  void write_head(const GroupedMesh& mesh);
  void write_nodes(GroupedMesh& mesh);
  void write_elements(GroupedMesh& mesh, Label rank);
  void write_surface(GroupedMesh& mesh, const std::string& name, RowRange facets);
  void write_node_set(GroupedMesh& mesh, const std::string& name, RowRange facets);
  void line(std::string_view line, std::string_view more = {});

  std::filesystem::path folder_;
  std::string name_;
  AtomicFile file_;
};

}  // namespace mw::io
