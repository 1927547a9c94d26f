// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Planes of voxel faces from filtered places and normals.
#include "kernels/source/source_surface.h"

#include <algorithm>

#include "kernels/source/face_graph.h"

namespace mw {
namespace {

/// Units in a voxel.  A place in a box of 2^8 voxels takes 26 bits; the filters need four more.
constexpr std::int32_t kUnit = 1 << 18;
[[maybe_unused]] constexpr std::int64_t kMaxEdge = 1 << 8;
// A step looks at faces one edge away, and an edge depends on the voxels beside the face.
static_assert(FaceFilter::kReach + 2 <= kSourceHalo);

using Units = FaceFilter::Value;

Vec3 vector_of(const Units& u) {
  return {static_cast<double>(u[0]), static_cast<double>(u[1]), static_cast<double>(u[2])};
}

/// The centre of a face, in units, from the lowest corner of a box.
Units centre_of(const FaceGraph::Face& face, Index3 lo) {
  const Index3 from = face.lower - lo;
  const auto middle = [](std::int64_t v) {
    return static_cast<std::int32_t>(v) * kUnit + kUnit / 2;
  };
  Units out{middle(from.x), middle(from.y), middle(from.z)};
  out[face.axis] += kUnit / 2;
  return out;
}

/// Unit normals to the larger label.
std::vector<Units> normals_of(const FaceGraph& graph) {
  std::vector<Units> out(graph.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const FaceGraph::Face f = graph.face(i);
    out[i][f.axis] = f.low_is_lower ? kUnit : -kUnit;
  }
  return out;
}

/// Ways from the centres to where the filter puts the faces.
std::vector<Units> filtered_ways(const FaceGraph& graph, const FaceFilter& filter, Index3 lo) {
  std::vector<Units> out(graph.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = centre_of(graph.face(i), lo);
  filter.smooth(out);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Units centre = centre_of(graph.face(i), lo);
    for (std::size_t k = 0; k < 3; ++k) out[i][k] -= centre[k];
  }
  return out;
}

/// How far to trust a height: normals cancel where the surface turns more than the filter can tell.
double trust_of(const Vec3& normal) {
  constexpr double kNone = 0.6, kFull = 0.8;
  const double same_way = normal.lpNorm<1>() / kUnit;
  return std::clamp((same_way - kNone) / (kFull - kNone), 0.0, 1.0);
}

SourcePlane plane_of(const FaceGraph::Face& face, const Units& way, const Units& towards_high) {
  const Vec3 mean = vector_of(towards_high);
  const double length = mean.norm(), sign = face.low_is_lower ? 1.0 : -1.0;
  if (!(length > 0.0)) return {Vec3::Unit(static_cast<int>(face.axis)), 0.0};
  const Vec3 normal = sign / length * mean;
  const double height = trust_of(mean) * normal.dot(vector_of(way)) / kUnit;
  return {normal, std::clamp(height, -kMaxSourceHeight, kMaxSourceHeight)};
}

}  // namespace

SourceSurface::SourceSurface(const LabelBox& labels, const Box3& box)
    : box_(box), entries_(static_cast<std::size_t>(box.voxels())) {
  MW_ASSERT(std::max({labels.box.shape().x, labels.box.shape().y, labels.box.shape().z}) <=
            kMaxEdge);
  const FaceGraph graph(labels);
  const FaceFilter filter(graph, normals_of(graph));
  const std::vector<Units> ways = filtered_ways(graph, filter, labels.box.lo);
  std::vector<Units> normals = normals_of(graph);
  filter.diffuse(normals);
  for (std::size_t i = 0; i < graph.size(); ++i) {
    const FaceGraph::Face f = graph.face(i);
    if (!box.contains(f.lower)) continue;
    entries_[static_cast<std::size_t>(box.offset(f.lower))] |= 1U << f.axis;
    planes_.push_back(pack(plane_of(f, ways[i], normals[i])));
  }
  count_up();
}

/// Gives each voxel the row of its first plane, once its faces are known.
void SourceSurface::count_up() {
  std::uint32_t row = 0;
  for (std::uint32_t& entry : entries_) {
    const std::uint32_t faces = entry;
    entry |= row << kAxisBits;
    row += static_cast<std::uint32_t>(std::popcount(faces));
  }
}

SourceSurface::Part SourceSurface::part(const Box3& box) const {
  Part out{.box = box};
  for_each_index(box, [&](Index3 v) {
    const std::uint32_t entry = entries_[static_cast<std::size_t>(box_.offset(v))];
    const auto faces = static_cast<UpperFaces>(entry & ((1U << kAxisBits) - 1U));
    out.faces.push_back(faces);
    const PackedPlane* first = planes_.data() + (entry >> kAxisBits);
    out.planes.insert(out.planes.end(), first, first + std::popcount(faces));
  });
  return out;
}

}  // namespace mw
