// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A folder of neuroglancer's precomputed meshes.
#include "io/surface/precomputed/mesh_folder.h"

#include <limits>

#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
#include "io/json/json.h"
#include "io/surface/precomputed/draco_sink.h"
#include "io/surface/surface_sink.h"

namespace mw::io {
namespace {

constexpr const char* kProperties = "segment_properties";

void write_json(const std::filesystem::path& path, const Json& json) {
  AtomicFile file(path);
  file.append(json.dump() + "\n");
  file.commit();
}

Json info_json(FragmentKind kind) {
  if (kind == FragmentKind::kLegacy) return {{"@type", "neuroglancer_legacy_mesh"}};
  return {{"@type", "neuroglancer_multilod_draco"},
          {"vertex_quantization_bits", kDracoBits},
          {"transform", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}},
          {"lod_scale_multiplier", 1}};
}

/// Segments without a name have their number, which the viewer shows for them.
Json properties_json(const std::vector<RawLabel>& segments, const LabelNames& names) {
  Json ids = Json::array();
  Json values = Json::array();
  for (const RawLabel segment : segments) {
    if (names.name(segment).empty()) continue;
    ids.push_back(text(segment));
    values.push_back(names.name(segment));
  }
  if (ids.empty()) return nullptr;
  const Json property{{"id", "label"}, {"type", "label"}, {"values", values}};
  return {{"@type", "neuroglancer_segment_properties"},
          {"inline", {{"ids", ids}, {"properties", Json::Array{property}}}}};
}

}  // namespace

LegacySink::LegacySink(const std::filesystem::path& segment, double nm_per_unit)
    : segment_(segment),
      fragment_(segment.string() + ".mesh"),
      file_(fragment_),
      nm_per_unit_(nm_per_unit) {}

void LegacySink::begin(const SurfaceHeader& header) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
  check_max(segment_.string(), "vertices", header.vertices(), kMax);
  append_little(file_, static_cast<std::uint32_t>(header.vertices()));
}

void LegacySink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) append_little(file_, static_cast<float>(x * nm_per_unit_));
  }
}

void LegacySink::write_triangles(std::span<const Triangle> triangles) {
  for (const Triangle& triangle : triangles) {
    for (const std::uint64_t vertex : triangle) {
      append_little(file_, static_cast<std::uint32_t>(vertex));
    }
  }
}

void LegacySink::finish() {
  file_.commit();
  AtomicFile manifest(segment_.string() + ":0");
  manifest.append("{\"fragments\":[\"" + fragment_.filename().string() + "\"]}\n");
  manifest.commit();
}

std::unique_ptr<SurfaceSink> MeshFolder::sink(RawLabel label) {
  segments_.push_back(label);
  const std::filesystem::path path = folder_.path() / text(label);
  if (options_.kind == FragmentKind::kLegacy) {
    return std::make_unique<LegacySink>(path, options_.nm_per_unit);
  }
  return std::make_unique<DracoSink>(path, options_.nm_per_unit);
}

void MeshFolder::finish(const LabelNames& names) {
  Json info = info_json(options_.kind);
  const Json properties = properties_json(segments_, names);
  if (!properties.is_null()) {
    info[kProperties] = kProperties;
    std::filesystem::create_directory(folder_.path() / kProperties);
    write_json(folder_.path() / kProperties / "info", properties);
  }
  write_json(folder_.path() / "info", info);
  folder_.commit();
}

}  // namespace mw::io
