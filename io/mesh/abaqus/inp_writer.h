// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as the mesh of an Abaqus input file.
// Format: https://www.dhondt.de/ccx_2.20.pdf
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/material_sets.h"
#include "io/mesh/grouped/plain_names.h"
#include "io/mesh/mesh_extras.h"

namespace mw::io {

/// Writes nodes numbered 1 + row and elements C3D4 or C3D10 from 1 on, in a set for each label,
/// which has the label's name or is LABEL_7 (LABEL_M7 for -7): see PlainNames.  An interface is two
/// surfaces of the same faces, FACE_1_2 of the lower label's elements and FACE_2_1 of the other's,
/// as contact and ties want them; a side of the box is one surface X_MIN .. Z_MAX (or OUTER) of all
/// labels.  The nodes of each, those of an interface once unless vertices were doubled, are a node
/// set of the same name.  Comments tell the set of each named label, with its name and colour as in
/// MEDIT files.
/// A mask is an element set MASK_liver of the sets of its labels.
/// Wedges between the sides of an interface are elements COH3D6 behind the tets, in a set
/// COHESIVE_1_2: their nodes 1 2 3 are on the side of label 1, and 4 5 6 on that of label 2.
/// Between tets of ten nodes they are not written, because Abaqus has no such element.  Materials
/// are element sets beside those of the labels; empty ones are left out.  A deck is a job for
/// CalculiX: a material with placeholders and a section for each label, or for each material and
/// the elements in none, and steps (Deck).
/// Memory: 9 MiB.  ERRORS: see AtomicFile; mw::Error(kUsage) above 999,999,999 nodes or elements,
/// which is all that Abaqus has numbers for, and of a deck with tets too small for CalculiX.
class InpWriter {
 public:
  explicit InpWriter(const std::filesystem::path& path, const MeshExtras& extras)
      : name_(path.string()), file_(path), rule_(extras.materials), deck_(extras.deck) {
    if (rule_) table_.emplace(material_table_path(path));
  }

  /// Writes the mesh and commits the files.  Called once.
  void write(GroupedMesh& mesh);

 private:
  [[nodiscard]] std::vector<std::string> names_of_others() const;
  /// Returns the name of the set of the tets that are in none of a material.
  [[nodiscard]] std::string rest_set() const { return rule_->values + "_none"; }
  void write_head(const GroupedMesh& mesh, const PlainNames& names);
  void write_nodes(GroupedMesh& mesh);
  void write_elements(GroupedMesh& mesh, RowRange tets, const std::string& name);
  void write_masks(const GroupedMesh& mesh, const PlainNames& names);
  void write_wedges(GroupedMesh& mesh, const PlainNames& names);
  void write_surface(GroupedMesh& mesh, const std::string& name, RowRange facets, bool of_second);
  void write_materials();
  void write_deck(GroupedMesh& mesh, const PlainNames& names);
  void write_pull(GroupedMesh& mesh);
  void write_section(const std::string& set);
  void write_material_sections(GroupedMesh& mesh);
  template <class Where>
  void write_nodes_where(GroupedMesh& mesh, const std::string& name, Where where);
  void write_node_set(GroupedMesh& mesh, const std::string& name, RowRange facets, bool of_second);
  void line(std::string_view line, std::string_view more = {}) { file_.append_line(line, more); }

  std::string name_;
  AtomicFile file_;
  std::optional<MaterialRule> rule_;
  std::optional<MaterialSets> materials_;
  std::optional<AtomicFile> table_;  ///< table of the materials
  Deck deck_ = Deck::kNone;
};

}  // namespace mw::io
