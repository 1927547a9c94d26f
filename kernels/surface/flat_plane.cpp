// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Compares the planes of carried faces; in most fans the first few lie across different axes.
#include "kernels/surface/flat_plane.h"

#include <algorithm>
#include <cmath>

namespace mw {
namespace {

FlatPlane plane_of(const DistanceGuard::Piece& piece) {
  const double place = kUnitsPerVoxel * piece.middle[static_cast<int>(piece.axis)];
  return {.axis = piece.axis, .place = static_cast<std::int32_t>(std::lround(place))};
}

/// False if the fan carries a face outside the plane.  An empty plane becomes the first face's.
bool add_fan(const DistanceGuard& guard, LocalVertex v, std::span<const FanTriangle> fan,
             std::optional<FlatPlane>& plane) {
  const auto is_there = [&](const DistanceGuard::Piece& piece) {
    const FlatPlane found = plane_of(piece);
    if (!plane) plane = found;
    return found == *plane;
  };
  return std::all_of(fan.begin(), fan.end(), [&](const FanTriangle& t) {
    return guard.all_pieces(triangle_key(v, t.a, t.b), t.low, is_there);
  });
}

std::optional<FlatPlane> plane_of(const TetMesh& mesh, LocalVertex v,
                                  std::span<const FanTriangle> fan) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    const FlatPlane plane{.axis = axis, .place = along(mesh.position(v), axis)};
    if (has_ring(plane, mesh, fan)) return plane;
  }
  return std::nullopt;
}

}  // namespace

std::optional<FlatPlane> flat_plane(const TetMesh& mesh, const DistanceGuard& guard, LocalVertex v,
                                    std::span<const FanTriangle> fan) {
  std::optional<FlatPlane> plane;
  if (!add_fan(guard, v, fan, plane)) return std::nullopt;
  return plane ? plane : plane_of(mesh, v, fan);
}

bool has_ring(const FlatPlane& plane, const TetMesh& mesh, std::span<const FanTriangle> fan) {
  const auto is_in_plane = [&](LocalVertex w) {
    return along(mesh.position(w), plane.axis) == plane.place;
  };
  return std::all_of(fan.begin(), fan.end(),
                     [&](const FanTriangle& t) { return is_in_plane(t.a) && is_in_plane(t.b); });
}

bool WideFlatPlane::holds(const FlatPlane& plane, const TetMesh& mesh, const DistanceGuard& guard,
                          std::span<const FanTriangle> fan) {
  const auto is_flat_around = [&](LocalVertex w) {
    fans_.collect(mesh, w, fan_);
    std::optional<FlatPlane> same = plane;
    return add_fan(guard, w, fan_, same);
  };
  return std::all_of(fan.begin(), fan.end(), [&](const FanTriangle& t) {
    return is_flat_around(t.a) && is_flat_around(t.b);
  });
}

}  // namespace mw
