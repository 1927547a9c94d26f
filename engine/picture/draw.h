// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is seen of a mesh: the surface of some labels, and a cut through them; and its PNG picture.
#pragma once

#include <functional>
#include <optional>

#include "engine/picture/legend.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/picture/png_writer.h"
#include "kernels/picture/view.h"

namespace mw::picture {

/// Returns the colour that the names give a label, else that of the palette.
[[nodiscard]] Colour label_colour(RawLabel label, const io::LabelNames& names);

/// Returns the label that surrounds the others: it fills more than two thirds of the box's sides,
/// and is not the only label.  Empty when no label does, as in a mesh without its background.
/// ERRORS: see GroupedMesh.  Cost: a pass over the facets on the box.
[[nodiscard]] std::optional<Label> surrounding_label(io::GroupedMesh& mesh);

/// A plane across an axis of the array.
struct CutPosition {
  std::size_t axis = 0;
  double share = 0.5;  ///< place along the edge: 0 where the box begins, 1 where it ends
};

/// Returns the plane at that place of the box; it cuts away what lies towards the viewer.
[[nodiscard]] CutPlane cut_plane(const io::MeshBox& box, const CutPosition& position,
                                 const View& view);

/// Returns the view that is used if none is asked for: it shows the cut and some of the sides.
[[nodiscard]] View default_view(const std::optional<CutPosition>& cut);

struct SceneTriangle {
  std::array<Vec3, 3> corners;
  std::array<bool, 3> lined{};  ///< true if the side opposite to the corner is an edge of the mesh
  Vec3 normal = Vec3::Zero();   ///< outwards, of any length; zero on the cut, which is not lit
  Colour colour{};
};

/// Some labels of a mesh as one opaque solid.  The mesh outlives it.
class MeshScene {
 public:
  /// shown says by rank of label which labels are seen; names have the colours.
  MeshScene(io::GroupedMesh& mesh, std::vector<bool> shown, io::LabelNames names)
      : mesh_(mesh), shown_(std::move(shown)), names_(std::move(names)) {}

  void cut(const CutPlane& plane) { plane_ = plane; }

  using Visit = std::function<void(const SceneTriangle&)>;
  /// Visits the triangles between a shown label and what is not shown, in the colour of the former.
  /// With a cut it visits what the cut leaves of them, and the sections of tets, as triangles.
  /// Memory: none.  Cost: a pass over the facets, and with a cut over the tets of shown labels.
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

/// Returns the place half way between the ends of an uncut scene along an axis of the box, where a
/// cut leaves something to see.  Cost: a pass over the facets.
[[nodiscard]] CutPosition middle_cut(MeshScene& scene, const io::MeshBox& box, std::size_t axis);

enum class Lines : std::uint8_t {
  kAuto,  ///< edges fade where triangles are only some pixels wide
  kAll,
  kNone,
};

struct PictureStyle {
  int width = 1200;  ///< pixels
  int height = 900;
  View view;
  Lines lines = Lines::kAuto;
  bool transparent = false;        ///< the background is transparent, else white
  std::optional<Legend> legend{};  ///< drawn beside the scene where there is room
  int letters = 0;                 ///< see LegendColumn
};

/// ERRORS: mw::Error(kUsage) unless both sides have 16 to 8,192 pixels.
void check_sides(std::int64_t width, std::int64_t height);

/// Draws the scene, and returns how many triangles it drew, hidden ones too.
/// Memory: 64 MiB of samples, and one row.  The scene is visited once for its extent, and once for
/// each band of rows that fits into the samples.
/// ENSURES: the pixels are the same on every machine (Raster).
/// ERRORS: those of scene and take; kInput when there is nothing to see or coordinates are too
/// large to compute with.
std::uint64_t draw(MeshScene& scene, const PictureStyle& style, const io::TakeBytes& take);

}  // namespace mw::picture
