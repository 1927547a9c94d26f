// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The smooth surface that voxels were sampled from, face by face.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "kernels/core/assert.h"
#include "kernels/core/label.h"
#include "kernels/source/source_plane.h"

namespace mw {

/// How far around a voxel labels influence the planes of its faces, in voxels.
inline constexpr std::int64_t kSourceHalo = 22;

/// The axes, one bit each, across which a voxel has an interface face on its upper side.
using UpperFaces = std::uint8_t;

/// Planes of the interface faces of a box of voxels.  A face belongs to the voxel on its lower
/// side.
///
/// Faces of one pair of labels that share an edge are neighbours, unless all four faces at the edge
/// are of that pair.  On this graph the places of faces (their centres, to begin with) and their
/// normals are filtered (kernels/source/face_graph.h), where an edge without a neighbour counts as
/// the face itself.  On voxels of a half-space both average to its plane, as faces of each
/// direction lie around it evenly, in numbers that are proportional to the normal.  Nothing crosses
/// from one side of a thin sheet or of a sharp edge to the other, or from one pair of labels to the
/// next.
///
/// All sums are of whole numbers, so that a face's plane is a function of the labels around it.
/// Where the interface is flat and across an axis planes are exactly those of the faces.
///
/// Where labels come from scores the planes are crossings instead (kernels/source/crossing.h): then
/// their heights are along the axes of their faces (crossing_form()).
class SourceSurface {
 public:
  /// A surface without faces.
  SourceSurface() = default;
  /// Finds the planes of all faces between two labels in a box.
  /// labels are those of the box and kSourceHalo around it; voxels outside the volume are
  /// kExterior, where the surface ends.
  /// REQUIRES: no edge of the box of `labels` is longer than 256 voxels.
  /// Memory while it works: 8 bytes a voxel and 72 a face of `labels`.
  SourceSurface(const LabelBox& labels, const Box3& box);

  /// The faces of a box that are known already.
  struct Part {
    Box3 box;
    std::vector<UpperFaces> faces;    ///< by voxel, x fastest
    std::vector<PackedPlane> planes;  ///< by voxel, then by axis
  };
  /// Puts the faces of a box together from parts.  each_part(visit) is called twice, and calls
  /// visit(part) for one part at a time.
  /// REQUIRES: no voxel is in two parts; parts may reach out of the box.
  template <typename EachPart>
  SourceSurface(const Box3& box, EachPart each_part, const PlaneForm& form = kFilteredForm);
  /// REQUIRES: within box().
  [[nodiscard]] Part part(const Box3& box) const;

  [[nodiscard]] const Box3& box() const { return box_; }
  [[nodiscard]] const PlaneForm& form() const { return form_; }
  /// REQUIRES: a face between two labels that belongs to a voxel of box().
  [[nodiscard]] PackedPlane at(Index3 lower, unsigned axis) const {
    MW_ASSERT(box_.contains(lower));
    const std::uint32_t entry = entries_[static_cast<std::size_t>(box_.offset(lower))];
    MW_ASSERT((entry >> axis & 1U) != 0);
    const std::uint32_t before = entry & ((1U << axis) - 1U);
    return planes_[(entry >> kAxisBits) + static_cast<std::uint32_t>(std::popcount(before))];
  }

 private:
  static constexpr unsigned kAxisBits = 3;

  void count_up();
  template <typename Visit>
  void each_voxel(const Part& part, Visit visit);

  Box3 box_;
  PlaneForm form_ = kFilteredForm;
  /// For each voxel its UpperFaces, and above these bits the row of its first plane.
  std::vector<std::uint32_t> entries_;
  std::vector<PackedPlane> planes_;
};

/// Calls visit(entry, faces, first plane) for the part's voxels in the box that have faces.
template <typename Visit>
void SourceSurface::each_voxel(const Part& part, Visit visit) {
  std::size_t voxel = 0, plane = 0;
  for_each_index(part.box, [&](Index3 v) {
    const UpperFaces faces = part.faces[voxel++];
    if (faces == 0) return;
    if (box_.contains(v)) {
      visit(entries_[static_cast<std::size_t>(box_.offset(v))], faces, part.planes.data() + plane);
    }
    plane += static_cast<std::size_t>(std::popcount(faces));
  });
}

template <typename EachPart>
SourceSurface::SourceSurface(const Box3& box, EachPart each_part, const PlaneForm& form)
    : box_(box), form_(form), entries_(static_cast<std::size_t>(box.voxels())) {
  std::size_t count = 0;
  each_part([&](const Part& part) {
    each_voxel(part, [&](std::uint32_t& entry, UpperFaces faces, const PackedPlane*) {
      entry = faces;
      count += static_cast<std::size_t>(std::popcount(faces));
    });
  });
  count_up();
  planes_.resize(count);
  each_part([&](const Part& part) {
    each_voxel(part, [&](std::uint32_t entry, UpperFaces faces, const PackedPlane* planes) {
      std::copy_n(planes, std::popcount(faces), planes_.data() + (entry >> kAxisBits));
    });
  });
}

}  // namespace mw
