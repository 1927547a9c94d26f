// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What groups of tets and facets are called in files of programs that allow few characters.
#pragma once

#include <compare>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

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
  std::string of_triangles{};           ///< the beginning of PlainNames::triangles(), if there are
};

/// Returns a name with '_' for each gap of characters that are not allowed, and "L_" in front of
/// what begins with no letter; empty where no character is allowed.  Its length is not looked at.
[[nodiscard]] std::string plain_name(std::string_view name, const NameRule& rule = {});

/// Names for programs that allow only letters, digits, '_' and perhaps '-', a letter first, up to
/// some length, and take small and capital letters for the same.
/// A label has its name with '_' for what is not allowed ("Matrix (epoxy)" is "Matrix_epoxy") and
/// "L_" in front of what begins with no letter; one without a name has plain_volume_name().  An
/// interface is "FACE_a_b" on the side of a, with the names or numbers of its labels; a side of the
/// box has plain_facet_name(); wedges from a to b are "COHESIVE_a_b"; a mask is "MASK_a".
/// ENSURES: no two are the same.  Those that would be, or are too long, end in numbers of labels.
/// Memory: names of labels; those of interfaces are made when they are asked for.  The constructor
/// takes 8 MiB more, and what does not fit waits in a temporary file.  ERRORS: see ScratchFile.
class PlainNames {
 public:
  /// REQUIRES: the mesh outlives this.
  explicit PlainNames(const GroupedMesh& mesh, const NameRule& rule = {});

  [[nodiscard]] const std::string& volume(Label rank) const { return volumes_[rank]; }
  /// Returns the name of one of mask_groups(mesh).
  [[nodiscard]] const std::string& mask(std::size_t number) const { return masks_[number]; }
  /// Returns the name on the side of the group's first label, or of an interface's second one.
  [[nodiscard]] std::string facets(const FacetGroup& group, bool of_second = false) const {
    return name_of(Kind::kFacets, group, of_second);
  }
  /// Returns a second name for the same.  REQUIRES: NameRule::of_triangles.
  [[nodiscard]] std::string triangles(const FacetGroup& group, bool of_second = false) const {
    return name_of(Kind::kTriangles, group, of_second);
  }
  [[nodiscard]] std::string wedges(const WedgeGroup& group) const;

 private:
  enum class Kind : std::uint8_t { kFacets, kTriangles, kWedges };
  /// What is named by two labels.
  struct Pair {
    Kind kind = Kind::kFacets;
    Label from = 0;
    Label to = 0;
    auto operator<=>(const Pair&) const = default;
  };
  using Taken = std::set<std::string>;  ///< in capitals

  void name_volumes(Taken& taken);
  void name_masks(Taken& taken);
  void tell_pairs_apart(const Taken& taken);
  template <class Visit>
  void for_each_pair(Visit visit) const;
  [[nodiscard]] std::string side_text(Kind kind, Side side) const;
  [[nodiscard]] std::string pair_text(const Pair& pair) const;
  [[nodiscard]] std::string name_of(const Pair& pair) const;
  [[nodiscard]] std::string name_of(Kind kind, const FacetGroup& group, bool of_second) const;

  const GroupedMesh& mesh_;
  NameRule rule_;
  std::vector<std::string> volumes_;
  std::vector<std::string> masks_;
  std::vector<bool> has_name_;   ///< whether volumes_ is more than a number
  std::map<Pair, int> renamed_;  ///< the pairs whose name another has, and how often it was changed
};

}  // namespace mw::io
