// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a mesh file tells of the run that made it, as a line of JSON.
#include "io/mesh/mesh_record.h"

#include "io/json/json.h"
#include "io/json/json_fields.h"

namespace mw::io {
namespace {

constexpr const char* kInterfaces = "interfaces";
constexpr const char* kSmooth = "smooth";
constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

Json box_json(const MeshBox& box) {
  return {{"origin", box.origin},
          {kAxes[0], box.edges[0]},
          {kAxes[1], box.edges[1]},
          {kAxes[2], box.edges[2]}};
}

Json promises_json(const MeshPromises& promises) {
  return {{"max_distance", promises.max_distance ? Json(*promises.max_distance) : Json()},
          {"quality_floor", promises.quality_floor},
          {"topology", promises.interfaces ? kInterfaces : "labels"},
          {"surface", promises.smooth ? kSmooth : "voxel"}};
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

MeshPromises promises_in(const JsonFields& fields) {
  MeshPromises out;
  if (fields.has("max_distance")) out.max_distance = number_in(fields, "max_distance");
  out.quality_floor = number_in(fields, "quality_floor");
  out.interfaces = fields.text("topology") == kInterfaces;
  out.smooth = fields.text("surface") == kSmooth;
  return out;
}

}  // namespace

std::string record_text(const MeshRecord& record) {
  Json out = Json::object();
  if (record.box) out["box"] = box_json(*record.box);
  if (record.promises) out["promises"] = promises_json(*record.promises);
  return out.empty() ? std::string() : out.dump();
}

MeshRecord parse_record(std::string_view text, std::string_view file) {
  MeshRecord record;
  if (text.empty()) return record;
  const Json value = parse_json(text, file);
  const JsonFields fields(value, std::string(file), kRecordName);
  if (fields.has("box")) record.box = box_in(fields.object("box"));
  if (fields.has("promises")) record.promises = promises_in(fields.object("promises"));
  return record;
}

}  // namespace mw::io
