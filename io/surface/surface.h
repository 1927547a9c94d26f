// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which facets of a mesh make a surface, a walk over these facets, and a surface of them with
// vertices of its own.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "io/mesh/grouped/grouped_mesh.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// The memory of each sort by which the surface of a mesh is made.
inline constexpr std::size_t kSurfaceSortBytes = 8 << 20;

/// The facets of one group.
struct ShellPart {
  std::size_t group = 0;  ///< its index in GroupedMesh::facet_groups()
  bool turned = false;    ///< normals are to point out of its second label
};

/// Facets that make one shell.
struct ShellPlan {
  std::optional<Label> label;    ///< the label whose surface it is; empty for interfaces
  std::vector<ShellPart> parts;  ///< ascending by group
};

/// Finds the facets of labels and pairs.  Memory: 32 bytes a group of facets.
class ShellPlans {
 public:
  /// If closed, surfaces of labels have their facets on the sides of the box too.
  /// REQUIRES: mesh outlives it.
  ShellPlans(const GroupedMesh& mesh, bool closed);

  /// Returns the boundary of a label, with normals outwards.
  [[nodiscard]] ShellPlan of_label(Label rank) const;
  /// Returns the interface of two labels, with normals out of the lower; empty if there is none.
  [[nodiscard]] ShellPlan of_pair(Label one, Label other) const;
  /// Returns all interfaces of two labels, with normals out of the lower one, and the facets where
  /// labels meet what was left out of the mesh.  The sides of the box are no interfaces.
  [[nodiscard]] ShellPlan of_interfaces() const;
  /// Returns these interfaces, each as a shell of its own.
  [[nodiscard]] std::vector<ShellPlan> of_each_interface() const;

 private:
  const GroupedMesh& mesh_;
  std::vector<std::vector<ShellPart>> by_label_;
};

/// A mesh, and the folder of the temporary files from which its surface is made.
struct SurfaceSource {
  GroupedMesh& mesh;
  std::filesystem::path folder;  ///< of temporary files
  Position shift{};              ///< is taken off all coordinates
};

/// Returns the label that the normals of a part point out of.
[[nodiscard]] inline Label inside_of(const GroupedMesh& mesh, const ShellPart& part) {
  const FacetGroup& group = mesh.facet_groups()[part.group];
  return part.turned ? group.second : group.first;
}

/// Calls visit on the rows of the mesh that are each facet's corners, with normals as planned.
template <class Visit>
void for_each_facet(GroupedMesh& mesh, const ShellPlan& plan, Visit visit) {
  for (const ShellPart& part : plan.parts) {
    const RowRange facets = mesh.facet_groups()[part.group].facets;
    for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
      Triangle rows = mesh.facet(f).rows;
      if (part.turned) std::swap(rows[1], rows[2]);
      visit(rows);
    }
  }
}

/// What becomes of places where a shell touches itself.
enum class Touching : std::uint8_t {
  kJoined,   ///< one vertex, as in the mesh
  kDoubled,  ///< the vertices of each_sheet_corner(), of which several may be in one place
  kApart,    ///< these vertices, in the places of places_apart()
};

/// Vertices and triangles of shells, in temporary files.
class Surface {
 public:
  /// Vertices of a shell ascend by their row in the mesh, triangles are as planned.
  /// REQUIRES: all parts of a shell have the same label inside, unless it is kJoined.
  /// Memory: 32 MiB, and what each_sheet_corner() and places_apart() take.
  /// Cost: two sorts of three numbers a corner.
  Surface(const SurfaceSource& source, std::shared_ptr<const SurfaceLabels> labels,
          const std::vector<ShellPlan>& plans, Touching touching);

  [[nodiscard]] const SurfaceHeader& header() const { return header_; }
  /// Writes all of the surface, from begin() to finish().
  void write(SurfaceSink& sink);

 private:
  void add_shell(const SurfaceSource& source, const ShellPlan& plan, Touching touching);
  void write_vertices(SurfaceSink& sink);

  SurfaceHeader header_;
  ScratchFile vertices_;
  std::map<std::uint64_t, Position> moved_;  ///< vertices that go elsewhere, by number
  ScratchFile triangles_;
};

}  // namespace mw::io
