// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a mesh file tells of the run that made it, as a line of JSON.
#include "io/mesh/mesh_record.h"

#include <algorithm>
#include <set>

#include "io/file/errors.h"
#include "io/json/json.h"
#include "io/json/json_fields.h"
#include "io/names/label_names.h"
#include "kernels/core/sort_distinct.h"

namespace mw::io {
namespace {

constexpr const char* kInterfaces = "interfaces";
constexpr const char* kLabels = "labels";
constexpr const char* kSmooth = "smooth";
constexpr const char* kVoxel = "voxel";
constexpr const char* kNone = "none";
constexpr const char* kFrame = "frame";
constexpr const char* kUnit = "unit";
constexpr const char* kOnly = "only_labels";
constexpr const char* kWithout = "without_labels";
constexpr const char* kPartial = "partial_labels";
constexpr const char* kDoubled = "doubled_vertices";
constexpr const char* kCurved = "curved";
constexpr const char* kCohesiveKey = "cohesive";
constexpr const char* kPeriodic = "periodic";
constexpr const char* kHalvings = "halvings";
constexpr const char* kMasks = "masks";
constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

Json box_json(const MeshBox& box) {
  return {{"origin", box.origin},
          {kAxes[0], box.edges[0]},
          {kAxes[1], box.edges[1]},
          {kAxes[2], box.edges[2]}};
}

std::string axes_text(unsigned axes) {
  std::string out;
  for (std::size_t k = 0; k < 3; ++k) {
    if ((axes >> k & 1U) != 0) out += kAxes[k];
  }
  return out;
}

unsigned axes_in(const JsonFields& fields, const char* key) {
  for (unsigned axes = 1; axes < 8; ++axes) {
    if (fields.text(key) == axes_text(axes)) return axes;
  }
  fields.fail(key, text("is \"", fields.text(key), "\""));
}

Json promises_json(const MeshPromises& promises) {
  Json out{{"max_distance", promises.max_distance ? Json(*promises.max_distance) : Json()},
           {"quality_floor", promises.quality_floor},
           {"topology", promises.interfaces ? kInterfaces : kLabels},
           {"surface", promises.smooth ? kSmooth : kVoxel}};
  if (!promises.optimised) out["optimizer"] = kNone;
  if (promises.periodic != 0) out[kPeriodic] = axes_text(promises.periodic);
  if (promises.halvings != 0) out[kHalvings] = promises.halvings;
  return out;
}

MeshBox box_in(const JsonFields& fields) {
  MeshBox box{.origin = fields.numbers3("origin")};
  for (std::size_t i = 0; i < 3; ++i) {
    const Position e = fields.numbers3(kAxes[i]);
    const double square = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
    if (!(square > 0)) fields.fail(kAxes[i], "has no length");
    box.edges[i] = e;
  }
  return box;
}

double number_in(const JsonFields& fields, const char* key) {
  const double number = fields.number(key);
  if (!(number >= 0)) fields.fail(key, "is negative");
  return number;
}

/// Returns whether the text is the first word.  ERRORS: kInput when it is neither word.
bool word_in(const JsonFields& fields, const char* key, std::string_view first,
             std::string_view second) {
  const std::string word = fields.text(key);
  if (word != first && word != second) fields.fail(key, text("is \"", word, "\""));
  return word == first;
}

std::string unit_in(const JsonFields& fields) {
  std::string unit = fields.text(kUnit);
  if (!nm_in(unit)) fields.fail(kUnit, text("is \"", unit, "\""));
  return unit;
}

int halvings_in(const JsonFields& fields) {
  const std::int64_t times = fields.integer(kHalvings);
  if (times < 1 || times > kMostHalvings) {
    fields.fail(kHalvings, text("is ", times, ", not from 1 to ", kMostHalvings));
  }
  return static_cast<int>(times);
}

MeshPromises promises_in(const JsonFields& fields) {
  MeshPromises out;
  if (fields.has("max_distance")) out.max_distance = number_in(fields, "max_distance");
  out.quality_floor = number_in(fields, "quality_floor");
  out.interfaces = word_in(fields, "topology", kInterfaces, kLabels);
  out.smooth = word_in(fields, "surface", kSmooth, kVoxel);
  out.optimised = !fields.has("optimizer") || !word_in(fields, "optimizer", kNone, kNone);
  if (fields.has(kPeriodic)) out.periodic = axes_in(fields, kPeriodic);
  if (fields.has(kHalvings)) out.halvings = halvings_in(fields);
  return out;
}

void add_labels(const std::vector<RawLabel>& labels, const char* key, Json& out) {
  if (labels.empty()) return;
  out[key] = Json::array();
  for (const RawLabel label : labels) out[key].push_back(static_cast<std::int64_t>(label));
}

std::vector<RawLabel> labels_in(const JsonFields& fields, const char* key) {
  if (!fields.has(key)) return {};
  const std::vector<std::int64_t> numbers = fields.integers(key);
  return {numbers.begin(), numbers.end()};
}

Json cohesive_json(const CohesiveRule& rule) {
  if (rule.all) return true;
  Json out = Json::array();
  for (const auto& pair : rule.pairs) {
    for (const RawLabel label : pair) out.push_back(static_cast<std::int64_t>(label));
  }
  return out;
}

CohesiveRule cohesive_in(const JsonFields& fields) {
  CohesiveRule out;
  if (!fields.has(kCohesiveKey)) return out;
  if (!fields.is_array(kCohesiveKey)) {
    out.all = fields.flag(kCohesiveKey);
    return out;
  }
  const std::vector<RawLabel> labels = labels_in(fields, kCohesiveKey);
  if (labels.size() % 2 != 0) fields.fail(kCohesiveKey, "has a label without another one");
  for (std::size_t i = 0; i < labels.size(); i += 2) {
    if (out.has(labels[i], labels[i + 1])) fields.fail(kCohesiveKey, "has a pair twice");
    out.pairs.push_back({labels[i], labels[i + 1]});
  }
  return out;
}

Json masks_json(const std::vector<MaskLabels>& masks) {
  Json out = Json::array();
  for (const MaskLabels& mask : masks) {
    Json row{{"name", mask.name}};
    add_labels(mask.labels, "labels", row);
    out.push_back(std::move(row));
  }
  return out;
}

std::vector<MaskLabels> masks_in(const JsonFields& fields) {
  std::vector<MaskLabels> out;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < fields.count(kMasks); ++i) {
    const JsonFields row = fields.element(kMasks, i);
    MaskLabels mask{.name = row.text("name"), .labels = labels_in(row, "labels")};
    sort_distinct(mask.labels);
    if (mask.labels.empty()) row.fail("labels", "has no label");
    if (mask.name.empty() || mask.name != clean_name(mask.name) ||
        !taken.insert(mask.name).second) {
      row.fail("name", "is no name of a mask, or is there twice");
    }
    out.push_back(std::move(mask));
  }
  return out;
}

}  // namespace

