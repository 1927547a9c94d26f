// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A low-pass filter on the graph of voxel faces, in whole numbers.
#include "kernels/source/source_surface.h"

#include <algorithm>
#include <array>

#include "kernels/start/cells/cell.h"

namespace mw {
namespace {

/// Steps of the filter; a voxel is this many units in it.
constexpr int kSteps = 7;
constexpr std::int32_t kUnit = 1 << 20;
// A step looks at faces an edge away, an edge at the voxels beside the face.
static_assert(2 * kSteps + 2 <= kSourceHalo);

using Units = std::array<std::int32_t, 3>;

/// What is filtered at a face.
struct FaceState {
  Units place{};   ///< from the face's centre
  Units normal{};  ///< towards the label above the interface
};

/// An edge of a face that another face of the same two labels is at.
struct Neighbour {
  std::uint32_t face = 0;
  std::array<std::int8_t, 4> way{};  ///< from centre to centre, in half voxels
};

struct Face {
  Index3 lower;
  unsigned axis = 0;
  bool low_is_lower = true;  ///< the smaller label is on the lower side
};

class FaceGraph {
 public:
  explicit FaceGraph(const LabelBox& labels) : labels_(labels) {
    find_faces();
    neighbours_.resize(4 * faces_.size());
    for (std::uint32_t i = 0; i < faces_.size(); ++i) connect(i);
  }

  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }

  /// Four for each face; an edge without one has the face itself.
  [[nodiscard]] const Neighbour* neighbours(std::size_t face) const {
    return &neighbours_[4 * face];
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  [[nodiscard]] Label at(Index3 v) const {
    return labels_.box.contains(v) ? labels_.at(v) : kExterior;
  }
  [[nodiscard]] std::size_t slot(Index3 lower, unsigned axis) const {
    return 3 * static_cast<std::size_t>(labels_.box.offset(lower)) + axis;
  }

  void find_faces() {
    rows_.assign(3 * labels_.labels.size(), kNone);
    const Index3 shape = labels_.box.shape();
    const std::array<std::int64_t, 3> strides{1, shape.x, shape.x * shape.y};
    std::size_t i = 0;
    for_each_index(labels_.box, [&](Index3 v) {
      const Label label = labels_.labels[i];
      if (label != kExterior) {
        for (unsigned axis = 0; axis < 3; ++axis) {
          const Index3 up = v + axis_vector(axis);
          if (!labels_.box.contains(up)) continue;
          const Label above = labels_.labels[i + static_cast<std::size_t>(strides[axis])];
          if (above == label || above == kExterior) continue;
          rows_[3 * i + axis] = static_cast<std::uint32_t>(faces_.size());
          faces_.push_back({v, axis, label < above});
        }
      }
      ++i;
    });
  }

  void connect(std::uint32_t row) {
    const Face& f = faces_[row];
    const Index3 upper = f.lower + axis_vector(f.axis);
    const Label below = at(f.lower), above = at(upper);
    std::size_t edge = 4 * std::size_t{row};
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (axis == f.axis) continue;
      for (const int way : {-1, 1}) {
        const Index3 step = axis_vector(axis, way);
        const Label beside_lower = at(f.lower + step), beside_upper = at(upper + step);
        Neighbour n{.face = row};
        const auto face_across = [&](Index3 v) {
          return rows_[slot(way > 0 ? v : v + step, axis)];
        };
        if (beside_lower == below && beside_upper == above) {
          n.face = rows_[slot(f.lower + step, f.axis)];
          n.way[axis] = static_cast<std::int8_t>(2 * way);
        } else if (beside_lower == above && beside_upper != below) {
          n.face = face_across(f.lower);
          n.way[axis] = static_cast<std::int8_t>(way);
          n.way[f.axis] = -1;
        } else if (beside_upper == below && beside_lower != above) {
          n.face = face_across(upper);
          n.way[axis] = static_cast<std::int8_t>(way);
          n.way[f.axis] = 1;
        }
        neighbours_[edge++] = n;
      }
    }
  }

  const LabelBox& labels_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> rows_;
  std::vector<Neighbour> neighbours_;
};

/// Each face goes three quarters of the way to the mean of its neighbours.
void diffuse(const FaceGraph& graph, const std::vector<FaceState>& from,
             std::vector<FaceState>& to) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Neighbour* n = graph.neighbours(i);
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t way = 0, place = 0, normal = 0;
      for (int j = 0; j < 4; ++j) {
        const FaceState& other = from[n[j].face];
        way += n[j].way[k];
        place += other.place[k] - from[i].place[k];
        normal += other.normal[k] - from[i].normal[k];
      }
      place += way * (kUnit / 2);
      to[i].place[k] = from[i].place[k] + ((3 * place + 8) >> 4);
      to[i].normal[k] = from[i].normal[k] + ((3 * normal + 8) >> 4);
    }
  }
}

