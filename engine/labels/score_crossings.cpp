// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Scores are read label by label, and each is added to the differences at its faces.
#include "engine/labels/score_crossings.h"

#include <algorithm>
#include <bit>
#include <map>
#include <vector>

#include "kernels/core/index.h"
#include "kernels/source/crossing.h"
#include "kernels/start/cells/cell.h"

namespace mw::engine {
namespace {

struct CrossedFace {
  Index3 lower;
  unsigned axis = 0;
  std::array<Label, 2> labels{};  ///< below and above
  ScoreDifference difference{};
};

/// The faces that have a label on one side, and the voxels whose scores they look at.
struct ScoresAtFaces {
  std::vector<std::uint32_t> faces;
  Box3 box;  ///< box of the scores' voxels
};

/// The scores of one label in a box.
struct ScoreBox {
  Box3 box;
  std::vector<double> scores;

  [[nodiscard]] double at(Index3 v) const {
    return scores[static_cast<std::size_t>(box.offset(v))];
  }
};

class Crossings {
 public:
  Crossings(const io::DenseVolume& volume, const LabelBox& labels, const Box3& box)
      : volume_(volume), scores_(*volume.raw().scores()), box_(box), layers_(score_layers(volume)) {
    collect_faces(labels);
    for (const auto& [label, at] : by_label_) add_scores(label, at);
  }

  [[nodiscard]] SourceSurface surface() const {
    const SourceSurface::Part part{.box = box_, .faces = upper_faces_, .planes = planes()};
    return {box_, [&](auto visit) { visit(part); }, crossing_form(layers_)};
  }

 private:
  [[nodiscard]] Index3 score_voxel(Index3 v) const {
    return {v.x / layers_.x, v.y / layers_.y, v.z / layers_.z};
  }

  void collect_faces(const LabelBox& labels) {
    for_each_index(box_, [&](Index3 v) {
      UpperFaces found = 0;
      for (unsigned axis = 0; axis < 3; ++axis) {
        const Label below = labels.at(v), above = labels.at(v + axis_vector(axis));
        if (below == above || above == kExterior) continue;
        found = static_cast<UpperFaces>(found | 1U << axis);
        add_face({.lower = v, .axis = axis, .labels = {below, above}});
      }
      upper_faces_.push_back(found);
    });
  }

  void add_face(const CrossedFace& face) {
    const auto row = static_cast<std::uint32_t>(faces_.size());
    const Index3 below = score_voxel(face.lower);
    const Box3 both{below, below + axis_vector(face.axis) + Index3{1, 1, 1}};
    const Box3 seen = intersection(grown(both, 1), {{0, 0, 0}, scores_.shape()});
    for (const Label label : face.labels) {
      if (volume_.table().raw(label) >= scores_.labels()) continue;
      const auto [at, is_new] = by_label_.try_emplace(label);
      at->second.faces.push_back(row);
      at->second.box = is_new ? seen : hull(at->second.box, seen);
    }
    faces_.push_back(face);
  }

  void add_scores(Label label, const ScoresAtFaces& at) {
    ScoreBox read{at.box, std::vector<double>(static_cast<std::size_t>(at.box.voxels()))};
    scores_.read_scores(volume_.table().raw(label), read.box, read.scores);
    for (const std::uint32_t row : at.faces) {
      CrossedFace& face = faces_[row];
      const double sign = face.labels[0] == label ? 1.0 : -1.0;
      Index3 v = score_voxel(face.lower);
      for (std::size_t side = 0; side < 2; ++side, v = v + axis_vector(face.axis)) {
        face.difference.values[side] += sign * read.at(v);
        face.difference.slopes[side] += sign * slope(read, v);
      }
    }
  }

  /// Returns central differences, which are one-sided at the ends of the volume.
  [[nodiscard]] Vec3 slope(const ScoreBox& read, Index3 v) const {
    const Box3 all{{0, 0, 0}, scores_.shape()};
    Vec3 out = Vec3::Zero();
    for (unsigned axis = 0; axis < 3; ++axis) {
      const Index3 step = axis_vector(axis);
      const bool has_below = all.contains(v - step), has_above = all.contains(v + step);
      if (!has_below && !has_above) continue;
      const double rise = read.at(has_above ? v + step : v) - read.at(has_below ? v - step : v);
      out[static_cast<int>(axis)] = has_below && has_above ? 0.5 * rise : rise;
    }
    return out;
  }

  /// Returns the centre of a face from the middle between two voxels of scores, in lattice voxels.
  [[nodiscard]] Vec3 centre_of(const CrossedFace& face) const {
    const auto along = [](std::int64_t v, std::int64_t layers) {
      return static_cast<double>(v % layers) + 0.5 - 0.5 * static_cast<double>(layers);
    };
    Vec3 out(along(face.lower.x, layers_.x), along(face.lower.y, layers_.y),
             along(face.lower.z, layers_.z));
    out[static_cast<int>(face.axis)] = 0.0;  // two labels meet where layers of two voxels do
    return out;
  }

  [[nodiscard]] bool has_scores(const CrossedFace& face) const {
    return std::all_of(face.labels.begin(), face.labels.end(),
                       [&](Label label) { return volume_.table().raw(label) < scores_.labels(); });
  }

  [[nodiscard]] std::vector<PackedPlane> planes() const {
    const PlaneForm form = crossing_form(layers_);
    std::vector<PackedPlane> out;
    for (const CrossedFace& face : faces_) {
      const ScoreDifference none{};  // it has no crossing
      const SourcePlane crossing =
          find_crossing(has_scores(face) ? face.difference : none, face.axis);
      const LayeredFace place{.axis = face.axis, .layers = layers_, .centre = centre_of(face)};
      out.push_back(pack(on_lattice(crossing, place), form));
    }
    return out;
  }

  const io::DenseVolume& volume_;
  const io::LabelScores& scores_;
  Box3 box_;
  Index3 layers_;
  std::vector<UpperFaces> upper_faces_;
  std::vector<CrossedFace> faces_;
  std::map<Label, ScoresAtFaces> by_label_;
};

}  // namespace

Index3 score_layers(const io::DenseVolume& volume) {
  const Index3 lattice = volume.info().shape, shape = volume.raw().scores()->shape();
  return {lattice.x / shape.x, lattice.y / shape.y, lattice.z / shape.z};
}

SourceSurface score_crossings(const io::DenseVolume& volume, const LabelBox& labels,
                              const Box3& box) {
  return Crossings(volume, labels, box).surface();
}

std::uint64_t fingerprint(const io::LabelScores& scores) {
  constexpr std::uint64_t kPrime = 1099511628211U;  // FNV-1a
  constexpr std::int64_t kEdge = 64;
  std::uint64_t sum = 14695981039346656037U;
  const Box3 all{{0, 0, 0}, scores.shape()};
  std::vector<double> values;
  for (RawLabel label = 0; label < scores.labels(); ++label) {
    for_each_index(cells_of(all, {kEdge, kEdge, kEdge}), [&](Index3 cell) {
      const Index3 lo{cell.x * kEdge, cell.y * kEdge, cell.z * kEdge};
      const Box3 box = intersection({lo, lo + Index3{kEdge, kEdge, kEdge}}, all);
      values.resize(static_cast<std::size_t>(box.voxels()));
      scores.read_scores(label, box, values);
      for (const double v : values) sum = (sum ^ std::bit_cast<std::uint64_t>(v)) * kPrime;
    });
  }
  return sum;
}

}  // namespace mw::engine
