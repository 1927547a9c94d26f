// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Interface triangles from the tets on each triangle, and their pieces.
#include "kernels/audit/distance/mesh.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "kernels/audit/partition/box_planes.h"
#include "kernels/core/sort_distinct.h"
#include "kernels/core/vector3.h"

namespace mw::audit {
namespace {

class TriangleCollector {
 public:
  TriangleCollector(const AuditMesh& mesh, std::size_t label_count, const Frame& frame,
                    Index3 shape)
      : mesh_(mesh),
        frame_(frame),
        box_(frame, shape),
        shape_{static_cast<double>(shape.x), static_cast<double>(shape.y),
               static_cast<double>(shape.z)},
        margin_(std::max({shape_[0], shape_[1], shape_[2]})),
        unknown_(static_cast<Label>(label_count)) {}

  void add(const MeshFace& face) {
    if (face.sides.size() < 2) return;
    labels_.clear();
    for (const FaceSide& side : face.sides) {
      labels_.push_back(std::min(mesh_.labels[side.tet], unknown_));
    }
    sort_distinct(labels_);
    // There are more than two only where P2 fails; the chain names each label all the same.
    for (std::size_t i = 1; i < labels_.size(); ++i) {
      triangles_.push_back({corners(face.vertices), {labels_[i - 1], labels_[i]}});
    }
  }

  /// Adds a triangle of one tet, unless it is on the box.
  void add_gap(const MeshFace& face) {
    const auto& [a, b, c] = face.vertices;
    const auto& at = mesh_.vertices;
    if (face.sides.size() != 1 || box_.share_plane({&at[a], &at[b], &at[c]})) return;
    const Label label = std::min(mesh_.labels[face.sides[0].tet], unknown_);
    triangles_.push_back({corners(face.vertices), {label, unknown_ + 1}});
  }

  std::vector<InterfaceTriangle> take() { return std::move(triangles_); }

 private:
  [[nodiscard]] VoxelTriangle corners(const std::array<std::uint32_t, 3>& vertices) const {
    VoxelTriangle out{};
    for (std::size_t i = 0; i < 3; ++i) {
      const VoxelPoint p = frame_.in_voxels(mesh_.vertices[vertices[i]]);
      for (std::size_t k = 0; k < 3; ++k) {
        out[i][k] = std::clamp(p[k], -margin_, shape_[k] + margin_);
      }
    }
    return out;
  }

  AuditMesh mesh_;
  Frame frame_;
  BoxPlanes box_;
  std::array<double, 3> shape_;
  double margin_;
  Label unknown_;
  std::vector<Label> labels_;
  std::vector<InterfaceTriangle> triangles_;
};

}  // namespace

std::vector<InterfaceTriangle> interface_triangles(const MeshStars& stars, std::size_t label_count,
                                                   const Frame& frame, Index3 shape,
                                                   bool with_gaps) {
  TriangleCollector collector(stars.mesh(), label_count, frame, shape);
  for_each_face(stars, [&](const MeshFace& face) {
    collector.add(face);
    if (with_gaps) collector.add_gap(face);
  });
  return collector.take();
}

void sort_along_curve(std::vector<InterfaceTriangle>& triangles, const Box3& box) {
  constexpr double kCells = 1 << 20;
  const std::array<std::int64_t, 3> lo{box.lo.x, box.lo.y, box.lo.z};
  const Index3 s = box.shape();
  const auto longest = static_cast<double>(std::max({s.x, s.y, s.z}));
  const auto position = [&](const InterfaceTriangle& t) {
    const VoxelPoint middle = centroid(t.corners);
    std::array<std::uint32_t, 3> cell{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double along = (middle[k] - static_cast<double>(lo[k])) / longest * kCells;
      cell[k] = static_cast<std::uint32_t>(std::clamp(along, 0.0, kCells - 1));
    }
    return curve_position(cell);
  };
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  order.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) order.emplace_back(position(triangles[i]), i);
  std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    const InterfaceTriangle &t = triangles[a.second], &u = triangles[b.second];
    return std::tie(t.corners, t.labels) < std::tie(u.corners, u.labels);
  });
  std::vector<InterfaceTriangle> sorted;
  sorted.reserve(triangles.size());
  for (const auto& [key, i] : order) sorted.push_back(triangles[i]);
  triangles = std::move(sorted);
}

double area(const VoxelTriangle& t) {
  return norm(cross(minus(t[1], t[0]), minus(t[2], t[0]))) / 2;
}

VoxelPoint centroid(const VoxelTriangle& t) {
  VoxelPoint out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = (t[0][k] + t[1][k] + t[2][k]) / 3;
  return out;
}

double radius(const VoxelTriangle& t) {
  const VoxelPoint middle = centroid(t);
  double squared = 0;
  for (const VoxelPoint& p : t) {
    const VoxelPoint way = minus(p, middle);
    squared = std::max(squared, dot(way, way));
  }
  return std::sqrt(squared);
}

std::array<VoxelTriangle, 2> halves(const VoxelTriangle& t) {
  std::size_t from = 0;
  double longest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const VoxelPoint edge = minus(t[(i + 1) % 3], t[i]);
    const double squared = dot(edge, edge);
    if (squared > longest) from = i;
    longest = std::max(longest, squared);
  }
  const std::size_t to = (from + 1) % 3;
  VoxelPoint middle{};
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (t[from][k] + t[to][k]) / 2;
  std::array<VoxelTriangle, 2> out{t, t};
  out[0][to] = middle;
  out[1][from] = middle;
  return out;
}

void add_estimates(const VoxelTriangle& t, PieceEstimates& sums) {
  const double length = radius(t), surface = area(t);
  double max = kPieceRadius;
  for (double& sum : sums) {
    sum += 1 + length / max + surface / (max * max);
    max *= 2;
  }
}

double piece_radius(const PieceEstimates& sums) {
  constexpr double kMaxPieces = 1e7, kMaxPiecesATriangle = 64;
  const double max = std::max(kMaxPieces, kMaxPiecesATriangle * sums.back());
  double radius = kPieceRadius;
  for (const double sum : sums) {
    if (sum <= max) break;
    radius *= 2;
  }
  return radius;
}

}  // namespace mw::audit
