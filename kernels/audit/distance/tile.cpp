// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Both directions of the distance, from the centre of each face and piece, then from its parts.
#include "kernels/audit/distance/tile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "kernels/audit/distance/input.h"
#include "kernels/audit/distance/trees.h"

namespace mw::audit {
namespace {

/// Asks for the nearest item of a label.  Samples come in an order in which the last answer is a
/// good first guess, also for the other label that the item bounds.
template <class Items>
class Finder {
 public:
  Finder(const LabelTrees& trees, std::size_t label_count, Items items)
      : trees_(trees), items_(items), last_(label_count, kNone) {}

  /// Returns an infinite distance when the label has no item.  An item within `enough` will do.
  [[nodiscard]] LabelTrees::Nearest nearest(Label label, const VoxelPoint& p, double enough = -1) {
    if (trees_.empty(label)) return {};
    const auto to_item = [&](std::uint32_t item) { return items_.squared_distance(p, item); };
    LabelTrees::Nearest guess;
    if (last_[label] != kNone) guess = {to_item(last_[label]), last_[label]};
    const double square = enough < 0 ? -1 : enough * enough;
    const LabelTrees::Nearest found = trees_.nearest(label, p, guess, to_item, square);
    for (const Label bounded : items_.labels(found.item)) last_[bounded] = found.item;
    return found;
  }
  [[nodiscard]] double distance(Label label, const VoxelPoint& p, double enough = -1) {
    return std::sqrt(nearest(label, p, enough).squared);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  const LabelTrees& trees_;
  Items items_;
  std::vector<std::uint32_t> last_;
};

/// The mesh's interface as items.
struct PieceItems {
  std::span<const InterfaceTriangle> pieces;

  [[nodiscard]] double squared_distance(const VoxelPoint& p, std::uint32_t item) const {
    return audit::squared_distance(p, pieces[item].corners);
  }
  [[nodiscard]] const LabelPair& labels(std::uint32_t item) const { return pieces[item].labels; }
};

/// Means are taken over one face out of this number.
constexpr std::uint32_t kWeighed = 4;

/// A square on a voxel face, by its centre.
struct Square {
  VoxelPoint centre{};
  std::uint32_t axis = 0;  ///< axis of the normal
  double half = 0.5;       ///< half the length of its edge

  [[nodiscard]] double reach() const { return half * std::numbers::sqrt2; }
  [[nodiscard]] std::array<Square, 4> quarters() const {
    std::array<Square, 4> out;
    for (unsigned i = 0; i < 4; ++i) {
      out[i] = {centre, axis, half / 2};
      for (unsigned k = 0; k < 2; ++k) {
        out[i].centre[(axis + 1 + k) % 3] += (i >> k & 1U) != 0 ? half / 2 : -half / 2;
      }
    }
    return out;
  }
};

using PieceFinder = Finder<PieceItems>;

/// Visits cubes that the box is made of, so that faces near one another follow one another.
template <class Visit>
void for_each_cube(const Box3& box, Visit&& visit) {
  constexpr Index3 kCube{4, 4, 4};
  for_each_index(cells_of({{0, 0, 0}, box.shape()}, kCube), [&](Index3 c) {
    const Index3 lo = box.lo + Index3{c.x * kCube.x, c.y * kCube.y, c.z * kCube.z};
    visit(intersection({lo, lo + kCube}, box));
  });
}

class TileDistances {
 public:
  explicit TileDistances(const DistanceTask& task)
      : task_(task),
        lo_(task.voxels.loaded.lo),
        gap_(static_cast<Label>(task.label_count + 1)),
        rows_(task.label_count + 2) {
    pieces_.reserve(task.pieces.size());
    for (const InterfaceTriangle& piece : task.pieces) pieces_.push_back(moved(piece));
    sort_along_curve(pieces_, {{0, 0, 0}, task.voxels.loaded.shape()});
  }

  std::vector<LabelDistances> run() {
    measure_pieces();
    measure_faces();
    return std::move(rows_);
  }

 private:
  [[nodiscard]] const VoxelLabels& voxels() const { return task_.voxels.voxels; }

  /// Moves the origin to the first voxel loaded, which is exact, as only leading digits vanish.
  [[nodiscard]] InterfaceTriangle moved(InterfaceTriangle piece) const {
    const std::array<double, 3> by{static_cast<double>(lo_.x), static_cast<double>(lo_.y),
                                   static_cast<double>(lo_.z)};
    for (VoxelPoint& p : piece.corners) {
      for (std::size_t k = 0; k < 3; ++k) p[k] -= by[k];
    }
    return piece;
  }

