// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// All checks together and their wording.
#include "kernels/audit/audit.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

namespace mw::audit {
namespace {

std::string text_of(const Betti& b) {
  return "(" + std::to_string(b.b0) + "," + std::to_string(b.b1) + "," + std::to_string(b.b2) + ")";
}

std::string change_text(const char* region, const Betti& before, const Betti& after) {
  if (before == after) return "";
  return std::string(" ") + region + text_of(before) + " -> " + text_of(after);
}

/// Clears the rows of labels that are not kept and of the exterior, of which nothing is known.
void forget_left_out(const KeptLabels& kept, AuditReport& report) {
  if (kept.empty()) return;
  report.mesh.resize(report.voxels.size());
  for (Label row = 0; row < report.voxels.size(); ++row) {
    if (keeps(kept, row)) continue;
    report.voxels[row] = report.mesh[row] = {};
  }
}

bool has_no_more(const Betti& after, const Betti& before) {
  return after.b0 <= before.b0 && after.b1 <= before.b1 && after.b2 <= before.b2;
}

/// Betti numbers of parts that share no face add up, so those that are left have no larger ones.
bool is_kept(const RegionBetti& before, const RegionBetti& after, bool is_partial) {
  return is_partial ? has_no_more(after.open, before.open) : before == after;
}

/// looked_at is the number of rows that are compared.
Check compare_topology(AuditReport& report, std::size_t looked_at, const AuditOptions& options) {
  const LabelText& names = options.label_text;
  const std::size_t exterior = report.voxels.size() - 1;
  Offenders changed("labels changed");
  for (std::size_t row = 0; row <= exterior; ++row) {
    const RegionBetti& before = report.voxels[row];
    const RegionBetti& after = report.mesh[row];
    const bool is_part = is_partial(options.partial, static_cast<Label>(row));
    if (is_kept(before, after, is_part)) continue;
    const Label label = row == exterior ? kExterior : static_cast<Label>(row);
    report.labels_changed.push_back(label);
    changed.add([&] {
      return label_text(label, names) + change_text("closed ", before.closed, after.closed) +
             change_text("open ", before.open, after.open);
    });
  }
  std::string detail = changed.text() + " of " + std::to_string(looked_at);
  const auto parts = std::count(options.partial.begin(), options.partial.end(), true);
  if (parts > 0) {
    detail += ", of which " + std::to_string(parts) +
              " are there in part and have no more components, tunnels or cavities";
  }
  if (report.topology_is_indicative) detail += "; only indicative, as P2 fails";
  return {"P1 topology", changed.count() == 0, detail};
}

/// Returns whether a label is pinched in the mesh where its voxels do not account for it.
bool has_new_pinches(const LabelPinches& label, const std::optional<int>& halvings) {
  if (!halvings) {
    return (label.mesh.vertices > 0 && label.voxels.vertices == 0) ||
           (label.mesh.edges > 0 && label.voxels.edges == 0);
  }
  const Pinches most = label.voxels.halved(*halvings);
  return label.mesh.vertices > most.vertices || label.mesh.edges > most.edges;
}

std::string pinches_text(const Pinches& pinches) {
  return std::to_string(pinches.edges) + " edges and " + std::to_string(pinches.vertices) +
         " vertices";
}

/// Also adds up the pinches of the labels that are kept.
Check judge_pinches(std::span<const LabelPinches> pinches, const AuditOptions& options,
                    LabelPinches& sum) {
  Offenders pinched("labels have pinches that their voxels do not account for");
  for (Label label = 0; label < pinches.size(); ++label) {
    if (!keeps(options.kept, label)) continue;
    const LabelPinches& of_label = pinches[label];
    sum.voxels.add(of_label.voxels);
    sum.mesh.add(of_label.mesh);
    if (!has_new_pinches(of_label, options.halvings)) continue;
    pinched.add([&] {
      return label_text(label, options.label_text) + " " + pinches_text(of_label.mesh) + ", from " +
             pinches_text(of_label.voxels);
    });
  }
  return {"P1 pinches", pinched.count() == 0,
          pinched.text() + "; " + pinches_text(sum.mesh) + ", from " + pinches_text(sum.voxels)};
}

/// Returns text such as "3, 5, exterior".
std::string labels_text(const JunctionLabels& labels, std::size_t label_count,
                        const LabelText& names) {
  std::string out;
  for (const Label l : labels) {
    if (l == kNoLabel) break;
    if (!out.empty()) out += ", ";
    out += label_text(l < label_count ? l : l == label_count ? kExterior : kUnknown, names);
  }
  return out;
}

Check judge_junctions(const std::string& noun, const std::vector<JunctionChange>& changed,
                      std::size_t count, const AuditReport& report, const LabelText& names) {
  Offenders offenders(noun + " changed");
  for (const JunctionChange& c : changed) {
    offenders.add([&] {
      return labels_text(c.labels, report.voxels.size() - 1, names) + ":" +
             change_text("", c.before, c.after);
    });
  }
  std::string detail = offenders.text() + " of " + std::to_string(count);
  if (report.topology_is_indicative) detail += "; only indicative, as P2 fails";
  return {"P1 " + noun, changed.empty(), detail};
}

void judge_junctions(AuditReport& report, const LabelText& names) {
  if (!report.junctions) return;
  const JunctionReport& p = *report.junctions;
  report.checks.push_back(
      judge_junctions("interfaces", p.interfaces_changed, p.interfaces, report, names));
  report.checks.push_back(
      judge_junctions("meetings", p.meetings_changed, p.meetings, report, names));
}

Check judge_quality(const QualityReport& quality, double floor) {
  const std::string detail = "least " + number(quality.radius_ratio_min) + " (tet " +
                             std::to_string(quality.worst_tet) + "), mean " +
                             number(quality.radius_ratio_mean) + ", floor " + number(floor);
  return {"P3 radius ratio", quality.radius_ratio_min >= floor, detail};
}

std::string distance_text(const DistanceReport& distance, const LabelText& names) {
  const DistanceReport::PerLabel* farthest = distance.farthest();
  if (farthest == nullptr) return "no interface on both sides";
  return number(farthest->max()) + " voxels at most (" + label_text(farthest->label, names) + ")" +
         (distance.is_finite() ? ", mean " + number(distance.mean_voxels) : "");
}

/// Drops the labels that were left out, whole or in part.
VolumeReport only_kept(VolumeReport report, const AuditOptions& options) {
  if (options.kept.empty() && options.partial.empty()) return report;
  std::erase_if(report.per_label, [&](const VolumeRow& row) {
    return !keeps(options.kept, row.label) || is_partial(options.partial, row.label);
  });
  VolumeMeter meter;
  for (const VolumeRow& row : report.per_label) meter.add(row);
  report.summary = meter.summary();
  return report;
}

/// Sampled distances fail only when they exceed the bound by more than rounding.
Check judge_distance(const DistanceReport& distance, const AuditOptions& options) {
  constexpr double kRounding = 1e-6;
  const std::optional<double>& bound = options.max_distance;
  std::string detail = distance_text(distance, options.label_text);
  if (bound) detail += ", bound " + number(*bound);
  detail += "; " + sampling_text(distance);
  const auto name_labels = [&](const char* noun, const std::vector<Label>& labels) {
    Offenders lonely(noun);
    for (const Label label : labels)
      lonely.add([&] { return label_text(label, options.label_text); });
    if (lonely.count() > 0) detail += "; " + lonely.text();
  };
  name_labels("labels without an interface in the mesh", distance.only_in_volume);
  name_labels("labels without an interface in the volume", distance.only_in_mesh);
  const bool passed = distance.is_finite() && (!bound || distance.max_voxels <= *bound + kRounding);
  return {"P4 distance", passed, detail};
}

/// Names the label whose error is the largest share of its bound.
Check judge_volumes(const VolumeReport& volumes, double bound, const LabelText& names) {
  const auto share = [&](const VolumeRow& row) {
    return row.voxels < kMinJudgedVoxels ? -1 : std::abs(row.error) / volume_bound(row, bound);
  };
  const auto worst =
      std::max_element(volumes.per_label.begin(), volumes.per_label.end(),
                       [&](const VolumeRow& a, const VolumeRow& b) { return share(a) < share(b); });
  if (worst == volumes.per_label.end() || share(*worst) < 0) {
    return {"P8 volumes", true,
            "no label of " + std::to_string(kMinJudgedVoxels) + " voxels or more"};
  }
  const double allowed = volume_bound(*worst, bound);
  return {"P8 volumes", std::abs(worst->error) <= allowed,
          "error " + number(std::abs(worst->error)) + " of " + label_text(worst->label, names) +
              " (" + std::to_string(worst->voxels) + " voxels, " + number(worst->volume_voxels) +
              " in the mesh), bound " + number(allowed) + "; mean " +
              number(volumes.summary.error_mean_abs) + " of " +
              std::to_string(volumes.summary.labels_measured) + " labels"};
}

/// Fails every check that needs a mesh.
void refuse_all(const AuditOptions& options, std::vector<Check>& checks) {
  const auto refuse = [&](const char* name) {
    checks.push_back({name, false, "not looked at: the input is no mesh"});
  };
  refuse("P4 place");
  refuse("P1 topology");
  refuse("P1 pinches");
  if (options.count_junctions) {
    refuse("P1 interfaces");
    refuse("P1 meetings");
  }
  refuse("P3 radius ratio");
  if (options.max_distance) refuse("P4 distance");
  if (options.max_volume_error) refuse("P8 volumes");
}

}  // namespace

std::string label_text(Label label, const LabelText& names) {
  if (label == kExterior) return "exterior";
  if (label == kLeftOut) return "left out";
  if (label == kUnknown) return "unknown";
  return names ? names(label) : "dense " + std::to_string(label);
}

bool AuditReport::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const Check& c) { return c.passed; });
}

