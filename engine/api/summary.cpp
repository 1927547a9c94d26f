// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh in words, from its report or from what can be measured on it.
#include "engine/report/summary.h"

#include <map>

#include "engine/api/asked.h"
#include "engine/api/errors.h"
#include "engine/report/mesh_facts.h"
#include "engine/report/run_report.h"
#include "io/file/errors.h"
#include "kernels/audit/shape/quality.h"

namespace mw::api {
namespace {

using io::Json;

Json quality_of(const io::MeshData& mesh) {
  if (mesh.tets.empty()) return nullptr;
  audit::QualityMeter meter;
  for (const io::TetRows& tet : mesh.tets) {
    const auto at = [&](std::size_t i) { return mesh.vertices[tet[i]]; };
    meter.add(at(0), at(1), at(2), at(3));
  }
  return report::quality_json(meter.report());
}

Json labels_of(const io::MeshData& mesh) {
  std::map<RawLabel, std::uint64_t> tets;
  for (const RawLabel label : mesh.labels) ++tets[label];
  Json first = Json::array(), fewest;
  std::uint64_t least = 0;
  for (const auto& [label, count] : tets) {
    Json row = report::named_row_json(label, mesh.labels_signed, mesh.names);
    row["tets"] = count;
    if (least == 0 || count < least) {
      least = count;
      fewest = row;
    }
    if (first.elements().size() < report::kMostFirstLabels) first.push_back(std::move(row));
  }
  return {{"written", tets.size()},
          {"of", tets.size()},
          {"zero_is_nothing", false},
          {"first", std::move(first)},
          {"fewest_tets", std::move(fewest)}};
}

/// Returns the keys of a report that a mesh alone can tell; the others are null.
Json facts_of(const io::MeshData& mesh) {
  const io::MeshRecord& record = mesh.record;
  Json out{{"input",
            {{"frame", io::name(record.frame)},
             {"unit", record.unit.empty() ? Json() : Json(record.unit)},
             {"axes_xyz", nullptr}}},
           {"output",
            {{"file", nullptr}, {"vertices", mesh.vertices.size()}, {"tets", mesh.tets.size()}}},
           {"labels", labels_of(mesh)},
           {"quality", quality_of(mesh)}};
  for (const char* key : {"shape", "parts", "specks", "interpolated", "welds", "size", "samples",
                          "certificate", "performance", "attention", "suggestion"}) {
    out[key] = nullptr;
  }
  return out;
}

std::string text_of_facts(const Json& facts) {
  try {
    return report::summary_text(facts) + report::attention_text(facts);
  } catch (const std::exception&) {  // of a key that is missing, or of another type
    io::fail_input("report", {}, "is not that of a run of this version",
                   "give the text that the mesh has");
  }
}

}  // namespace
}  // namespace mw::api

namespace api = mw::api;

char* mw_mesh_summary(const mw_mesh* mesh, const char* report, mw_error** error) {
  return api::made(error, [&] {
    api::require(mesh, "mesh");
    const bool has_report = report != nullptr && *report != '\0';
    const mw::io::Json facts =
        has_report ? mw::io::parse_json(report, "report") : api::facts_of(mesh->data);
    return api::text_of(api::in_words(api::text_of_facts(facts)));
  });
}
