// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Triangles become numbers, as in a hash of a set.
#include "kernels/audit/partition/periodic_faces.h"

#include <algorithm>
#include <cmath>

#include "kernels/audit/partition/box_planes.h"
#include "kernels/core/mix_bits.h"

namespace mw::audit {
namespace {

constexpr double kUnits = 4096;  // in a voxel

bool has_axis(unsigned axes, unsigned axis) {
  return (axes >> axis & 1U) != 0;
}

}  // namespace

void FaceTally::add(unsigned axis, bool is_high,
                    std::array<std::array<std::int64_t, 2>, 3> corners) {
  std::sort(corners.begin(), corners.end());
  Side& side = sides_[axis][is_high ? 1 : 0];
  ++side.triangles;
  for (std::uint64_t i = 0; i < side.hashes.size(); ++i) {
    std::uint64_t hash = i;
    for (const auto& corner : corners) {
      for (const std::int64_t place : corner) {
        hash = mix_bits(hash ^ static_cast<std::uint64_t>(place));
      }
    }
    side.hashes[i] += hash;
  }
}

void FaceTally::add(const FaceTally& other) {
  for (std::size_t axis = 0; axis < sides_.size(); ++axis) {
    for (std::size_t end = 0; end < 2; ++end) {
      Side& side = sides_[axis][end];
      const Side& more = other.sides_[axis][end];
      side.triangles += more.triangles;
      for (std::size_t i = 0; i < side.hashes.size(); ++i) side.hashes[i] += more.hashes[i];
    }
  }
}

FaceTally tally_faces(const MeshTile& tile, const Frame& frame, Index3 shape, unsigned axes) {
  FaceTally out;
  if (axes == 0) return out;
  const BoxPlanes planes(frame, shape);
  const auto add = [&](unsigned axis, bool is_high, const std::array<std::uint64_t, 3>& rows) {
    std::array<std::array<std::int64_t, 2>, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      const Position at = frame.in_voxels(tile.mesh.vertices[rows[c]]);
      for (std::size_t i = 0; i < 2; ++i) {
        corners[c][i] = std::llround(at[(axis + 1 + i) % 3] * kUnits);
      }
    }
    out.add(axis, is_high, corners);
  };
  const auto visit = [&](const std::array<std::uint64_t, 3>& rows) {
    if (!tile.owns(*std::min_element(rows.begin(), rows.end()))) return;
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (const bool is_high : {false, true}) {
        const bool on_side = std::all_of(rows.begin(), rows.end(), [&](std::uint64_t row) {
          return planes.is_on(tile.mesh.vertices[row], axis, is_high ? 1 : 0);
        });
        if (on_side && has_axis(axes, axis)) add(axis, is_high, rows);
      }
    }
  };
  for (const TetRow& tet : tile.mesh.tets) {
    const auto& [a, b, c, d] = tet;
    for (const std::array<std::uint64_t, 3>& rows :
         {std::array{a, b, c}, std::array{a, b, d}, std::array{a, c, d}, std::array{b, c, d}}) {
      visit(rows);
    }
  }
  return out;
}

Check periodic_check(const FaceTally& tally, unsigned axes) {
  Check out{"P2 periodic", true, ""};
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (!has_axis(axes, axis)) continue;
    const auto& [low, high] = tally.sides(axis);
    out.passed = out.passed && low == high;
    out.detail += std::string(out.detail.empty() ? "" : "; ") + "xyz"[axis] + ": " +
                  std::to_string(low.triangles) + " and " + std::to_string(high.triangles) +
                  " triangles, " + (low == high ? "the same" : "which differ");
  }
  return out;
}

}  // namespace mw::audit
