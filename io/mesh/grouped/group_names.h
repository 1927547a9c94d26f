// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Groups of tets and facets: what they are called in files that know names, their numbers in other
// files, and those of the masks of a volume, of which a tet can be in several.
#pragma once

#include <functional>
#include <limits>
#include <set>
#include <string>
#include <string_view>
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
  /// Returns the name of one of mask_groups(mesh): "mask_liver", with '_' behind it as often as it
  /// is that of a label or another mask, or PlainNames' where it is longer than max_bytes.
  [[nodiscard]] const std::string& mask(std::size_t number) const { return masks_[number]; }
  /// Returns the names of both labels of an interface, the lower label first: "liver|kidney".  The
  /// labels follow, as in "a|b|c (1|2)", where a name has a '|' or a label is called like that.
  /// Facets on a side of the box have the name of that side, which is the same for all labels.
  [[nodiscard]] std::string facets(const FacetGroup& group) const;

 private:
  void name_masks(const GroupedMesh& mesh, const Spelling& spelled, std::size_t max_bytes,
                  std::set<std::string> taken);
  [[nodiscard]] bool is_barred(Label rank) const { return barred_.contains(volumes_[rank]); }

  const LabelTable& table_;
  std::vector<std::string> volumes_;
  std::vector<std::string> masks_;
  std::set<std::string> barred_;  ///< those of volumes_ that have a '|'
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

/// Calls visit(NumberedFacets) on the runs in the order of their facets; each facet is in one run.
/// Sides of the box have the numbers 1 to 6 (x_min, x_max, y_min, y_max, z_min, z_max), the outer
/// surface has 7, whatever the mesh; all labels share them.  Interfaces have 8 and more, ascending
/// by their two labels.
template <class Visit>
void for_each_numbered(const GroupedMesh& mesh, const GroupNames& names, Visit visit) {
  std::int64_t next = kSides;
  for_each_facet_run(mesh, [&](const FacetGroup& run) {
    const bool interface = run.side == Side::kInterface;
    visit(NumberedFacets{.number = interface ? next++ : static_cast<std::int64_t>(run.side),
                         .name = names.facets(run),
                         .side = run.side,
                         .first = interface ? run.first : kExterior,
                         .second = run.second,
                         .facets = run.facets});
  });
}

/// Returns the path of the table beside a mesh: M.facets.csv for M.xdmf.
[[nodiscard]] std::filesystem::path facet_table_path(const std::filesystem::path& mesh);

/// Appends the content of that table, with the columns number, name, side, first, second; the last
/// two are the labels of an interface and else empty.  The file is to be committed with the mesh
/// (commit_together()).  ERRORS: see AtomicFile.
void append_facet_table(AtomicFile& file, const GroupedMesh& mesh, const GroupNames& names);

/// The beginning of what masks are called in files, since a label can have the name of a mask.
inline constexpr std::string_view kMaskNames = "mask_";

/// All tets of a mask.
struct MaskGroup {
  std::string name;
  std::vector<Label> ranks;  ///< of its labels in the mesh's table, ascending; at least one
};

/// Returns the masks of header().record that have tets.
[[nodiscard]] std::vector<MaskGroup> mask_groups(const GroupedMesh& mesh);

/// Returns the names of arrays that tell which cells are in each of the header's masks.
/// ENSURES: they are no paths ("mask_a/b" is "mask_a_b"), differ, and none is one of the header's
/// values.
[[nodiscard]] std::vector<std::string> mask_arrays(const MeshHeader& header);

}  // namespace mw::io
