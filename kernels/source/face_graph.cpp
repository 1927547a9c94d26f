// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The four voxels around an edge tell which faces meet there.
#include "kernels/source/face_graph.h"

#include "kernels/core/metric.h"
#include "kernels/start/cells/cell.h"

namespace mw {
namespace {

/// Calls visit(voxel, axis, low_is_lower) on the faces of a box, in order.
template <typename Visit>
void each_face(const LabelBox& labels, Visit visit) {
  const Index3 shape = labels.box.shape();
  const std::array<std::int64_t, 3> strides{1, shape.x, shape.x * shape.y};
  std::size_t voxel = 0;
  for_each_index(shape, [&](Index3 v) {
    const Label below = labels.labels[voxel];
    const std::array<bool, 3> has_upper{v.x + 1 < shape.x, v.y + 1 < shape.y, v.z + 1 < shape.z};
    for (unsigned axis = 0; axis < 3 && below != kExterior; ++axis) {
      if (!has_upper[axis]) continue;
      const Label above = labels.labels[voxel + static_cast<std::size_t>(strides[axis])];
      if (above != below && above != kExterior) visit(voxel, axis, below < above);
    }
    ++voxel;
  });
}

}  // namespace

std::size_t FaceGraph::count(const LabelBox& labels) {
  std::size_t out = 0;
  each_face(labels, [&](std::size_t, unsigned, bool) { ++out; });
  return out;
}

FaceGraph::FaceGraph(const LabelBox& labels) : labels_(labels), firsts_(labels.labels.size()) {
  faces_.reserve(count(labels));
  std::size_t next = 0;  // the first voxel whose entry is not known
  const auto know = [&](std::size_t end) {
    for (; next < end; ++next) firsts_[next] = static_cast<std::uint32_t>(faces_.size());
  };
  each_face(labels, [&](std::size_t voxel, unsigned axis, bool low_is_lower) {
    know(voxel + 1);
    faces_.push_back(static_cast<std::uint32_t>(8 * voxel + 2 * axis) + (low_is_lower ? 1U : 0U));
  });
  know(firsts_.size());
  neighbours_.reserve(faces_.size());
  for (std::uint32_t row = 0; row < faces_.size(); ++row) {
    neighbours_.push_back(find_neighbours(row));
  }
}

FaceGraph::Face FaceGraph::face(std::size_t row) const {
  const std::uint32_t packed = faces_[row];
  const std::int64_t voxel = packed >> 3;
  const Index3 shape = labels_.box.shape();
  const Index3 from_lo{voxel % shape.x, voxel / shape.x % shape.y, voxel / (shape.x * shape.y)};
  return {labels_.box.lo + from_lo, packed >> 1 & 3U, (packed & 1U) != 0};
}

/// REQUIRES: the voxel has a face across the axis on its upper side.
std::uint32_t FaceGraph::row_of(Index3 lower, unsigned axis) const {
  std::uint32_t row = firsts_[static_cast<std::size_t>(labels_.box.offset(lower))];
  while ((faces_[row] >> 1 & 3U) != axis) ++row;
  return row;
}

FaceGraph::Neighbours FaceGraph::find_neighbours(std::uint32_t row) const {
  const Face f = face(row);
  const Index3 upper = f.lower + axis_vector(f.axis);
  const Label below = at(f.lower), above = at(upper);
  Neighbours out{row, row, row, row};
  std::size_t edge = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (axis == f.axis) continue;
    for (const bool up : {false, true}) {
      const Index3 step = axis_vector(axis, up ? 1 : -1);
      const Label beside_lower = at(f.lower + step), beside_upper = at(upper + step);
      // The face between a voxel and the one beside it.
      const auto across = [&](Index3 v) { return row_of(up ? v : v + step, axis); };
      if (beside_lower == below && beside_upper == above) {
        out[edge] = row_of(f.lower + step, f.axis);
      } else if (beside_lower == above && beside_upper != below) {
        out[edge] = across(f.lower);
      } else if (beside_upper == below && beside_lower != above) {
        out[edge] = across(upper);
      }
      ++edge;
    }
  }
  return out;
}

}  // namespace mw
