// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The hard two-sided bound on the distance between input and output interfaces (promise P4).
#pragma once

#include <optional>

#include "kernels/distance/carried_samples.h"
#include "kernels/distance/interface_fan.h"
#include "kernels/distance/label_reach.h"
#include "kernels/distance/point_triangle.h"

namespace mw {

/// Refuses changes of the mesh that would let input and output interfaces drift apart by more than
/// D voxels, for any label, in either direction.
///
/// Output to input: each changed interface triangle is proved by LabelReach.
/// Input to output: every voxel face between two labels has samples; each is carried by one output
/// triangle between the same labels at a distance of at most D less the covering radius, which
/// proves all of the face.  A change hands the samples of the triangles that it replaces to the
/// nearest new ones between the same labels, and is refused when one ends too far.
///
/// Contractions of an inner vertex and flips inside a label change no interface triangle;
/// everything else comes here.
class DistanceGuard {
 public:
  /// `labels` as LabelReach asks; keeps references.
  DistanceGuard(const LabelBox& labels, double max_distance, CarriedSamples& samples);

  /// Smallest bound that the samples can prove anything for.
  [[nodiscard]] static constexpr double least_distance() { return 2.0 * kSampleCoveringRadius; }

  /// Would contracting (keep, drop) to `target` keep the bound?  Remembers where the samples go.
  /// REQUIRES: both ends free; not yet contracted.
  [[nodiscard]] bool allows_contraction(const TetMesh& mesh, LocalVertex keep, LocalVertex drop,
                                        Point target);
  /// The same for a move of v.
  [[nodiscard]] bool allows_move(const TetMesh& mesh, LocalVertex v, Point target);
  /// The same for a flip that replaces interface triangles (p, q, a) and (p, q, b) between labels
  /// low < high by (a, b, p) and (a, b, q).
  [[nodiscard]] bool allows_flip(const TetMesh& mesh, const std::array<LocalVertex, 2>& pq,
                                 const std::array<LocalVertex, 2>& ab, Label low, Label high);
  /// Hands the samples over, after the change that was last allowed has been made.
  void commit();

 private:
  /// A triangle before and after the change; `after` is dropped when the triangle vanishes.
  struct Changed {
    TriangleKey before;
    TriangleKey after;
    DistanceTriangle shape;  ///< after the change, in voxels
    Label low = 0;
    Label high = 0;
    bool vanishes = false;
    bool stays = false;  ///< not changed at all; may receive samples
  };
  struct Handover {
    std::size_t to = 0;
    FaceSamples samples = 0;
  };

  void add_changed(const TetMesh& mesh, LocalVertex v, LocalVertex other, LocalVertex survivor,
                   Point target);
  [[nodiscard]] bool keeps_bound();
  [[nodiscard]] bool place_samples(std::size_t from);
  [[nodiscard]] bool place(FaceSamples samples, std::size_t from);
  [[nodiscard]] std::optional<std::size_t> receiver(const Vec3& p, std::size_t from,
                                                    double limit) const;

  LabelReach reach_;
  double placing_distance_;
  CarriedSamples& samples_;
  InterfaceFan fan_;
  std::vector<FanTriangle> triangles_;
  std::vector<Changed> changed_;
  std::vector<Handover> handovers_;
};

}  // namespace mw
