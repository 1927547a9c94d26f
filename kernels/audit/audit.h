// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An independent second opinion on a finished mesh: promises P1 to P4 and P8 (`mwmesh verify`).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kernels/audit/check.h"
#include "kernels/audit/distance/distance.h"
#include "kernels/audit/partition/placement.h"
#include "kernels/audit/partition/validity.h"
#include "kernels/audit/shape/quality.h"
#include "kernels/audit/shape/shape.h"
#include "kernels/audit/shape/volumes.h"
#include "kernels/audit/subject.h"
#include "kernels/audit/topology/betti.h"
#include "kernels/audit/topology/junctions.h"
#include "kernels/audit/topology/pinches.h"

namespace mw::audit {

struct AuditOptions {
  double radius_ratio_floor = kSliverRadiusRatio;  ///< P3 fails below this
  bool count_junctions = false;                    ///< P1 also for interfaces and meetings
  bool measure_distance = true;                    ///< if false, only with max_distance
  std::optional<double> max_distance;              ///< in voxels; if set, P4 fails above this
  unsigned periodic = 0;   ///< axes along which P2 wants opposite sides alike, a bit for each
  Index3 layers{1, 1, 1};  ///< distances are in voxels cut into these layers along each axis
  /// The labels that the mesh is to hold; empty for all.  If some are left out, P1, P4 and P8 are
  /// about the others, and P2 as judge_validity() says.  REQUIRES: empty, or !count_junctions.
  KeptLabels kept = {};
  /// Kept labels of which parts were left out; empty for none.  For these P1 says that the open
  /// region has no more components, tunnels and cavities than that of the voxels, P4 is one-sided,
  /// from the mesh to the voxels, and P8 says nothing.
  KeptLabels partial = {};
  /// Names labels in the details of checks.
  LabelText label_text = {};
  /// How often all edges were halved since contraction, where that is known: then no label may have
  /// more pinches than its voxels.  If empty, one whose voxels have none may have none.
  std::optional<int> halvings = {};
  /// P8 fails above this share (volume_bound()), for labels of at least kMinJudgedVoxels; if empty,
  /// P8 is not checked.
  std::optional<double> max_volume_error = 0.05;
};

/// Everything an audit found.  Rows of Betti numbers are dense labels, then the exterior.
struct AuditReport {
  /// The checks of validity, then "P4 place", "P1 topology", "P1 pinches", "P1 interfaces" and "P1
  /// meetings" if asked for, "P3 radius ratio", "P4 distance", and "P8 volumes" if asked for.  "P4
  /// distance" needs a bound, or a label with an interface on one side only, which fails without a
  /// bound too.
  std::vector<Check> checks;
  std::vector<RegionBetti> voxels;
  std::vector<RegionBetti> mesh;  ///< empty when the mesh could not be read as one
  /// Labels whose Betti numbers differ, ascending dense labels; the exterior is kExterior.
  std::vector<Label> labels_changed;
  LabelPinches pinches;  ///< of all labels that are kept, together
  std::optional<JunctionReport>
      junctions;  ///< as AuditOptions ask, if the mesh could be read as one
  /// The mesh is no partition of the box, so what was counted on it is indicative only.
  bool topology_is_indicative = false;
  ValidityReport validity;
  QualityReport quality;
  VolumeReport volumes;
  ShapeReport shape;
  std::optional<DistanceReport>
      distance;  ///< as AuditOptions ask, if the mesh could be read as one

  [[nodiscard]] bool passed() const;
};

/// What was found, before it is judged.  The first check of `validity` is "P2 input".
struct AuditFindings {
  std::vector<RegionBetti> voxels;
  std::vector<RegionBetti> mesh;  ///< a mesh with gaps has no row of the exterior
  /// By dense label; those of the mesh are counted after all halvings.
  std::vector<LabelPinches> pinches;
  ValidityReport validity;
  std::optional<JunctionReport> junctions;
  Check place;  ///< see judge_places()
  QualityReport quality;
  std::optional<DistanceReport> distance;
  VolumeReport volumes;
  ShapeReport shape;
};

/// Judges what was found.  If "P2 input" failed, only voxels and validity are looked at.
[[nodiscard]] AuditReport judge(AuditFindings findings, const AuditOptions& options);

}  // namespace mw::audit