AuditReport judge(AuditFindings findings, const AuditOptions& options) {
  AuditReport report{.checks = findings.validity.checks,
                     .voxels = std::move(findings.voxels),
                     .mesh = std::move(findings.mesh),
                     .topology_is_indicative = !findings.validity.passed()};
  report.validity = std::move(findings.validity);
  if (!report.checks.front().passed) {
    refuse_all(options, report.checks);
    return report;
  }
  forget_left_out(options.kept, report);
  const auto kept = std::count(options.kept.begin(), options.kept.end(), true);
  const std::size_t looked_at =
      options.kept.empty() ? report.voxels.size() : static_cast<std::size_t>(kept);
  report.checks.push_back(std::move(findings.place));
  report.checks.push_back(compare_topology(report, looked_at, options));
  report.checks.push_back(judge_pinches(findings.pinches, options, report.pinches));
  report.junctions = std::move(findings.junctions);
  judge_junctions(report, options.label_text);
  report.quality = findings.quality;
  report.checks.push_back(judge_quality(report.quality, options.radius_ratio_floor));
  report.distance = std::move(findings.distance);
  if (report.distance && (options.max_distance || !report.distance->is_finite())) {
    report.checks.push_back(judge_distance(*report.distance, options));
  }
  report.volumes = only_kept(std::move(findings.volumes), options);
  if (options.max_volume_error) {
    report.checks.push_back(
        judge_volumes(report.volumes, *options.max_volume_error, options.label_text));
  }
  report.shape = findings.shape;
  return report;
}

}  // namespace mw::audit
