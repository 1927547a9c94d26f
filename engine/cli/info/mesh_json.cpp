// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// `mwmesh info --json` of a mesh.
#include "engine/cli/info/mesh_info.h"

#include <algorithm>

#include "engine/report/connect_report.h"
#include "engine/report/mesh_facts.h"

namespace mw::cli {
namespace {

using io::Json;

/// Returns the label's row of the volume; empty without a volume, or if it lacks that label.
std::optional<audit::VolumeRow> voxels_of(const MeshInfo& facts, Label rank) {
  if (!facts.volume) return std::nullopt;
  const auto found = facts.volume->voxels.find(facts.table.raw(rank));
  if (found == facts.volume->voxels.end()) return std::nullopt;
  const auto voxels = static_cast<double>(found->second);
  const double in_mesh = facts.mesh.labels[rank].volume / facts.volume->voxel_volume;
  return audit::VolumeRow{rank, found->second, in_mesh, (in_mesh - voxels) / voxels};
}

void add_betti(Json& row, const audit::RegionBetti& betti) {
  row["components"] = betti.open.b0;
  row["betti_closed"] = report::betti_json(betti.closed);
  row["betti_open"] = report::betti_json(betti.open);
}

Json label_row(const MeshInfo& facts, Label rank, double total) {
  const LabelStats& label = facts.mesh.labels[rank];
  const RawLabel raw = facts.table.raw(rank);
  Json row = report::named_row_json(raw, facts.table.is_signed(), facts.names);
  row["volume"] = label.volume;
  row["share"] = label.volume / total;
  if (const auto voxels = voxels_of(facts, rank)) {
    row.update(report::volume_row_json(*voxels, facts.table, facts.names));
  } else if (facts.volume) {
    row["voxels"] = 0;
  }
  row["area"] = label.area;
  row["area_on_box"] = label.area_on_box;
  row["tets"] = label.tets;
  if (label.betti) add_betti(row, *label.betti);
  row["radius_ratio_min"] = label.radius_ratio_min;
  row["radius_ratio_mean"] = label.radius_ratio_mean;
  row["lo"] = label.lo;
  row["hi"] = label.hi;
  row["centroid"] = label.centroid;
  report::add_colour(row, raw, facts.names);
  return row;
}

Json mask_row(const MeshInfo& facts, const MaskStats& mask) {
  Json labels = Json::array();
  for (const Label rank : mask.mask.ranks) {
    labels.push_back(report::label_json(facts.table.raw(rank), facts.table.is_signed()));
  }
  Json row{{"name", mask.mask.name},
           {"labels", std::move(labels)},
           {"volume", mask.volume},
           {"tets", mask.tets}};
  if (mask.betti) add_betti(row, *mask.betti);
  return row;
}

/// Returns the contacts of the mesh, then those between its labels that only the voxels have.
Json contacts_json(const MeshInfo& facts) {
  Json rows = Json::array();
  const auto add = [&](RawLabel first, RawLabel second, const ContactStats& c, double voxel_area) {
    const bool is_signed = facts.table.is_signed();
    Json row{
        {"labels", {report::label_json(first, is_signed), report::label_json(second, is_signed)}},
        {"triangles", c.triangles},
        {"area", c.area}};
    if (facts.volume) row["voxel_area"] = voxel_area;
    rows.push_back(std::move(row));
  };
  auto unmet = facts.volume ? facts.volume->areas : decltype(facts.volume->areas)();
  for (const ContactStats& c : facts.mesh.contacts) {
    const RawLabel first = facts.table.raw(c.first), second = facts.table.raw(c.second);
    const auto found = unmet.extract(std::minmax(first, second));
    add(first, second, c, found.empty() ? 0 : found.mapped());
  }
  for (const auto& [pair, area] : unmet) {
    const bool in_mesh = facts.table.contains(pair.first) && facts.table.contains(pair.second);
    if (in_mesh) add(pair.first, pair.second, {}, area);
  }
  return rows;
}

Json labels_json(const io::LabelTable& table) {
  if (table.size() == 0) return {{"count", 0}, {"min", nullptr}, {"max", nullptr}};
  const auto last = static_cast<Label>(table.size() - 1);
  return {{"count", table.size()},
          {"min", report::label_json(table.raw(0), table.is_signed())},
          {"max", report::label_json(table.raw(last), table.is_signed())}};
}

Json box_json(const MeshStats& mesh) {
  if (mesh.labels.empty()) return nullptr;
  io::Position lo = mesh.labels.front().lo, hi = mesh.labels.front().hi;
  for (const LabelStats& label : mesh.labels) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], label.lo[k]);
      hi[k] = std::max(hi[k], label.hi[k]);
    }
  }
  return {{"lo", lo}, {"hi", hi}};
}

/// Returns the volumes of labels, and their errors if there is a volume to compare them with.
Json volumes_json(const MeshInfo& facts) {
  audit::CompensatedSum total;
  audit::VolumeMeter errors;
  for (Label rank = 0; rank < facts.table.size(); ++rank) {
    total.add(facts.mesh.labels[rank].volume);
    if (const auto voxels = voxels_of(facts, rank)) errors.add(*voxels);
  }
  Json out{{"total", total.value()}};
  if (facts.volume) out.update(report::volume_summary_json(errors.summary(), facts.table));
  Json rows = Json::array();
  for (Label rank = 0; rank < facts.table.size(); ++rank) {
    rows.push_back(label_row(facts, rank, total.value()));
  }
  out["per_label"] = std::move(rows);
  return out;
}

/// Returns the pairs of labels from which to which wedges go, or "*" for all.
Json cohesive_json(const MeshInfo& facts) {
  if (facts.cohesive.all) return "*";
  Json out = Json::array();
  for (const auto& [bottom, top] : facts.cohesive.pairs) {
    out.push_back({report::label_json(bottom, facts.table.is_signed()),
                   report::label_json(top, facts.table.is_signed())});
  }
  return out;
}

/// Leaves out what tells how a run changed the mesh, which is not known of a file.
Json parts_json(const MeshInfo& facts) {
  Json out = report::connect_json(facts.parts, facts.table.is_signed());
  for (const char* key : {"found", "doubled"}) out.erase(key);
  return out;
}

}  // namespace

Json mesh_json(const MeshInfo& facts, bool contacts) {
  Json out{{"kind", "mesh"},
           {"file", facts.file},
           {"vertices", facts.vertices},
           {"tets", facts.tets},
           {"doubled_vertices", facts.doubled},
           {"labels", labels_json(facts.table)},
           {"box", box_json(facts.mesh)},
           {"parts", parts_json(facts)},
           {"shape", report::interfaces_json(facts.shape)},
           {"volume", volumes_json(facts)}};
  if (facts.curved > 0) out["curved_tets"] = facts.curved;
  if (facts.cohesive.any()) out["cohesive"] = cohesive_json(facts);
  for (const MaskStats& mask : facts.mesh.masks) out["masks"].push_back(mask_row(facts, mask));
  if (contacts) out["contacts"] = contacts_json(facts);
  out["digest"] = facts.digest;
  return out;
}

}  // namespace mw::cli