  /// Each piece is measured in exactly one tile, even if it lies outside of the volume.
  [[nodiscard]] bool is_measured(const InterfaceTriangle& piece) const {
    const VoxelPoint p = centroid(piece.corners);
    const Index3 s = task_.voxels.shape;
    const auto voxel = [](double at, std::int64_t lo, std::int64_t count) {
      const double whole = std::floor(at) + static_cast<double>(lo);
      return static_cast<std::int64_t>(std::clamp(whole, 0.0, static_cast<double>(count - 1)));
    };
    return task_.samples.contains(
        {voxel(p[0], lo_.x, s.x), voxel(p[1], lo_.y, s.y), voxel(p[2], lo_.z, s.z)});
  }

  /// Where the distance of a point is no larger than this, those of points up to `around` away are
  /// not above the largest so far, or not above the limit, and tell nothing new.
  [[nodiscard]] double enough(const DistanceTally& tally, double around) const {
    return std::max(tally.largest, task_.limit) - around;
  }

  /// Takes a distance into the tally.  Returns whether something is in reach.
  bool take(DistanceTally& tally, double distance) const {
    if (distance > task_.reach) {
      ++tally.far;
      return false;
    }
    tally.largest = std::max(tally.largest, distance);
    return true;
  }

  static void weigh(DistanceTally& tally, double distance, double weight) {
    tally.sum.add(weight * distance);
    tally.weight.add(weight);
  }

  // ---- from the mesh to the input

  void measure_pieces() {
    for (const InterfaceTriangle& piece : pieces_) {
      if (!is_measured(piece)) continue;
      const VoxelPoint middle = centroid(piece.corners);
      const std::array<CloseFaces::Near, 2> near = to_faces(piece.labels, middle);
      const double weight = area(piece.corners);
      for (std::size_t i = 0; i < 2; ++i) {
        DistanceTally& tally = rows_[piece.labels[i]].to_input;
        rows_[piece.labels[i]].in_mesh = true;
        look_around(piece.corners, piece.labels[i], near[i], tally);
        const double distance = std::sqrt(near[i].squared);
        if (distance <= task_.reach) weigh(tally, distance, weight);
      }
    }
  }

  /// Measures a triangle and, where needed, its halves.  near is the face nearest to the centroid.
  void look_around(const VoxelTriangle& t, Label label, const CloseFaces::Near& near,
                   DistanceTally& tally) {
    const double distance = std::sqrt(near.squared);
    if (!take(tally, distance)) return;
    const double around = radius(t);
    if (around <= kCoveringRadius || distance <= enough(tally, around)) return;
    if (farthest_corner(t, near.face) <= enough(tally, 0)) return;
    for (const VoxelTriangle& half : halves(t)) {
      look_around(half, label, to_faces({label, label}, centroid(half))[0], tally);
    }
  }

  /// Bounds the distance of all points of the triangle from the face, as that is convex.
  static double farthest_corner(const VoxelTriangle& t, const Extent& face) {
    double squared = 0;
    for (const VoxelPoint& corner : t) squared = std::max(squared, squared_distance(corner, face));
    return std::sqrt(squared);
  }

  /// The nearest face of each of the two labels.
  [[nodiscard]] std::array<CloseFaces::Near, 2> to_faces(const LabelPair& labels,
                                                         const VoxelPoint& p) {
    std::array<CloseFaces::Near, 2> near = CloseFaces(voxels()).nearest(p, labels);
    for (std::size_t i = 0; i < 2; ++i) {
      const bool is_close = near[i].squared <= CloseFaces::kReach * CloseFaces::kReach;
      if (is_close && labels[i] != gap_) continue;
      if (!face_finder_) make_face_finder();
      const LabelTrees::Nearest found = face_finder_->nearest(labels[i], p);
      near[i].squared = found.squared;
      if (std::isfinite(found.squared)) near[i].face = extent_of(faces_[found.item]);
    }
    return near;
  }

  /// Called when a sample first needs it: most tiles have a few such samples, some have none.
  void make_face_finder() {
    faces_ = interface_faces(voxels());
    face_trees_.emplace(
        rows_.size(), faces_.size(), [&](std::size_t i) { return rows_of(faces_[i]); },
        [&](std::size_t i) { return extent_of(faces_[i]); });
    face_finder_.emplace(*face_trees_, rows_.size(), FaceItems{*this});
  }