Vec3 vector_of(const Units& u) {
  return {static_cast<double>(u[0]), static_cast<double>(u[1]), static_cast<double>(u[2])};
}

/// Places after kSteps and after twice as many, normals after these.
struct Filtered {
  std::vector<Units> places;
  std::vector<FaceState> states;
};

Filtered filter(const FaceGraph& graph) {
  const std::vector<Face>& faces = graph.faces();
  Filtered out{std::vector<Units>(faces.size()), std::vector<FaceState>(faces.size())};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    out.states[i].normal[faces[i].axis] = faces[i].low_is_lower ? kUnit : -kUnit;
  }
  std::vector<FaceState> next(faces.size());
  for (int step = 0; step < 2 * kSteps; ++step) {
    if (step == kSteps) {
      for (std::size_t i = 0; i < faces.size(); ++i) out.places[i] = out.states[i].place;
    }
    diffuse(graph, out.states, next);
    out.states.swap(next);
  }
  return out;
}

/// Faces of one direction cancel others when the surface turns more than the filter can tell.
double trust_of(const Vec3& normal) {
  constexpr double kNone = 0.6, kFull = 0.8;
  const double same_way = normal.lpNorm<1>() / kUnit;
  return std::clamp((same_way - kNone) / (kFull - kNone), 0.0, 1.0);
}

SourcePlane plane_of(const Face& face, const Units& once, const FaceState& twice) {
  const Vec3 place = (2.0 * vector_of(once) - vector_of(twice.place)) / kUnit;
  const Vec3 towards_high = vector_of(twice.normal);
  const double length = towards_high.norm(), sign = face.low_is_lower ? 1.0 : -1.0;
  if (!(length > 0.0)) return {Vec3::Unit(static_cast<int>(face.axis)), 0.0};
  const Vec3 normal = sign / length * towards_high;
  const double height = trust_of(towards_high) * normal.dot(place);
  return {normal, std::clamp(height, -kMaxSourceHeight, kMaxSourceHeight)};
}

}  // namespace

SourceSurface::SourceSurface(const LabelBox& labels, const Box3& box)
    : box_(box), entries_(static_cast<std::size_t>(box.voxels())) {
  const FaceGraph graph(labels);
  const Filtered filtered = filter(graph);
  for (std::size_t i = 0; i < graph.faces().size(); ++i) {
    const Face& f = graph.faces()[i];
    if (!box.contains(f.lower)) continue;
    entries_[static_cast<std::size_t>(box.offset(f.lower))] |= 1U << f.axis;
    planes_.push_back(pack(plane_of(f, filtered.places[i], filtered.states[i])));
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

SourceSurface::SourceSurface(const Box3& box, std::span<const Part> parts)
    : box_(box), entries_(static_cast<std::size_t>(box.voxels())) {
  const auto each_voxel = [&](auto visit) {
    for (const Part& part : parts) {
      std::size_t voxel = 0, plane = 0;
      for_each_index(part.box, [&](Index3 v) {
        const UpperFaces faces = part.faces[voxel++];
        if (faces == 0) return;
        if (box.contains(v)) {
          visit(entries_[static_cast<std::size_t>(box.offset(v))], faces,
                part.planes.data() + plane);
        }
        plane += static_cast<std::size_t>(std::popcount(faces));
      });
    }
  };
  std::size_t count = 0;
  each_voxel([&](std::uint32_t& entry, UpperFaces faces, const PackedPlane*) {
    entry = faces;
    count += static_cast<std::size_t>(std::popcount(faces));
  });
  count_up();
  planes_.resize(count);
  each_voxel([&](std::uint32_t entry, UpperFaces faces, const PackedPlane* planes) {
    std::copy_n(planes, std::popcount(faces), planes_.begin() + (entry >> kAxisBits));
  });
}

SourceSurface::Part SourceSurface::part(const Box3& box) const {
  Part out{.box = box};
  for_each_index(box, [&](Index3 v) {
    const std::uint32_t entry = entries_[static_cast<std::size_t>(box_.offset(v))];
    const auto faces = static_cast<UpperFaces>(entry & ((1U << kAxisBits) - 1U));
    out.faces.push_back(faces);
    const auto first = planes_.begin() + (entry >> kAxisBits);
    out.planes.insert(out.planes.end(), first, first + std::popcount(faces));
  });
  return out;
}

}  // namespace mw
