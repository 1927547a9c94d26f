// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Interface triangles from the tets on each triangle, and how finely to sample them.
#include "kernels/audit/distance_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/audit/box_planes.h"
#include "kernels/audit/mesh_stars.h"

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
    std::sort(labels_.begin(), labels_.end());
    labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
    // More than two only where P2 fails; the chain names each label all the same.
    for (std::size_t i = 1; i < labels_.size(); ++i) {
      triangles_.push_back({corners(face.vertices), {labels_[i - 1], labels_[i]}});
    }
  }

  /// A triangle of one tet, unless it is on the box.
  void add_gap(const MeshFace& face) {
    const auto& [a, b, c] = face.vertices;
    const auto& at = mesh_.vertices;
    if (face.sides.size() != 1 || box_.share_plane({&at[a], &at[b], &at[c]})) return;
    const Label label = std::min(mesh_.labels[face.sides[0].tet], unknown_);
    triangles_.push_back({corners(face.vertices), {label, unknown_ + 1}});
  }

  /// All that was added, sorted along a curve.
  std::vector<InterfaceTriangle> take() {
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    order.reserve(triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      order.emplace_back(curve_position(triangles_[i].corners), i);
    }
    std::sort(order.begin(), order.end());
    std::vector<InterfaceTriangle> sorted;
    sorted.reserve(triangles_.size());
    for (const auto& [position, i] : order) sorted.push_back(triangles_[i]);
    return sorted;
  }

 private:
  [[nodiscard]] VoxelTriangle corners(const std::array<std::uint32_t, 3>& vertices) const {
    VoxelTriangle out{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Position& p = mesh_.vertices[vertices[i]];
      for (std::size_t k = 0; k < 3; ++k) {
        const double voxels = (p[k] - frame_.origin[k]) / frame_.spacing[k];
        out[i][k] = std::clamp(voxels, -margin_, shape_[k] + margin_);
      }
    }
    return out;
  }

  [[nodiscard]] std::uint64_t curve_position(const VoxelTriangle& t) const {
    constexpr double kCells = 1 << 20;
    std::array<std::uint32_t, 3> cell{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double middle = (t[0][k] + t[1][k] + t[2][k]) / 3 + margin_;
      const double place = middle / (3 * margin_) * kCells;
      cell[k] = static_cast<std::uint32_t>(std::clamp(place, 0.0, kCells - 1));
    }
    return audit::curve_position(cell);
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

VoxelPoint edge(const VoxelTriangle& t, std::size_t from, std::size_t to) {
  return {t[to][0] - t[from][0], t[to][1] - t[from][1], t[to][2] - t[from][2]};
}

double squared_length(const VoxelPoint& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

}  // namespace

std::vector<InterfaceTriangle> interface_triangles(const AuditMesh& mesh, std::size_t label_count,
                                                   const Frame& frame, Index3 shape,
                                                   bool with_gaps) {
  TriangleCollector collector(mesh, label_count, frame, shape);
  visit_faces(MeshStars(mesh), [&](const MeshFace& face) {
    collector.add(face);
    if (with_gaps) collector.add_gap(face);
  });
  return collector.take();
}

double area(const VoxelTriangle& t) {
  const VoxelPoint u = edge(t, 0, 1);
  const VoxelPoint v = edge(t, 0, 2);
  return std::sqrt(squared_length(
             {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]})) /
         2;
}

std::uint64_t parts_of_edge(const VoxelTriangle& t, double covering_radius) {
  const double squared = std::max({squared_length(edge(t, 0, 1)), squared_length(edge(t, 0, 2)),
                                   squared_length(edge(t, 1, 2))});
  const double parts = std::sqrt(squared / 3) / covering_radius;
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(parts)));
}

double affordable_radius(std::span<const InterfaceTriangle> triangles, double wanted, double most) {
  for (double radius = wanted;; radius *= 2) {
    double samples = 0;
    for (const InterfaceTriangle& t : triangles) {
      const auto parts = static_cast<double>(parts_of_edge(t.corners, radius));
      samples += (parts + 1) * (parts + 2) / 2 - 3;
    }
    if (samples <= most) return radius;
  }
}

}  // namespace mw::audit
