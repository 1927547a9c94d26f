// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxel faces between labels, and which of them are neighbours on an interface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/core/label.h"

namespace mw {

/// The faces between two labels of a box, each with four edges.  At an edge a face's neighbour is
/// the other face of the same two labels.  It has none where four such faces meet, or where the
/// interface ends.  Faces between a label and the exterior do not count.
/// Memory: 4 bytes a voxel, 20 a face.
class FaceGraph {
 public:
  struct Face {
    Index3 lower;  ///< the voxel on the face's lower side
    unsigned axis = 0;
    bool low_is_lower = true;  ///< the smaller label is on that side
  };
  /// The neighbour at each edge; a face is its own neighbour at an edge without another.
  using Neighbours = std::array<std::uint32_t, 4>;

  /// Keeps a reference to the labels.
  explicit FaceGraph(const LabelBox& labels);

  /// How many faces the graph of these labels has.
  [[nodiscard]] static std::size_t count(const LabelBox& labels);

  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  /// Faces ascend with their lower voxel, x fastest, then with the axis.
  [[nodiscard]] Face face(std::size_t row) const;
  [[nodiscard]] const Neighbours& neighbours(std::size_t row) const { return neighbours_[row]; }

 private:
  [[nodiscard]] std::uint32_t row_of(Index3 lower, unsigned axis) const;
  [[nodiscard]] Label at(Index3 v) const {
    return labels_.box.contains(v) ? labels_.at(v) : kExterior;
  }
  [[nodiscard]] Neighbours find_neighbours(std::uint32_t row) const;

  const LabelBox& labels_;
  std::vector<std::uint32_t> firsts_;  ///< how many faces belong to voxels before each voxel
  std::vector<std::uint32_t> faces_;   ///< 8 * lower voxel + 2 * axis + low_is_lower
  std::vector<Neighbours> neighbours_;
};

}  // namespace mw
