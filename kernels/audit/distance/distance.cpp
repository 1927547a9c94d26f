// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The report on distances.
#include "kernels/audit/distance/distance.h"

#include <algorithm>
#include <limits>

#include "kernels/audit/check.h"
#include "kernels/audit/distance/tile.h"

namespace mw::audit {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

class Conclusion {
 public:
  Conclusion(std::span<const LabelDistances> rows, double limit, double reach)
      : rows_(rows), reach_(reach) {
    report_.limit = limit;
  }

  DistanceReport run() {
    for (std::size_t row = 0; row < rows_.size(); ++row) conclude(row);
    report_.max_voxels = report_.is_finite() ? all_.largest : kEndless;
    report_.mean_voxels = report_.is_finite() ? all_.mean() : kEndless;
    return std::move(report_);
  }

 private:
  void conclude(std::size_t row) {
    const LabelDistances& found = rows_[row];
    const std::size_t gap = rows_.size() - 1;
    if (!found.in_volume && !found.in_mesh) return;
    if (row == gap && !found.in_mesh) return;
    const Label label = row == gap ? kLeftOut : row + 1 == gap ? kUnknown : static_cast<Label>(row);
    if (!found.in_volume || !found.in_mesh) {
      report_.per_label.push_back({label, kEndless, kEndless, kEndless, kEndless});
      (found.in_volume ? report_.only_in_volume : report_.only_in_mesh).push_back(label);
      return;
    }
    // What was left out is not measured from the input to the mesh.
    const DistanceTally to_mesh = row == gap ? DistanceTally{} : with_far(found.to_mesh);
    const DistanceTally to_input = with_far(found.to_input);
    report_.per_label.push_back(
        {label, to_mesh.largest, to_mesh.mean(), to_input.largest, to_input.mean()});
    all_.add(to_mesh);
    all_.add(to_input);
  }

  [[nodiscard]] DistanceTally with_far(DistanceTally tally) {
    if (tally.far > 0) tally.largest = std::max(tally.largest, reach_);
    report_.far_samples += tally.far;
    return tally;
  }

  std::span<const LabelDistances> rows_;
  double reach_;
  DistanceTally all_;
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

DistanceReport conclude_distances(std::span<const LabelDistances> rows, double limit,
                                  double reach) {
  return Conclusion(rows, limit, reach).run();
}

std::string sampling_text(const DistanceReport& report) {
  std::string out =
      "sampled to " + number(kCoveringRadius) + " where it may be above " + number(report.limit);
  if (report.far_samples > 0) {
    out += "; " + std::to_string(report.far_samples) + " samples are farther than was looked";
  }
  return out;
}

}  // namespace mw::audit
