// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// First moments, and the 48 symmetries of a cube as far as the box has them.
#include "kernels/audit/partition/placement.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/vector3.h"

namespace mw::audit {
namespace {

Vector3 middle_of(Index3 shape) {
  return {static_cast<double>(shape.x) / 2, static_cast<double>(shape.y) / 2,
          static_cast<double>(shape.z) / 2};
}

/// Places axis k of the volume along axis `axes[k]`, turned over where signs[k] is -1.
struct Symmetry {
  std::array<std::size_t, 3> axes;
  Vector3 signs;

  [[nodiscard]] bool is_identity() const {
    return axes == std::array<std::size_t, 3>{0, 1, 2} && signs == Vector3{1, 1, 1};
  }
  [[nodiscard]] bool keeps(Index3 shape) const {
    const std::array<std::int64_t, 3> s{shape.x, shape.y, shape.z};
    return s[axes[0]] == s[0] && s[axes[1]] == s[1] && s[axes[2]] == s[2];
  }
};

std::vector<Symmetry> symmetries(Index3 shape) {
  std::vector<Symmetry> out;
  std::array<std::size_t, 3> axes{0, 1, 2};
  do {
    for (unsigned flips = 0; flips < 8; ++flips) {
      const auto sign = [flips](unsigned axis) { return (flips >> axis & 1U) != 0 ? -1.0 : 1.0; };
      const Symmetry one{axes, {sign(0), sign(1), sign(2)}};
      if (one.keeps(shape)) out.push_back(one);
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return out;
}

/// Root of the mean square of the distances between centres of labels.
double misfit(const PlaceTally& volume, const PlaceTally& mesh, const Symmetry& by) {
  double sum = 0;
  std::size_t labels = 0;
  for (std::size_t l = 0; l < volume.volumes.size(); ++l) {
    if (!(volume.volumes[l] > 0 && mesh.volumes[l] > 0)) continue;
    ++labels;
    for (std::size_t k = 0; k < 3; ++k) {
      const double wanted = by.signs[k] * volume.moments[l][k] / volume.volumes[l];
      const double found = mesh.moments[l][by.axes[k]] / mesh.volumes[l];
      sum += (found - wanted) * (found - wanted);
    }
  }
  return labels == 0 ? 0 : std::sqrt(sum / static_cast<double>(labels));
}

}  // namespace

void PlaceTally::add(const PlaceTally& other, std::span<const Label> labels) {
  for (std::size_t l = 0; l < labels.size(); ++l) {
    volumes[labels[l]] += other.volumes[l];
    for (std::size_t k = 0; k < 3; ++k) moments[labels[l]][k] += other.moments[l][k];
  }
}

PlaceTally places_of_mesh(const MeshTile& tile, std::size_t label_count, const Frame& frame,
                          Index3 shape) {
  PlaceTally out(label_count);
  const Vector3 middle = middle_of(shape);
  for (std::size_t t = 0; t < tile.mesh.tets.size(); ++t) {
    const Label label = tile.mesh.labels[t];
    if (label >= label_count || !tile.owns_tet(t)) continue;
    std::array<Vector3, 4> p{};
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] = minus(frame.in_voxels(tile.mesh.vertices[tile.mesh.tets[t][i]]), middle);
    }
    const double volume = std::abs(volume6(p[0], p[1], p[2], p[3])) / 6;
    out.volumes[label] += volume;
    for (std::size_t k = 0; k < 3; ++k) {
      out.moments[label][k] += volume * (p[0][k] + p[1][k] + p[2][k] + p[3][k]) / 4;
    }
  }
  return out;
}

PlaceTally places_of_voxels(const Box3& box, std::span<const Label> labels, std::size_t label_count,
                            Index3 shape) {
  PlaceTally out(label_count);
  const Vector3 middle = middle_of(shape);
  std::size_t next = 0;
  for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
    for (std::int64_t y = box.lo.y; y < box.hi.y; ++y) {
      for (std::int64_t x = box.lo.x; x < box.hi.x; ++x) {
        const Label label = labels[next++];
        out.volumes[label] += 1;
        out.moments[label][0] += static_cast<double>(x) + 0.5 - middle[0];
        out.moments[label][1] += static_cast<double>(y) + 0.5 - middle[1];
        out.moments[label][2] += static_cast<double>(z) + 0.5 - middle[2];
      }
    }
  }
  return out;
}

Check judge_places(const PlaceTally& volume, const PlaceTally& mesh, Index3 shape) {
  constexpr double kFarVoxels = 1, kTimesBetter = 3;
  double as_it_is = 0, otherwise = -1;
  for (const Symmetry& symmetry : symmetries(shape)) {
    const double found = misfit(volume, mesh, symmetry);
    if (symmetry.is_identity()) {
      as_it_is = found;
    } else if (otherwise < 0 || found < otherwise) {
      otherwise = found;
    }
  }
  const bool passed = as_it_is <= kFarVoxels || kTimesBetter * otherwise >= as_it_is;
  std::string detail = "centres of labels are off by " + number(as_it_is) + " voxels (rms)";
  if (!passed) detail += "; mirrored or turned by " + number(otherwise) + " only";
  return {"P4 place", passed, detail};
}

}  // namespace mw::audit
