// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What hangs together in a mesh, as JSON and in words.
#include "engine/report/connect_report.h"

#include "engine/report/figures.h"
#include "engine/report/mesh_facts.h"
#include "io/file/errors.h"

namespace mw::report {
namespace {

using io::Json;

Json other_json(const engine::PartPlace& part, bool is_signed) {
  return {{"tets", part.tets},
          {"free", part.is_free},
          {"label", label_json(part.label, is_signed)},
          {"place", part.place}};
}

Json hinge_json(const engine::HingePlace& hinge, bool is_signed) {
  Json out{
      {"kind", hinge.is_edge ? "edge" : "vertex"},
      {"labels", {label_json(hinge.labels[0], is_signed), label_json(hinge.labels[1], is_signed)}},
      {"place", hinge.places[0]}};
  if (hinge.is_edge) out["end"] = hinge.places[1];
  return out;
}

}  // namespace

Json pairs_json(const std::vector<engine::LabelPair>& pairs, bool labels_signed) {
  Json out = Json::array();
  for (const auto& [one, other] : pairs) {
    out.push_back({label_json(one, labels_signed), label_json(other, labels_signed)});
  }
  return out;
}

Json connect_json(const engine::ConnectFacts& facts, bool labels_signed) {
  Json others = Json::array(), hinges = Json::array(), stiff = Json::array();
  for (const RawLabel label : facts.stiff) stiff.push_back(label_json(label, labels_signed));
  for (const engine::PartPlace& part : facts.others) {
    others.push_back(other_json(part, labels_signed));
  }
  for (const engine::HingePlace& hinge : facts.hinges) {
    hinges.push_back(hinge_json(hinge, labels_signed));
  }
  return {{"found", facts.found},
          {"written", facts.parts},
          {"hanging", facts.hanging},
          {"free", facts.free},
          {"small", {{"below_tets", engine::kSmallPartTets}, {"parts", facts.small}}},
          {"largest_tets", facts.largest_tets},
          {"others", std::move(others)},
          {"hinge_vertices", facts.hinge_vertices},
          {"hinge_edges", facts.hinge_edges},
          {"hinges", std::move(hinges)},
          {"no_vertex_inside",
           {{"labels", facts.stiff_labels}, {"of", facts.labels}, {"first", std::move(stiff)}}},
          {"doubled",
           {{"vertices", facts.doubled},
            {"copies", facts.copies},
            {"parts_after", facts.parts_after},
            {"wedges", facts.wedges},
            {"facets_without_wedge", facts.closed},
            {"facets", facts.facets},
            {"facets_that_cannot_open", facts.held},
            {"labels_that_do_not_meet", pairs_json(facts.apart, labels_signed)}}}};
}

std::string changes_text(const Json& parts) {
  std::vector<std::string> out;
  if (parts["found"].integer() != parts["written"].integer()) {
    out.push_back(told("{written} of {found} that faces join are written", parts));
  }
  const Json& doubled = parts["doubled"];
  if (doubled["copies"].integer() > 0) {
    out.push_back(
        told("{vertices} vertices doubled by {copies} copies, parts after that: "
             "{parts_after}",
             doubled));
  }
  const std::uint64_t wedges = doubled["wedges"].integer();
  const std::uint64_t closed = doubled["facets_without_wedge"].integer();
  const std::uint64_t held = doubled["facets_that_cannot_open"].integer();
  if (wedges + closed > 0) out.push_back(io::text(wedges, " cohesive wedges"));
  if (closed > 0) out.push_back(io::text("none on ", closed, " facets that cannot open"));
  if (held > closed) {
    const std::uint64_t all = doubled["facets"].integer() - wedges - closed;
    out.push_back(io::text(held - closed, " of ", all, " facets of --split cannot open"));
  }
  return joined(out, ", ");
}

std::string connect_text(const engine::ConnectFacts& facts) {
  std::vector<std::string> out;
  if (facts.parts > 1) {
    out.push_back(io::text(facts.parts, " parts that faces join"));
    out.push_back(io::text(facts.hanging, " hang on vertices or edges"));
    out.push_back(io::text(facts.free, " are free"));
  }
  const std::string changes = changes_text(connect_json(facts, false));
  if (!changes.empty()) out.push_back(changes);
  return joined(out, ", ");
}

std::string pairs_text(const std::vector<engine::LabelPair>& pairs, bool labels_signed) {
  std::string out;
  for (const auto& [one, other] : pairs) {
    out += (out.empty() ? "" : ", ") + label_text(one, labels_signed, {}) + "|" +
           label_text(other, labels_signed, {});
  }
  return out;
}

}  // namespace mw::report
