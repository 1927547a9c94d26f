// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as the mesh of an Abaqus input file.
#include "io/mesh/abaqus/inp_writer.h"

#include "io/file/errors.h"
#include "io/mesh/abaqus/periodic_job.h"
#include "io/mesh/grouped/curved_nodes.h"
#include "io/mesh/grouped/facet_nodes.h"
#include "io/mesh/grouped/fixed_fields.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/medit/medit.h"

namespace mw::io {
namespace {

/// The format marks no end, so a file with the first of these two comments and without the second
/// was cut.
constexpr std::string_view kInpBegins = "** This mesh ends with a comment END OF MESH.";
constexpr std::string_view kInpEnds = "** END OF MESH";

constexpr std::uint64_t kMaxNumber = 999'999'999;

/// The sets of nodes at the ends of a deck, where these are no sides of the box.
constexpr const char* kLowSet = "DECK_LOW";
constexpr const char* kHighSet = "DECK_HIGH";

/// Returns the face of a C3D4 or C3D10 that lies opposite to a corner: S1 has the nodes 1 2 3, S2
/// has 1 4 2, S3 has 2 4 3, S4 has 3 4 1.
const char* face_name(std::uint64_t opposite) {
  constexpr std::array<const char*, 4> kFaces{", S3", ", S4", ", S2", ", S1"};
  return kFaces[opposite];
}

/// Returns `** Grey_matter: label 7 "Grey matter" 255 0 0 255`; the name is empty where that would
/// be longer than the 256 characters that Abaqus allows.
std::string inp_comment(const std::string& set, const LabelName& row, bool is_signed) {
  constexpr std::size_t kMaxBytes = 256;
  const auto comment = [&](const LabelName& told) {
    std::string line = medit_comment(told, is_signed);
    line.pop_back();
    return text("** ", set, ":", line.substr(1));
  };
  const std::string line = comment(row);
  return line.size() > kMaxBytes ? comment({.label = row.label, .colour = row.colour}) : line;
}

/// Refuses tets that CalculiX takes for flat, because its limit does not know of units.
void check_jacobians(std::string_view file, const GroupedMesh& mesh) {
  constexpr double kLeastOfCalculix = 1e-20;
  const double share = mesh.element() == Element::kCurvedTet10 ? kLeastJacobian : 1;
  const double least = share * mesh.least_volume6();
  if (least >= kLeastOfCalculix) return;
  fail_usage(file, ": --deck: CalculiX takes tets with a Jacobian below ", kLeastOfCalculix,
             " for flat, and this mesh has ", least,
             "; mesh it with --spacing in a smaller unit, micrometres for instance");
}

/// Writes numbers in rows of 16 to a line.
class NumberRows {
 public:
  explicit NumberRows(AtomicFile& file) : file_(file) {}

  void add(std::uint64_t number) {
    constexpr std::size_t kMaxItems = 16;  // in a data line
    if (count_ == kMaxItems) end();
    row_ += text(count_++ == 0 ? "" : ", ", number);
  }
  void end() {
    if (count_ > 0) file_.append_line(row_);
    row_.clear();
    count_ = 0;
  }

 private:
  AtomicFile& file_;
  std::string row_;
  std::size_t count_ = 0;
};

}  // namespace

void InpWriter::write(GroupedMesh& mesh) {
  check_number(name_, std::max(mesh.node_count(), mesh.tet_count() + mesh.wedge_count()),
               {.max = kMaxNumber, .subject = "Abaqus has", .others = ".msh or .vtkhdf"});
  if (deck_ != Deck::kNone) check_jacobians(name_, mesh);
  if (rule_) materials_.emplace(mesh, *rule_);
  const PlainNames names(mesh, {.reserved = names_of_others()});
  write_head(mesh, names);
  write_nodes(mesh);
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    write_elements(mesh, mesh.label_tets()[rank], names.volume(rank));
  }
  write_masks(mesh, names);
  write_wedges(mesh, names);
  for_each_named(mesh, names, [&](const NamedFacets& set) {
    write_node_set(mesh, set.name, set.group.facets, false);
    if (set.is_split) write_node_set(mesh, set.other, set.group.facets, true);
    write_surface(mesh, set.name, set.group.facets, false);
    if (!set.other.empty()) write_surface(mesh, set.other, set.group.facets, true);
  });
  if (rule_) write_materials();
  if (deck_ != Deck::kNone && mesh.tet_count() > 0) write_deck(mesh, names);
  line(kInpEnds);
  table_ ? commit_together({*table_, file_}) : file_.commit();
}

