// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The hard two-sided bound on the distance between input and output interfaces (promise P4).
#pragma once

#include <optional>

#include "kernels/distance/carried_samples.h"
#include "kernels/distance/face_lanes.h"
#include "kernels/distance/interface_fan.h"
#include "kernels/distance/label_reach.h"
#include "kernels/distance/point_triangle.h"
#include "kernels/source/source_surface.h"

namespace mw {

/// Corners of a triangle that a flip makes, in the order that its normal follows from.
using FlippedTriangle = std::array<LocalVertex, 3>;

/// Refuses changes of the mesh that would let input and output interfaces drift apart by more than
/// D voxels, for any label, in either direction.
///
/// Output to input: each changed interface triangle is proved by LabelReach.
/// Input to output: every voxel face between two labels has samples; each is carried by one output
/// triangle between the same labels at a distance of at most D less the covering radius, which
/// proves all of the face.  A change hands the samples of the triangles that it replaces to the
/// nearest new ones between the same labels, and is refused when one ends too far.  Where possible,
/// a triangle takes only samples of faces that look its own way, from the smaller label to the
/// larger: samples of one side of a thin sheet that hang on the other would pin both.  Samples that
/// no changed triangle takes may go to unchanged ones next to them.
///
/// Contractions of an inner vertex and flips inside a label change no interface triangle;
/// everything else comes here.
class DistanceGuard {
 public:
  /// Keeps references.  REQUIRES: `labels` is as LabelReach requires.
  DistanceGuard(const LabelBox& labels, double max_distance, CarriedSamples& samples);

  /// Puts pieces on the source surface.  Keeps the reference.
  /// REQUIRES: `source` has all faces whose samples are carried.
  void aim_at(const SourceSurface& source) { source_ = &source; }

  /// The labels of the input, around the window.
  [[nodiscard]] const LabelBox& labels() const { return labels_; }

  /// The smallest bound for which the samples can prove anything.
  [[nodiscard]] static constexpr double min_distance() { return 2.0 * kSampleCoveringRadius; }

  /// The quarters of one voxel face that a triangle carries.
  struct Piece {
    Vec3 middle;            ///< mean of the quarters' samples, in voxels
    double quarters = 0.0;  ///< number of quarters
    unsigned axis = 0;      ///< axis of the face
    double sign = 1.0;      ///< 1 if the larger label is above the face along the axis, else -1
  };
  /// Calls visit(piece) for each piece that a triangle carries, in an order that depends on the
  /// window's content only.  low is the smaller label at the triangle.
  template <typename Visit>
  void for_each_piece(const TriangleKey& key, Label low, Visit visit) const {
    for (const FaceSamples s : samples_.of(key)) visit(piece(s, low));
  }
  /// True if holds(piece) is true for all pieces of for_each_piece(); stops when one fails.
  template <typename Holds>
  [[nodiscard]] bool all_pieces(const TriangleKey& key, Label low, Holds holds) const {
    const std::span<const FaceSamples> all = samples_.of(key);
    return std::all_of(all.begin(), all.end(), [&](FaceSamples s) { return holds(piece(s, low)); });
  }
  /// Calls visit(group) for the pieces of for_each_piece(), in the same order, several at a time.
  template <typename Visit>
  void for_each_group(const TriangleKey& key, Label low, Visit visit) const {
    const std::span<const FaceSamples> all = samples_.of(key);
    for (std::size_t i = 0; i < all.size(); i += kLanes) {
      visit(group_of(FaceGroup(all.subspan(i, std::min(kLanes, all.size() - i))), low));
    }
  }

  /// Returns whether contracting (keep, drop) to `target` keeps the bound, and remembers where the
  /// samples go.  REQUIRES: both ends are free, and the edge is not yet contracted.
  [[nodiscard]] bool allows_contraction(const TetMesh& mesh, LocalVertex keep, LocalVertex drop,
                                        Point target);
  /// Judges the contraction when the interface triangles at both ends are at hand.
  [[nodiscard]] bool allows_contraction(const TetMesh& mesh, LocalVertex keep, LocalVertex drop,
                                        Point target, std::span<const FanTriangle> fan_of_keep,
                                        std::span<const FanTriangle> fan_of_drop);
  /// Judges a move of v, whose interface triangles are at hand.
  [[nodiscard]] bool allows_move(const TetMesh& mesh, LocalVertex v,
                                 std::span<const FanTriangle> fan, Point target);
  /// Judges a flip that replaces interface triangles of two labels by fresh ones, whose normals
  /// point to label `towards`, away from `other`.
  [[nodiscard]] bool allows_flip(const TetMesh& mesh, std::span<const TriangleKey> old,
                                 std::span<const FlippedTriangle> fresh, Label towards,
                                 Label other);
  /// Hands the samples over, after the change that was last allowed has been made.
  void commit();

