// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers and names of the groups of a .msh file, whatever its version.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/mesh/gmsh/msh_encoder.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/grouped/material_sets.h"

namespace mw::io {

/// The dimensions of groups.
inline constexpr std::int32_t kMshSurface = 2;
inline constexpr std::int32_t kMshVolume = 3;
/// Where the nodes of a tet stand in the file: Gmsh has the middle of edge 2 3 before that of 1 3.
inline constexpr std::array<std::size_t, 10> kMshTetOrder{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

/// The beginning of a comment that holds a MeshRecord.
inline constexpr std::string_view kMshRecord = "mwmesh ";

/// Returns the numbers of volumes.  Surfaces have numbers above them, because many programs have
/// one space of numbers for all dimensions.  ERRORS: see LabelNumbers.
[[nodiscard]] LabelNumbers msh_numbers(const GroupedMesh& mesh);

/// Returns the tag of the surface that is facet group number `group`.
[[nodiscard]] std::int32_t surface_tag(const LabelNumbers& labels, std::size_t group);

/// Returns the physical surface that facet group number `index` belongs to.
[[nodiscard]] std::int32_t physical_surface(const LabelNumbers& labels, const FacetGroup& group,
                                            std::size_t index);

/// Returns the tag and physical group, above all others, of the volume that is this wedge group.
[[nodiscard]] std::int32_t wedge_volume(const LabelNumbers& labels, const GroupedMesh& mesh,
                                        std::size_t group);

/// Returns the physical volumes, above all others, of the masks that have each label, by rank.
[[nodiscard]] std::vector<std::vector<std::int32_t>> mask_volumes(const LabelNumbers& labels,
                                                                  const GroupedMesh& mesh);

/// Writes a section of comments with the record of the run, where the mesh has curved tets, wedges
/// or masks, which could not be found again without it.
void write_record(MshEncoder& out, const GroupedMesh& mesh);

/// Writes the section of the names of all physical surfaces and volumes (see MshWriter), those of
/// masks only where an element may have several.
void write_physical_names(MshEncoder& out, const GroupedMesh& mesh, const LabelNumbers& labels,
                          bool has_masks);

/// The files beside a .msh, and the numbers of materials in it.
class MshTables {
 public:
  MshTables(const std::filesystem::path& mesh, std::optional<MaterialRule> rule);

  /// Writes the section of materials, if there are any, and the tables, and commits all.
  void write_with(MshEncoder& out, GroupedMesh& mesh, const LabelNumbers& numbers);

 private:
  AtomicFile labels_;
  std::optional<MaterialRule> rule_;
  std::optional<AtomicFile> materials_;
};

/// ERRORS: mw::Error(kUsage) naming the file where this many elements cannot have values, because
/// Gmsh numbers them in 32 bits there, in binary.
void check_element_data(const MshEncoder& out, std::uint64_t elements);

/// Writes a section ElementData for each of the values of tets, alike in both versions.  A triangle
/// or a wedge has the value of the tet behind it, because meshio reads no data that only some
/// elements have.
void write_element_data(MshEncoder& out, GroupedMesh& mesh);

}  // namespace mw::io