bool CohesiveRule::has(RawLabel one, RawLabel other) const {
  return one != other && (all || names(one, other) || names(other, one));
}

bool CohesiveRule::names(RawLabel one, RawLabel other) const {
  return std::find(pairs.begin(), pairs.end(), std::array<RawLabel, 2>{one, other}) != pairs.end();
}

std::string record_text(const MeshRecord& record) {
  Json out = Json::object();
  if (record.box) out["box"] = box_json(*record.box);
  if (record.promises) out["promises"] = promises_json(*record.promises);
  if (record.frame != WorldFrame::kOwn) out[kFrame] = name(record.frame);
  if (!record.unit.empty()) out[kUnit] = record.unit;
  add_labels(record.only_labels, kOnly, out);
  add_labels(record.without_labels, kWithout, out);
  add_labels(record.partial_labels, kPartial, out);
  if (record.has_doubles) out[kDoubled] = true;
  if (record.curved) out[kCurved] = true;
  if (record.cohesive.any()) out[kCohesiveKey] = cohesive_json(record.cohesive);
  if (!record.masks.empty()) out[kMasks] = masks_json(record.masks);
  return out.empty() ? std::string() : out.dump_ascii();
}

MeshRecord parse_record(std::string_view text, std::string_view file) {
  MeshRecord record;
  if (text.empty()) return record;
  const Json value = parse_json(text, file);
  const JsonFields fields(value, std::string(file), kRecordName);
  if (fields.has("box")) record.box = box_in(fields.object("box"));
  if (fields.has("promises")) record.promises = promises_in(fields.object("promises"));
  if (fields.has(kFrame)) {
    record.frame = word_in(fields, kFrame, name(WorldFrame::kRas), name(WorldFrame::kLps))
                       ? WorldFrame::kRas
                       : WorldFrame::kLps;
  }
  if (fields.has(kUnit)) record.unit = unit_in(fields);
  record.only_labels = labels_in(fields, kOnly);
  record.without_labels = labels_in(fields, kWithout);
  record.partial_labels = labels_in(fields, kPartial);
  record.has_doubles = fields.has(kDoubled) && fields.flag(kDoubled);
  record.curved = fields.has(kCurved) && fields.flag(kCurved);
  record.cohesive = cohesive_in(fields);
  if (fields.has(kMasks)) record.masks = masks_in(fields);
  if (!record.only_labels.empty() && !record.without_labels.empty()) {
    fields.fail(kWithout, "contradicts only_labels");
  }
  return record;
}

}  // namespace mw::io