/// Returns the names of sets that are neither labels nor facets.
std::vector<std::string> InpWriter::names_of_others() const {
  std::vector<std::string> out;
  if (materials_) out = materials_->names();
  if (deck_ == Deck::kNone) return out;
  out.insert(out.end(), {kLowSet, kHighSet, std::string(kAllElements)});
  if (rule_) out.push_back(rest_set());
  return out;
}

void InpWriter::write_head(const GroupedMesh& mesh, const PlainNames& names) {
  line("*HEADING");
  line(text("Tetrahedra of ", mesh.table().size(), " labels"));
  line(kInpBegins);
  line(
      "** Element set LABEL_7: label 7 (LABEL_M7: -7).  Sets of labels with names are listed "
      "below.");
  line("** Surface FACE_1_2: where labels 1 and 2 meet, faces of the elements of label 1;");
  line("** FACE_2_1: the same faces, of the elements of label 2.");
  line("** Surfaces X_MIN to Z_MAX: sides of the box; OUTER: what else bounds the mesh.");
  line("** Node sets have the nodes of the surface of the same name (FACE_2_1: see FACE_1_2).");
  if (mesh.header().record.has_doubles) {
    line("** Vertices were doubled: where sides are apart, FACE_2_1 has a node set of its own.");
  }
  if (!mesh.wedge_groups().empty()) {
    line("** Element set COHESIVE_1_2: wedges of no thickness between labels 1 and 2, with nodes");
    line("** 1 2 3 on the side of label 1 and 4 5 6 on that of label 2.  They want a section such");
    line("** as *COHESIVE SECTION, ELSET=..., MATERIAL=..., RESPONSE=TRACTION SEPARATION.");
  }
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    const LabelName* const row = mesh.names().find(mesh.table().raw(rank));
    if (row != nullptr) line(inp_comment(names.volume(rank), *row, mesh.table().is_signed()));
  }
}

void InpWriter::write_nodes(GroupedMesh& mesh) {
  line("*NODE");
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    const Position p = mesh.node(row);
    line(text(row + 1, ", ", inp_real(p[0]), ", ", inp_real(p[1]), ", ", inp_real(p[2])));
  }
}

void InpWriter::write_elements(GroupedMesh& mesh, RowRange tets, const std::string& name) {
  const bool quadratic = has_middles(mesh.element());
  line(text("*ELEMENT, TYPE=", quadratic ? "C3D10" : "C3D4", ", ELSET=", name));
  for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
    std::string numbers = text(t + 1);
    for (const std::uint64_t row : mesh.tet_nodes(t)) numbers += text(", ", row + 1);
    line(numbers);
  }
}

void InpWriter::write_masks(const GroupedMesh& mesh, const PlainNames& names) {
  const std::vector<MaskGroup> masks = mask_groups(mesh);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    line(text("*ELSET, ELSET=", names.mask(i)));
    for (const Label rank : masks[i].ranks) line(names.volume(rank));
  }
}

void InpWriter::write_wedges(GroupedMesh& mesh, const PlainNames& names) {
  for (const WedgeGroup& group : mesh.wedge_groups()) {
    line("*ELEMENT, TYPE=COH3D6, ELSET=", names.wedges(group));
    const RowRange wedges = group.wedges;
    for (std::uint64_t w = wedges.begin; w < wedges.end; ++w) {
      std::string numbers = text(mesh.tet_count() + w + 1);
      for (const std::uint64_t row : mesh.wedge_nodes(mesh.wedge(w))) {
        numbers += text(", ", row + 1);
      }
      line(numbers);
    }
  }
}

void InpWriter::write_surface(GroupedMesh& mesh, const std::string& name, RowRange facets,
                              bool of_second) {
  line("*SURFACE, TYPE=ELEMENT, NAME=", name);
  for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
    const Facet facet = mesh.facet(f);
    if (of_second) {
      line(text(facet.second_tet + 1, face_name(facet.second_opposite)));
    } else {
      line(text(facet.tet + 1, face_name(facet.opposite)));
    }
  }
}

