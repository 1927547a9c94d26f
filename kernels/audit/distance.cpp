// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Both directions of the distance, a sample at a time.
#include "kernels/audit/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "kernels/audit/check.h"
#include "kernels/audit/compensated_sum.h"
#include "kernels/audit/distance_input.h"
#include "kernels/audit/distance_mesh.h"
#include "kernels/audit/distance_trees.h"

namespace mw::audit {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kMostMeshSamples = 2e8;

/// Distances of one label in one direction.
struct Tally {
  double largest = 0;
  CompensatedSum sum;
  CompensatedSum weight;

  void add(double distance, double w) {
    largest = std::max(largest, distance);
    sum.add(w * distance);
    weight.add(w);
  }
  [[nodiscard]] double mean() const {
    return weight.value() > 0 ? sum.value() / weight.value() : 0;
  }
};

/// Asks for the nearest item of a label.  Samples come in an order in which the last answer is a
/// good first guess.
template <class SquaredDistance>
class Finder {
 public:
  Finder(const LabelTrees& trees, std::size_t label_count, SquaredDistance squared_distance)
      : trees_(trees), squared_distance_(squared_distance), last_(label_count, kNone) {}

  /// REQUIRES: the label has an item.
  [[nodiscard]] double distance(Label label, const VoxelPoint& p) {
    const auto to_item = [&](std::uint32_t item) { return squared_distance_(p, item); };
    LabelTrees::Nearest guess;
    if (last_[label] != kNone) guess = {to_item(last_[label]), last_[label]};
    const LabelTrees::Nearest found = trees_.nearest(label, p, guess, to_item);
    last_[label] = found.item;
    return std::sqrt(found.squared);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  const LabelTrees& trees_;
  SquaredDistance squared_distance_;
  std::vector<std::uint32_t> last_;
};

class DistanceMeasurement {
 public:
  /// Labels that the volume does not have are one more, and what is left out is the last.
  DistanceMeasurement(const VoxelLabels& volume, std::size_t label_count, const AuditMesh& mesh,
                      const Frame& frame, const KeptLabels& kept)
      : volume_(volume),
        kept_(kept),
        triangles_(interface_triangles(mesh, label_count, frame, volume.shape, !kept.empty())),
        gap_(static_cast<Label>(label_count + 1)),
        rows_(label_count + 2),
        to_input_(rows_),
        to_mesh_(rows_),
        in_volume_(rows_),
        in_mesh_(rows_) {}

  DistanceReport run() {
    report_.mesh_triangles = triangles_.size();
    for (const InterfaceTriangle& t : triangles_) {
      for (const Label label : t.labels) in_mesh_[label] = true;
    }
    measure_mesh_to_input();
    measure_input_to_mesh();
    for (std::size_t row = 0; row < rows_; ++row) conclude(row);
    conclude_all();
    return std::move(report_);
  }

 private:
  void measure_mesh_to_input() {
    const std::vector<VoxelFace> faces = interface_faces(volume_);
    const LabelTrees trees(
        rows_, faces.size(), [&](std::size_t i) { return rows_of(faces[i]); },
        [&](std::size_t i) { return extent_of(faces[i]); });
    for (std::size_t row = 0; row < rows_; ++row) {
      in_volume_[row] = !trees.empty(static_cast<Label>(row));
    }
    report_.voxel_faces = faces.size();
    report_.mesh_covering_radius =
        affordable_radius(triangles_, kMeshCoveringRadius, kMostMeshSamples);
    Finder finder(trees, rows_, [&](const VoxelPoint& p, std::uint32_t face) {
      return squared_distance(p, extent_of(faces[face]));
    });
    for (const InterfaceTriangle& t : triangles_) measure_triangle(t, finder);
  }

  /// All labels that were left out share a row, faces between two of them included.
  [[nodiscard]] LabelPair rows_of(const VoxelFace& face) const {
    LabelPair labels = labels_of(face, volume_);
    for (Label& label : labels) {
      if (!keeps(kept_, label)) label = gap_;
    }
    return labels;
  }

