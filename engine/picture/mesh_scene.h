// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What of a mesh is seen: the surface of some labels, and a cut through them.
#pragma once

#include <functional>
#include <optional>

#include "io/mesh/grouped/grouped_mesh.h"
#include "kernels/picture/cut.h"
#include "kernels/picture/view.h"

namespace mw::picture {

/// Names' colour of a label, else the palette's.
[[nodiscard]] Colour label_colour(RawLabel label, const io::LabelNames& names);

/// The label that surrounds the others: more than two thirds of the box's surface are at it, and
/// it is not the only one.  Empty when there is none such.
/// ERRORS: see GroupedMesh.  Cost: the facets on the box.
[[nodiscard]] std::optional<Label> surrounding_label(io::GroupedMesh& mesh);

/// A plane across an axis of the array.
struct CutPosition {
  std::size_t axis = 0;
  double share = 0.5;  ///< 0: where the box begins, 1: where it ends
};

/// The plane of the box there; what lies towards the viewer goes.
[[nodiscard]] CutPlane cut_plane(const io::MeshBox& box, const CutPosition& position,
                                 const View& view);

/// The view where none is asked for: the cut is seen, and some of the sides.
[[nodiscard]] View default_view(const std::optional<CutPosition>& cut);

struct SceneTriangle {
  std::array<Vec3, 3> corners;
  std::array<bool, 3> lined{};  ///< whether the side opposite to this corner is an edge of the mesh
  Vec3 normal = Vec3::Zero();   ///< outwards, of any length; zero on the cut, which is not lit
  Colour colour{};
};

/// Some labels of a mesh as one opaque solid.  The mesh outlives it.
class MeshScene {
 public:
  /// shown: by rank of label.  names: of the colours.
  MeshScene(io::GroupedMesh& mesh, std::vector<bool> shown, io::LabelNames names)
      : mesh_(mesh), shown_(std::move(shown)), names_(std::move(names)) {}

  void cut(const CutPlane& plane) { plane_ = plane; }

  using Visit = std::function<void(const SceneTriangle&)>;
  /// The triangles between a shown label and what is not shown, in the colour of the former; with
  /// a cut what it leaves of them, and the sections of tets, in triangles.
  /// Memory: none.  Cost: a pass over the facets, with a cut over the tets of shown labels too.
  /// ERRORS: see GroupedMesh; kInput when a vertex is not finite.
  void each(const Visit& visit);

 private:
  void for_each_facet(const io::FacetGroup& group, const Visit& visit);
  void for_each_section(Label rank, const Visit& visit);
  [[nodiscard]] Vec3 vertex(std::uint64_t row);
  [[nodiscard]] Colour colour(Label rank) const {
    return label_colour(mesh_.table().raw(rank), names_);
  }

  io::GroupedMesh& mesh_;
  std::vector<bool> shown_;
  io::LabelNames names_;
  std::optional<CutPlane> plane_;
};

/// The place half way between the ends of an uncut scene along an axis of the box, where a cut
/// leaves something to see.  Cost: a pass over the facets.
[[nodiscard]] CutPosition middle_cut(MeshScene& scene, const io::MeshBox& box, std::size_t axis);

}  // namespace mw::picture
