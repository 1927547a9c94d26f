// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as Exodus II, which MOOSE, Sierra, MFEM and ParaView read.
// Format: https://sandialabs.github.io/seacas-docs/exodusII-new.pdf
#pragma once

#include "io/mesh/exodus/netcdf_output.h"
#include "io/mesh/grouped/facet_nodes.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/grouped/material_sets.h"
#include "io/mesh/grouped/plain_names.h"
#include "io/mesh/mesh_extras.h"

namespace mw::io {

/// Writes a block of TETRA or TETRA10 for each label, whose id is the label's number in the table
/// beside the file (label_numbers.h) and whose name is PlainNames'.  There are two side sets for
/// each interface, FACE_1_2 of the tets of label 1 and FACE_2_1 of those of label 2; one for each
/// side of the box (X_MIN to Z_MAX), and OUTER for what else bounds the mesh.  The nodes of each of
/// these, those of an interface once unless vertices were doubled, are a node set of the same name.
/// Side sets have ids from 1 on, and a node set has the id of the side set of its name: libMesh has
/// one numbering for both, so that another id would join the nodes of two names.
/// Faces of elements are numbered as Exodus II does: side 1 has the nodes 1 2 4, side 2 has 2 3 4,
/// side 3 has 1 4 3, side 4 has 1 3 2.
/// Wedges between the sides of an interface are blocks of WEDGE behind those of labels, with ids
/// above theirs and names such as COHESIVE_1_2; between tets of ten nodes they are not written,
/// because VTK's reader and libMesh know no wedge of 12 nodes.
/// Masks (MASK_liver) and materials are element sets; materials without elements are left out.
/// Memory: 26 MiB.
/// ERRORS: see NetcdfOutput; mw::Error(kUsage) above 2,147,483,647 nodes or elements.
class ExodusWriter {
 public:
  explicit ExodusWriter(const std::filesystem::path& path, const MeshExtras& extras)
      : name_(path.string()), out_(path), labels_(label_table_path(path)), rule_(extras.materials) {
    if (rule_) table_.emplace(material_table_path(path));
  }

  /// Writes the mesh and commits the files.  Called once.
  void write(GroupedMesh& mesh);

 private:
  /// Facets as one of their labels has them, or the nodes of these.
  struct FacetSet {
    std::string name;
    RowRange facets;
    int id = 0;
    bool of_second = false;
    bool has_nodes = true;  ///< whether there is a node set of the name
  };
  /// A set of the elements of a material, or of a mask.
  struct ElementSet {
    std::string name;
    std::uint64_t tets = 0;
    std::uint32_t material = 0;         ///< 0 for a mask
    std::vector<RowRange> of_labels{};  ///< of a mask
    int variable = 0;
  };
  /// The contents of the file, with the variables that hold them.
  struct Plan {
    PlainNames names;
    std::vector<int> ids{};        ///< of blocks: by rank of label; then those of wedges
    std::vector<int> side_sets{};  ///< ids
    int side_variable = 0;  ///< the first one; each side set has one of elements and one of sides
    std::vector<int> node_sets{};  ///< ids
    int node_variable = 0;         ///< the first one; each node set has one
    std::vector<ElementSet> element_sets{};
    std::array<int, 3> coordinates{};
    std::vector<int> connectivity{};  ///< by block
    int value_names = 0;
    int time = 0;
    std::vector<std::vector<int>> values{};  ///< by name, by block
  };
  /// The variables that hold status, id and name of each member of a list.
  struct ListVariables {
    int status = 0;
    int ids = 0;
    int names = 0;
  };

  template <class Visit>
  static void for_each_side_set(const GroupedMesh& mesh, const PlainNames& names, Visit visit);
  template <class Visit>
  static void for_each_node_set(const GroupedMesh& mesh, const PlainNames& names, Visit visit);
  [[nodiscard]] Plan plan_of(const GroupedMesh& mesh, const LabelNumbers& numbers) const;
  void plan_element_sets(const GroupedMesh& mesh, Plan& plan) const;
  void define(GroupedMesh& mesh, Plan& plan);
  /// The dimension's length is the number of members, and `prefix` begins the variables' names.
  ListVariables define_list(const std::string& dimension, const std::string& prefix,
                            std::size_t members);
  /// Writes status and ids; names follow.
  void write_list(const ListVariables& list, std::span<const int> ids);
  void write_block_list(const GroupedMesh& mesh, const Plan& plan);
  void define_facet_sets(GroupedMesh& mesh, Plan& plan);
  void write_facet_sets(GroupedMesh& mesh, const Plan& plan);
  /// elements holds the dimension of each block.
  void define_values(const GroupedMesh& mesh, Plan& plan, const std::vector<int>& elements);
  [[nodiscard]] std::vector<int> define_blocks(const GroupedMesh& mesh, Plan& plan);
  void write_nodes(GroupedMesh& mesh, const Plan& plan);
  void write_values(GroupedMesh& mesh, const Plan& plan);
  void write_block(GroupedMesh& mesh, RowRange tets, int variable);
  void write_wedges(GroupedMesh& mesh, const Plan& plan);
  void write_side_set(GroupedMesh& mesh, const FacetSet& set, int variable);
  void write_node_set(GroupedMesh& mesh, const FacetSet& set, int variable);
  void define_element_sets(Plan& plan);
  void write_element_sets(const Plan& plan);
  void write_masks(const Plan& plan);
  void write_materials(const Plan& plan);

  std::string name_;
  NetcdfOutput out_;
  AtomicFile labels_;
  std::optional<MaterialRule> rule_;
  std::optional<AtomicFile> table_;  ///< table of the materials
  std::optional<MaterialSets> materials_;
  int name_length_ = 0;  ///< a dimension that several lists have
  int time_step_ = 0;
  ListVariables block_list_;
  ListVariables side_set_list_;
  ListVariables node_set_list_;
  ListVariables element_set_list_;
};

}  // namespace mw::io
