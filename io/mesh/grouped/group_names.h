// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What groups of tets and facets are called in files that know names, and their numbers in other
// files.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// Returns "x_min", "x_max" and so on, "outer" or "interface".
[[nodiscard]] const char* side_name(Side side);

/// Returns the label in digits: "7", or "-7" for a negative one.
[[nodiscard]] std::string label_digits(const LabelTable& table, Label rank);

/// Names for people, made of the names of labels.
/// ENSURES: no two labels have one name, and an interface has neither the name of another one nor
/// that of a label.
class GroupNames {
 public:
  /// Where a format cannot write all names, spelled returns a label's name as it can.
  using Spelling = std::function<std::string(const std::string&)>;
  /// Labels with a longer name than max_bytes have plain_volume_name().
  /// REQUIRES: the mesh outlives this.
  explicit GroupNames(const GroupedMesh& mesh, const Spelling& spelled = {},
                      std::size_t max_bytes = std::numeric_limits<std::size_t>::max());

  /// Returns the label's name; "label_7" where it has none, "name (7)" where another has the same
  /// (or is spelled so).  Where that is the name of another label, " (7)" follows once more.
  [[nodiscard]] const std::string& volume(Label rank) const { return volumes_[rank]; }
  /// Returns the names of both labels of an interface, the lower label first: "liver|kidney".  The
  /// labels follow, as in "a|b|c (1|2)", where a name has a '|' or a label is called like that.
  /// Facets on a side of the box have the name of that side, which is the same for all labels.
  [[nodiscard]] std::string facets(const FacetGroup& group) const;

 private:
  [[nodiscard]] bool is_barred(Label rank) const { return barred_.contains(volumes_[rank]); }

  const LabelTable& table_;
  std::vector<std::string> volumes_;
  std::set<std::string> barred_;  ///< those of volumes_ that have a '|'
};

/// Return names by numbers alone: "LABEL_7", "FACE_1_2", "X_MIN", "OUTER".  The label -7 is "M7".
[[nodiscard]] std::string plain_volume_name(const LabelTable& table, Label rank);
[[nodiscard]] std::string plain_facet_name(const LabelTable& table, const FacetGroup& group);

/// The beginning of the names of wedges.
inline constexpr std::string_view kWedgeNames = "COHESIVE_";

/// What a program allows in names; the defaults are those of Abaqus and CalculiX.
struct NameRule {
  std::size_t max_bytes = 80;
  bool allows_dash = true;
  std::vector<std::string> reserved{};  ///< names of something else
};

/// Names for programs that allow only letters, digits, '_' and perhaps '-', a letter first, up to
/// some length, and take small and capital letters for the same.
/// A label has its name with '_' for what is not allowed ("Matrix (epoxy)" is "Matrix_epoxy") and
/// "L_" in front of what begins with no letter; one without a name has plain_volume_name().  An
/// interface is "FACE_a_b" on the side of a, with the names or numbers of its labels; a side of the
/// box has plain_facet_name(); wedges from a to b are "COHESIVE_a_b".
/// ENSURES: no two are the same.  Those that would be, or are too long, end in numbers of labels.
class PlainNames {
 public:
  explicit PlainNames(const GroupedMesh& mesh, const NameRule& rule = {});

  [[nodiscard]] const std::string& volume(Label rank) const { return volumes_[rank]; }
  /// Returns the name on the side of the group's first label, or of an interface's second one.
  [[nodiscard]] std::string facets(const FacetGroup& group, bool of_second = false) const;
  /// Returns the name of a group by its number in GroupedMesh::wedge_groups().
  [[nodiscard]] const std::string& wedges(std::size_t group) const { return wedges_[group]; }
  /// Returns a name for something else: this one or, if it is taken or too long, one like it.
  [[nodiscard]] std::string add(const std::string& wanted) { return take(wanted, "1"); }

 private:
  void name_volumes(const GroupedMesh& mesh);
  void name_interface(const GroupedMesh& mesh, Label from, Label to);
  /// Returns "a_b", with the names or numbers of these labels.
  [[nodiscard]] std::string pair_text(const GroupedMesh& mesh, Label one, Label other) const;
  /// Takes the name or, where it is too long or taken, its beginning with the number behind.
  [[nodiscard]] std::string take(const std::string& wanted, const std::string& number);

  NameRule rule_;
  std::vector<std::string> volumes_;
  std::map<std::pair<Label, Label>, std::string> interfaces_;  ///< by the label that is inside
  std::vector<std::string> wedges_;
  std::set<std::string> taken_;  ///< in capitals
};

/// A run of facets under one number.
struct NumberedFacets {
  std::int64_t number = 0;
  std::string name;  ///< see GroupNames::facets
  Side side = Side::kInterface;
  Label first = kExterior;  ///< with second, the ranks of an interface's labels; else kExterior
  Label second = kExterior;
  RowRange facets;
};

/// Returns the runs in the order of their facets; each facet is in one run.  Sides of the box have
/// the numbers 1 to 6 (x_min, x_max, y_min, y_max, z_min, z_max), the outer surface has 7, whatever
/// the mesh; all labels share them.  Interfaces have 8 and more, ascending by their two labels.
[[nodiscard]] std::vector<NumberedFacets> number_facets(const GroupedMesh& mesh);

/// Returns the path of the table beside a mesh: M.facets.csv for M.xdmf.
[[nodiscard]] std::filesystem::path facet_table_path(const std::filesystem::path& mesh);

/// Appends the content of that table, with the columns number, name, side, first, second; the last
/// two are the labels of an interface and else empty.  The file is to be committed with the mesh
/// (commit_together()).  ERRORS: see AtomicFile.
void append_facet_table(AtomicFile& file, const LabelTable& table,
                        const std::vector<NumberedFacets>& facets);

}  // namespace mw::io