  template <class FaceFinder>
  void measure_triangle(const InterfaceTriangle& t, FaceFinder& finder) {
    const std::uint64_t parts = parts_of_edge(t.corners, report_.mesh_covering_radius);
    const auto edge = static_cast<double>(parts);
    const double weight = area(t.corners) / ((edge + 1) * (edge + 2) / 2);
    const CloseFaces close(volume_);
    visit_triangle_samples(t.corners, parts, [&](const VoxelPoint& p) {
      const std::array<double, 2> squared = close.squared_distances(p, t.labels);
      for (std::size_t i = 0; i < 2; ++i) {
        const Label label = t.labels[i];
        if (!in_volume_[label]) continue;
        const bool is_close =
            label != gap_ && squared[i] <= CloseFaces::kReach * CloseFaces::kReach;
        to_input_[label].add(is_close ? std::sqrt(squared[i]) : finder.distance(label, p), weight);
      }
    });
  }

  void measure_input_to_mesh() {
    const LabelTrees trees(
        rows_, triangles_.size(), [&](std::size_t i) { return triangles_[i].labels; },
        [&](std::size_t i) { return extent_of(triangles_[i].corners); });
    Finder finder(trees, rows_, [&](const VoxelPoint& p, std::uint32_t triangle) {
      return squared_distance(p, triangles_[triangle].corners);
    });
    const FaceSampling sampling =
        report_.voxel_faces < kManyInterfaceFaces ? FaceSampling::kNine : FaceSampling::kFive;
    report_.samples_a_face = samples_a_face(sampling);
    report_.input_covering_radius = covering_radius(sampling);
    const double weight = 1.0 / report_.samples_a_face;
    visit_face_samples(volume_, sampling,
                       [&](const VoxelPoint& p, std::span<const TouchedLabel> touched) {
                         for (const TouchedLabel& t : touched) {
                           if (!in_mesh_[t.label]) continue;
                           to_mesh_[t.label].add(finder.distance(t.label, p), t.faces * weight);
                         }
                       });
  }

  void conclude(std::size_t row) {
    if (!in_volume_[row] && !in_mesh_[row]) return;
    if (row == gap_ && !in_mesh_[row]) return;
    const Label label = row == gap_       ? kLeftOut
                        : row + 1 == gap_ ? kUnknown
                                          : static_cast<Label>(row);
    if (in_volume_[row] && in_mesh_[row]) {
      report_.per_label.push_back({label, to_mesh_[row].largest, to_mesh_[row].mean(),
                                   to_input_[row].largest, to_input_[row].mean()});
    } else {
      report_.per_label.push_back({label, kEndless, kEndless, kEndless, kEndless});
      (in_volume_[row] ? report_.only_in_volume : report_.only_in_mesh).push_back(label);
    }
  }

  void conclude_all() {
    Tally all;
    for (std::size_t row = 0; row < rows_; ++row) {
      for (const Tally& tally : {to_mesh_[row], to_input_[row]}) {
        all.largest = std::max(all.largest, tally.largest);
        all.sum.add(tally.sum.value());
        all.weight.add(tally.weight.value());
      }
    }
    report_.max_voxels = report_.is_finite() ? all.largest : kEndless;
    report_.mean_voxels = report_.is_finite() ? all.mean() : kEndless;
  }

  const VoxelLabels& volume_;
  const KeptLabels& kept_;
  std::vector<InterfaceTriangle> triangles_;
  Label gap_;  ///< the row of what was left out
  std::size_t rows_;
  std::vector<Tally> to_input_;
  std::vector<Tally> to_mesh_;
  std::vector<bool> in_volume_;
  std::vector<bool> in_mesh_;
  DistanceReport report_;
};

}  // namespace

double DistanceReport::PerLabel::max() const {
  return std::max(input_to_mesh_max, mesh_to_input_max);
}

bool DistanceReport::PerLabel::is_finite() const {
  return max() < kEndless;
}

const DistanceReport::PerLabel* DistanceReport::farthest() const {
  const PerLabel* found = nullptr;
  for (const PerLabel& row : per_label) {
    if (row.is_finite() && (found == nullptr || row.max() > found->max())) found = &row;
  }
  return found;
}

DistanceReport measure_distance(const VoxelLabels& volume, std::size_t label_count,
                                const AuditMesh& mesh, const Frame& frame, const KeptLabels& kept) {
  return DistanceMeasurement(volume, label_count, mesh, frame, kept).run();
}

std::string sampling_text(const DistanceReport& report) {
  return "sampled to " + number(report.input_covering_radius) + " on voxel faces (" +
         std::to_string(report.samples_a_face) + " points each) and " +
         number(report.mesh_covering_radius) + " on triangles";
}

}  // namespace mw::audit
