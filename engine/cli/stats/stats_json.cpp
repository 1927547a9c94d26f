// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// `mwmesh stats --json`.
#include "engine/cli/stats/stats_json.h"

#include "engine/cli/report_names.h"

namespace mw::cli {
namespace {

using io::Json;

Json betti_json(const audit::Betti& betti) {
  return {betti.b0, betti.b1, betti.b2};
}

Json label_json(const StatsFacts& facts, Label rank) {
  const LabelStats& label = facts.mesh.labels[rank];
  const RawLabel raw = facts.table.raw(rank);
  Json row = named_row_json(raw, facts.table.is_signed(), facts.names);
  row["volume"] = label.volume;
  if (facts.volume) {
    const auto voxels = voxels_of(facts, rank);
    row["voxels"] = voxels ? Json(voxels->voxels) : Json(0);
    row["volume_error"] = voxels ? Json(voxels->error) : Json();
  }
  row["area"] = label.area;
  row["area_on_box"] = label.area_on_box;
  row["tets"] = label.tets;
  if (label.betti) {
    row["components"] = label.betti->open.b0;
    row["betti_closed"] = betti_json(label.betti->closed);
    row["betti_open"] = betti_json(label.betti->open);
  }
  row["radius_ratio_min"] = label.radius_ratio_min;
  row["radius_ratio_mean"] = label.radius_ratio_mean;
  row["lo"] = label.lo;
  row["hi"] = label.hi;
  row["centroid"] = label.centroid;
  add_colour(row, raw, facts.names);
  return row;
}

Json contact_json(const StatsFacts& facts, const Contact& contact) {
  const bool is_signed = facts.table.is_signed();
  Json row{
      {"labels",
       {cli::label_json(contact.first, is_signed), cli::label_json(contact.second, is_signed)}},
      {"triangles", contact.triangles},
      {"area", contact.area}};
  if (contact.voxel_area) row["voxel_area"] = *contact.voxel_area;
  return row;
}

}  // namespace

Json stats_json(const StatsFacts& facts) {
  Json labels = Json::array();
  for (Label rank = 0; rank < facts.table.size(); ++rank) labels.push_back(label_json(facts, rank));
  Json contacts = Json::array();
  for (const Contact& c : contacts_of(facts)) contacts.push_back(contact_json(facts, c));
  return {{"labels", std::move(labels)}, {"contacts", std::move(contacts)}};
}

}  // namespace mw::cli