void InpWriter::write_node_set(GroupedMesh& mesh, const std::string& name, RowRange facets,
                               bool of_second) {
  line("*NSET, NSET=", name);
  NumberRows rows(file_);
  const auto add = [&](std::uint64_t row) { rows.add(row + 1); };
  for_each_facet_node(mesh, facets, add, of_second);
  rows.end();
}

void InpWriter::write_materials() {
  NumberRows rows(file_);
  std::uint32_t last = 0;
  materials_->for_each([&](std::uint32_t material, std::uint64_t tet) {
    if (material != last) {
      rows.end();
      line("*ELSET, ELSET=", materials_->name(material));
    }
    last = material;
    rows.add(tet + 1);
  });
  rows.end();
  materials_->append_table(*table_);
}

void InpWriter::write_deck(GroupedMesh& mesh, const PlainNames& names) {
  line(deck_ == Deck::kConduction
           ? "** A job to begin with.  1 stands for the conductivity of each material."
           : "** A job to begin with.  1000 and 0.3 stand for modulus and Poisson's ratio of each "
             "material.");
  if (rule_) {
    write_material_sections(mesh);
  } else {
    for (Label rank = 0; rank < mesh.table().size(); ++rank) write_section(names.volume(rank));
  }
  if (deck_ == Deck::kStatic) return write_pull(mesh);
  write_periodic_job(file_, mesh, name_, deck_);
}

/// Writes the step that pulls one end of the mesh.
void InpWriter::write_pull(GroupedMesh& mesh) {
  const DeckEnds ends(mesh);
  const char* const low = ends.are_sides() ? "Z_MIN" : kLowSet;
  const char* const high = ends.are_sides() ? "Z_MAX" : kHighSet;
  if (!ends.are_sides()) {
    write_nodes_where(mesh, low, [&](const Position& p) { return ends.is_low(p); });
    write_nodes_where(mesh, high, [&](const Position& p) { return ends.is_high(p); });
  }
  line("** One end is held, the other is pulled by 1 % of the height of the mesh.");
  line("*BOUNDARY");
  line(low, ", 1, 3");
  line("*STEP");
  line("*STATIC");
  line("*BOUNDARY");
  for (std::size_t k = 0; k < 3; ++k) {
    line(text(high, ", ", k + 1, ", ", k + 1, ", ", inp_real(ends.shift()[k])));
  }
  for (const char* const card : {"*NODE FILE", "U", "*EL FILE", "S", "*END STEP"}) line(card);
}

void InpWriter::write_section(const std::string& set) {
  line("*MATERIAL, NAME=", set);
  for (const char* const card : {deck_ == Deck::kConduction ? "*CONDUCTIVITY" : "*ELASTIC",
                                 deck_ == Deck::kConduction ? "1." : "1000, 0.3"}) {
    line(card);
  }
  line(text("*SOLID SECTION, ELSET=", set, ", MATERIAL=", set));
}

/// Writes a section for each set of a material, and one for the tets that are in none.
void InpWriter::write_material_sections(GroupedMesh& mesh) {
  std::uint64_t in_sets = 0;
  for (std::uint32_t m = 1; m <= materials_->count(); ++m) {
    const MaterialSets::Material& facts = materials_->facts(m);
    in_sets += facts.tets;
    if (facts.tets == 0) continue;
    line(text("** ", materials_->name(m), ": the mean of ", rule_->values, " is ", facts.mean));
    write_section(materials_->name(m));
  }
  if (in_sets == mesh.tet_count()) return;
  line("*ELSET, ELSET=", rest_set());
  NumberRows rows(file_);
  for (std::uint64_t t = 0; t < mesh.tet_count(); ++t) {
    if (materials_->material_of(t) == 0) rows.add(t + 1);
  }
  rows.end();
  write_section(rest_set());
}

template <class Where>
void InpWriter::write_nodes_where(GroupedMesh& mesh, const std::string& name, Where where) {
  line("*NSET, NSET=", name);
  NumberRows rows(file_);
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    if (where(mesh.node(row))) rows.add(row + 1);
  }
  rows.end();
}

}  // namespace mw::io