  /// All labels that were left out share a row, faces between two of them included.
  [[nodiscard]] LabelPair rows_of(const VoxelFace& face) const {
    LabelPair labels = labels_of(face, voxels());
    for (Label& label : labels) {
      if (!keeps(task_.kept, label)) label = gap_;
    }
    return labels;
  }

  // ---- from the input to the mesh

  void measure_faces() {
    const LabelTrees trees(
        rows_.size(), pieces_.size(), [&](std::size_t i) { return pieces_[i].labels; },
        [&](std::size_t i) { return extent_of(pieces_[i].corners); });
    PieceFinder finder(trees, rows_.size(), {pieces_});
    const Box3 corners{task_.samples.lo - lo_, task_.samples.hi - lo_};
    for_each_cube(corners, [&](const Box3& cube) {
      visit_interface_faces(voxels(), cube, [&](const VoxelFace& face, const LabelPair& labels) {
        for (const Label label : labels) measure_face(face, label, finder);
      });
    });
  }

  void measure_face(const VoxelFace& face, Label label, PieceFinder& finder) {
    const bool is_kept = keeps(task_.kept, label);
    rows_[is_kept ? label : gap_].in_volume = true;
    if (!is_kept) return;
    const Square square = square_of(face);
    DistanceTally& tally = rows_[label].to_mesh;
    if (!is_weighed(face)) {
      look_from(square, label, finder, tally);
      return;
    }
    const double distance = finder.distance(label, square.centre);
    look_around(square, label, distance, finder, tally);
    if (distance <= task_.reach) weigh(tally, distance, 1);
  }

  /// Means are taken over some of the faces, spread evenly; of the others it is enough to know that
  /// they are near.
  [[nodiscard]] bool is_weighed(const VoxelFace& face) const {
    const auto [x, y, z] = face.upper;
    const auto first = static_cast<std::uint32_t>(lo_.x + lo_.y + lo_.z);
    return (first + x + y + z) % kWeighed == 0;
  }

  static Square square_of(const VoxelFace& face) {
    Square out{.axis = face.axis};
    for (std::size_t k = 0; k < 3; ++k) {
      out.centre[k] = face.upper[k] + (k == face.axis ? 0.0 : 0.5);
    }
    return out;
  }

  void look_from(const Square& square, Label label, PieceFinder& finder, DistanceTally& tally) {
    const bool is_last = square.reach() <= kCoveringRadius;
    const double near = enough(tally, is_last ? 0 : square.reach());
    const double distance = finder.distance(label, square.centre, near);
    if (distance > near) look_around(square, label, distance, finder, tally);
  }

  /// Measures a square and, where needed, its quarters.  distance is that of its centre.
  void look_around(const Square& square, Label label, double distance, PieceFinder& finder,
                   DistanceTally& tally) {
    if (!take(tally, distance)) return;
    if (square.reach() <= kCoveringRadius || distance <= enough(tally, square.reach())) return;
    for (const Square& quarter : square.quarters()) look_from(quarter, label, finder, tally);
  }

  /// The input's interface as items.
  struct FaceItems {
    const TileDistances& tile;

    [[nodiscard]] double squared_distance(const VoxelPoint& p, std::uint32_t item) const {
      return audit::squared_distance(p, extent_of(tile.faces_[item]));
    }
    [[nodiscard]] LabelPair labels(std::uint32_t item) const {
      return tile.rows_of(tile.faces_[item]);
    }
  };

  const DistanceTask& task_;
  Index3 lo_;
  Label gap_;  ///< the row of what was left out
  std::vector<LabelDistances> rows_;
  std::vector<InterfaceTriangle> pieces_;
  std::vector<VoxelFace> faces_;
  std::optional<LabelTrees> face_trees_;
  std::optional<Finder<FaceItems>> face_finder_;
};

}  // namespace

void DistanceTally::add(const DistanceTally& other) {
  largest = std::max(largest, other.largest);
  sum.add(other.sum);
  weight.add(other.weight);
  far += other.far;
}

void LabelDistances::add(const LabelDistances& other) {
  to_input.add(other.to_input);
  to_mesh.add(other.to_mesh);
  in_volume = in_volume || other.in_volume;
  in_mesh = in_mesh || other.in_mesh;
}

std::vector<LabelDistances> measure_distances(const DistanceTask& task) {
  return TileDistances(task).run();
}

}  // namespace mw::audit
