// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A folder of neuroglancer's precomputed meshes.
#include "io/surface/precomputed/mesh_folder.h"

#include <cmath>
#include <limits>
#include <set>

#include "io/file/errors.h"
#include "io/json/json.h"
#include "io/surface/precomputed/draco_sink.h"
#include "io/surface/precomputed/octree_cells.h"
#include "kernels/core/vector3.h"

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

Json label_property(const std::vector<RawLabel>& segments, const LabelNames& names) {
  Json values = Json::array();
  for (const RawLabel segment : segments) {
    const std::string& name = names.name(segment);
    values.push_back(name.empty() ? text(segment) : name);
  }
  return {{"id", "label"}, {"type", "label"}, {"values", values}};
}

Json number_property(const char* id, const std::string& about, const char* type, Json values) {
  return {{"id", id},
          {"type", "number"},
          {"description", about},
          {"data_type", type},
          {"values", std::move(values)}};
}

Json properties_json(const std::vector<RawLabel>& segments,
                     const std::deque<SegmentFigures>& figures, const LabelNames& names,
                     const std::string& unit) {
  Json ids = Json::array(), volumes = Json::array(), areas = Json::array(),
       neighbours = Json::array();
  for (const RawLabel segment : segments) ids.push_back(text(segment));
  for (const SegmentFigures& f : figures) {
    if (f.volume) volumes.push_back(*f.volume);
    areas.push_back(f.area);
    neighbours.push_back(f.neighbours);
  }
  Json properties = Json::array();
  properties.push_back(label_property(segments, names));
  if (figures.front().volume) {
    properties.push_back(number_property("volume", "volume in " + unit + "^3", "float32", volumes));
  }
  properties.push_back(number_property("area", "area in " + unit + "^2", "float32", areas));
  properties.push_back(
      number_property("neighbours", "labels that it touches", "uint32", neighbours));
  return {{"@type", "neuroglancer_segment_properties"},
          {"inline", {{"ids", ids}, {"properties", properties}}}};
}

/// Returns the low and high corner, in nm, of the box around all segments.  The format has no such
/// member, but a viewer of the whole folder has to know where it is.
Json box_json(const std::deque<SegmentFigures>& figures, double nm_per_unit) {
  SegmentBox box = figures.front().box.value_or(SegmentBox{});
  for (const SegmentFigures& f : figures) {
    if (!f.box) continue;
    box.add(f.box->low);
    box.add(f.box->high);
  }
  Json low = Json::array(), high = Json::array();
  for (std::size_t k = 0; k < 3; ++k) {
    low.push_back(box.low[k] * nm_per_unit);
    high.push_back(box.high[k] * nm_per_unit);
  }
  return Json::Array{low, high};
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
  check_floats(segment_.string(), header, nm_per_unit_, "give --format draco");
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

void MeshFolder::use_unit(const std::string& unit) {
  unit_ = unit;
  nm_per_unit_ = nm_in(unit).value();
}

std::unique_ptr<SurfaceSink> MeshFolder::sink(RawLabel label) {
  segments_.push_back(label);
  std::unique_ptr<SurfaceSink> sink;
  if (options_.kind == FragmentKind::kLegacy) {
    sink = std::make_unique<LegacySink>(folder_.path() / text(label), nm_per_unit_);
  } else {
    sink = std::make_unique<DracoSink>(draco_, label, nm_per_unit_);
  }
  return std::make_unique<MeasuredSink>(std::move(sink), folder_.path(), options_.closed,
                                        figures_.emplace_back());
}

void MeshFolder::finish(const LabelNames& names) {
  Json info = info_json(options_.kind);
  if (Json sharding = draco_.finish(options_.most_single); !sharding.is_null()) {
    info["sharding"] = std::move(sharding);
  }
  if (!segments_.empty()) {
    info[kProperties] = kProperties;
    info["mwmesh_box"] = box_json(figures_, nm_per_unit_);
    std::filesystem::create_directory(folder_.path() / kProperties);
    write_json(folder_.path() / kProperties / "info",
               properties_json(segments_, figures_, names, unit_));
  }
  write_json(folder_.path() / "info", info);
  folder_.commit();
}

namespace {

std::uint32_t neighbours_of(const SurfaceHeader& header) {
  std::set<Label> out;
  for (const SurfaceShell& shell : header.shells) {
    for (const SurfaceRun& run : shell.runs) {
      if (run.side == Side::kInterface) out.insert(run.outside);
    }
  }
  out.erase(kExterior);
  return static_cast<std::uint32_t>(out.size());
}

}  // namespace

void MeasuredSink::begin(const SurfaceHeader& header) {
  figures_.neighbours = neighbours_of(header);
  sink_->begin(header);
}

void MeasuredSink::write_vertices(std::span<const Position> positions) {
  if (vertices_.size() == 0 && !positions.empty()) first_ = positions.front();
  for (const Position& position : positions) {
    vertices_.append(position);
    if (!figures_.box) figures_.box = SegmentBox{position, position};
    figures_.box->add(position);
  }
  sink_->write_vertices(positions);
}

void MeasuredSink::write_triangles(std::span<const Triangle> triangles) {
  for (const Triangle& t : triangles) {
    const Position a = minus(vertices_[t[0]], first_);
    const Position b = minus(vertices_[t[1]], first_);
    const Position c = minus(vertices_[t[2]], first_);
    figures_.area += norm(cross(minus(b, a), minus(c, a))) / 2;
    volume6_ += determinant(a, b, c);
  }
  sink_->write_triangles(triangles);
}

void MeasuredSink::finish() {
  if (closed_) figures_.volume = std::abs(volume6_) / 6;
  sink_->finish();
}

}  // namespace mw::io
