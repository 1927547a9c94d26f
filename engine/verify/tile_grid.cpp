// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How long the edges of tiles are, and in which tile a point lies.
#include "engine/verify/tile_grid.h"

#include <cmath>

#include "engine/system/in_order.h"

namespace mw::engine {
namespace {

std::int64_t parts(std::int64_t whole, std::int64_t part) {
  return (whole + part - 1) / part;
}

Index3 counts(Index3 shape, Index3 edges) {
  return {parts(shape.x, edges.x), parts(shape.y, edges.y), parts(shape.z, edges.z)};
}

}  // namespace

TileGrid::TileGrid(Index3 shape, Index3 layers, std::int64_t edge) : shape_(shape) {
  const auto voxels = [edge](std::int64_t n) { return std::max<std::int64_t>(edge / n, 1); };
  edges_ = {voxels(layers.x), voxels(layers.y), voxels(layers.z)};
  while (counts(shape, edges_).product() > kMaxTiles) edges_ = edges_ + edges_;
  count_ = counts(shape, edges_);
}

Box3 TileGrid::box(std::uint32_t tile) const {
  const std::int64_t x = tile % count_.x, y = tile / count_.x % count_.y,
                     z = tile / count_.x / count_.y;
  const Index3 lo{x * edges_.x, y * edges_.y, z * edges_.z};
  return intersection({lo, lo + edges_}, {{0, 0, 0}, shape_});
}

std::uint32_t TileGrid::at(const std::array<double, 3>& point) const {
  const auto along = [](double p, std::int64_t count, std::int64_t edge) {
    const double voxel = std::clamp(std::floor(p), 0.0, static_cast<double>(count - 1));
    return static_cast<std::int64_t>(voxel) / edge;
  };
  return number({along(point[0], shape_.x, edges_.x), along(point[1], shape_.y, edges_.y),
                 along(point[2], shape_.z, edges_.z)});
}

Box3 TileGrid::meeting(const Box3& voxels) const {
  const Box3 box = intersection(voxels, {{0, 0, 0}, shape_});
  return {{box.lo.x / edges_.x, box.lo.y / edges_.y, box.lo.z / edges_.z}, counts(box.hi, edges_)};
}

void PieceBuckets::make_pieces(int threads) {
  radius_ = audit::piece_radius(estimates_);
  each_in_order<TilePieces>(
      {.threads = threads, .at_once = static_cast<std::size_t>(threads)}, grid_.size(),
      [this](std::uint32_t tile) { return pieces_of(tile); },
      [this](std::uint32_t, TilePieces&& found) {
        pieces_.add(found.pieces);
        for (const audit::InterfaceTriangle& triangle : found.whole) {
          cut(triangle, [this](auto tile, const auto& piece) { pieces_.add(tile, piece); });
        }
      });
}

/// Calls visit on each piece of a triangle, with the tile that its middle lies in.
template <class Visit>
void PieceBuckets::cut(const audit::InterfaceTriangle& triangle, Visit visit) const {
  const std::array<double, 3> layers{static_cast<double>(layers_.x), static_cast<double>(layers_.y),
                                     static_cast<double>(layers_.z)};
  audit::for_each_piece(triangle.corners, radius_, [&](const audit::VoxelTriangle& piece) {
    audit::VoxelPoint middle = audit::centroid(piece);
    for (std::size_t k = 0; k < 3; ++k) middle[k] /= layers[k];
    visit(grid_.at(middle), audit::InterfaceTriangle{piece, triangle.labels});
  });
}

/// Cuts triangles until their pieces are many; those that are left, and large ones, stay whole.
PieceBuckets::TilePieces PieceBuckets::pieces_of(std::uint32_t tile) {
  constexpr std::size_t kMostPieces = std::size_t{1} << 15U;
  constexpr double kMostRadii = 8;
  std::vector<audit::InterfaceTriangle> triangles;
  triangles_.take(tile, triangles);
  TilePieces out;
  std::size_t pieces = 0;
  for (const audit::InterfaceTriangle& t : triangles) {
    if (pieces >= kMostPieces || audit::radius(t.corners) > kMostRadii * radius_) {
      out.whole.push_back(t);
    } else {
      cut(t, [&](auto at, const auto& piece) {
        out.pieces.add(at, piece);
        ++pieces;
      });
    }
  }
  out.pieces.pack();
  return out;
}

std::vector<audit::InterfaceTriangle> PieceBuckets::near(const Box3& voxels) const {
  std::vector<audit::InterfaceTriangle> out;
  for_each_index(grid_.meeting(voxels), [&](Index3 at) { pieces_.load(grid_.number(at), out); });
  return out;
}

}  // namespace mw::engine
