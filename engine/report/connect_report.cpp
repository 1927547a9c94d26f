// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What hangs together in a mesh, as JSON and in words.
#include "engine/report/connect_report.h"

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

std::string connect_text(const engine::ConnectFacts& facts) {
  std::string out;
  const auto add = [&](const std::string& words) { out += (out.empty() ? "" : ", ") + words; };
  if (facts.found != facts.parts) {
    add(io::text(facts.parts, " of ", facts.found, " that faces join are written"));
  } else if (facts.parts > 1) {
    add(io::text(facts.parts, " joined by faces"));
  }
  if (facts.parts > 1) {
    add(io::text(facts.hanging, " hang on vertices or edges"));
    add(io::text(facts.free, " are free"));
    add(io::text(facts.small, " have fewer than ", engine::kSmallPartTets, " tets"));
  }
  if (facts.hinge_vertices + facts.hinge_edges > 0) {
    add(io::text("hinges: ", facts.hinge_vertices, " vertices, ", facts.hinge_edges, " edges"));
  }
  if (facts.hanging > 0 || facts.hinge_vertices + facts.hinge_edges > 0) {
    add("see --weld, --topology interfaces and --open-hinges");
  }
  if (facts.copies > 0) {
    add(io::text(facts.doubled, " vertices doubled by ", facts.copies,
                 " copies, parts after that: ", facts.parts_after));
  }
  if (facts.wedges + facts.closed > 0) {
    add(io::text(facts.wedges, " cohesive wedges"));
    if (facts.closed > 0) add(io::text("none on ", facts.closed, " facets that cannot open"));
  }
  if (facts.held > facts.closed) {
    const std::uint64_t all = facts.facets - facts.wedges - facts.closed;
    add(io::text(facts.held - facts.closed, " of ", all, " facets of --split cannot open"));
  }
  return out;
}

std::string pairs_text(const std::vector<engine::LabelPair>& pairs, bool labels_signed) {
  std::string out;
  for (const auto& [one, other] : pairs) {
    out += (out.empty() ? "" : ", ") + label_text(one, labels_signed, {}) + "|" +
           label_text(other, labels_signed, {});
  }
  return out;
}

std::string stiff_text(const engine::ConnectFacts& facts) {
  if (facts.stiff_labels == 0) return "";
  return io::text(facts.stiff_labels, " of ", facts.labels,
                  " labels have no vertex inside and are too stiff when they bend: see --across");
}

}  // namespace mw::report