 private:
  /// A triangle before and after the change; `after` is dropped when the triangle vanishes.
  struct Changed {
    TriangleKey before;
    TriangleKey after;
    DistanceTriangle shape;  ///< after the change, in voxels; its normal points to high
    Label low = 0;
    Label high = 0;
    Label side = 0;               ///< samples go to triangles on the same side
    bool in_inner_plane = false;  ///< ends of the volume, which are no interface there
    bool vanishes = false;
    bool stays = false;  ///< not changed at all; may receive samples
    /// The rows of kept_ that say which of its samples it keeps; without rows it keeps them all.
    std::size_t kept_begin = 0;
    std::size_t kept_end = 0;
    CarriedSamples::Taken taken{};  ///< its list while samples change hands
  };
  struct Handover {
    std::size_t to = 0;
    FaceSamples samples = 0;
  };

  /// A sample, or several, that look for a triangle.
  struct Wanderer {
    Vec3 point;        ///< in voxels
    std::size_t from;  ///< row of the triangle that carries it
    unsigned axis;     ///< axis of its face
    double sign;       ///< as in Piece
    double limit;      ///< the largest distance allowed
  };

  [[nodiscard]] Piece piece(FaceSamples samples, Label low) const;
  [[nodiscard]] Vec3 on_source(FaceSamples samples, const Piece& piece) const;
  [[nodiscard]] Piece piece_of_face(FaceSamples samples, Label low) const;
  [[nodiscard]] PieceGroup group_of(const FaceGroup& faces, Label low) const;
  [[nodiscard]] double sign_of(FaceSamples samples, Label low) const;
  void add_changed(const TetMesh& mesh, LocalVertex v, LocalVertex other, LocalVertex survivor,
                   Point target, std::span<const FanTriangle> fan);
  void order_ring();
  [[nodiscard]] bool is_end(LocalVertex v) const { return v == ends_[0] || v == ends_[1]; }
  void add_neighbours();
  void add_neighbours_at(LocalVertex w);
  [[nodiscard]] bool keeps_bound();
  [[nodiscard]] bool carry_samples(std::size_t from);
  [[nodiscard]] unsigned keepers(std::span<const FaceSamples> samples, const Changed& t) const;
  [[nodiscard]] bool carry(FaceSamples samples, std::size_t from);
  [[nodiscard]] bool keeps(const Wanderer& w) const;
  [[nodiscard]] std::optional<std::size_t> receiver(const Wanderer& w) const;
  [[nodiscard]] std::optional<std::size_t> receiver_nearby(const Wanderer& w);
  [[nodiscard]] std::optional<std::size_t> nearest(const Wanderer& w, std::size_t first,
                                                   double min_cosine) const;

  const LabelBox& labels_;
  const SourceSurface* source_ = nullptr;
  LabelReach reach_;
  double placing_distance_;
  CarriedSamples& samples_;
  InterfaceFan fan_;
  std::vector<FanTriangle> triangles_;
  std::vector<FanTriangle> other_triangles_;
  const TetMesh* mesh_ = nullptr;      ///< the mesh to be changed; null for a flip
  std::array<LocalVertex, 2> ends_{};  ///< both ends of the edge, or twice the vertex
  std::vector<LocalVertex> ring_;      ///< the other vertices of the changed triangles
  NearTriangle near_triangle_;
  std::vector<Changed> changed_;  ///< changed triangles, then neighbours that stay
  std::size_t neighbours_ = 0;    ///< row of the first neighbour; 0 until they are added
  std::vector<Handover> handovers_;
  std::vector<bool> kept_;
};

}  // namespace mw
