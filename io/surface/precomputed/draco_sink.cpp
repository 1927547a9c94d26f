// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One segment of neuroglancer's multi-resolution meshes.
#include "io/surface/precomputed/draco_sink.h"

#include <draco/compression/encode.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/file/errors.h"
#include "io/surface/surface_sink.h"

namespace mw::io {
namespace {

constexpr std::int32_t kMaxStep = (1 << kDracoBits) - 1;

/// Levels of detail at most, and how few triangles need no coarser one.
constexpr int kMostLevels = 8;
constexpr std::size_t kFewTriangles = 200;

/// Around all vertices; no side has the length 0, by which readers would divide.
FloatBox box_of(const std::vector<Position>& vertices) {
  FloatBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [lo, hi] =
        std::minmax_element(vertices.begin(), vertices.end(),
                            [k](const Position& a, const Position& b) { return a[k] < b[k]; });
    box.origin[k] = static_cast<float>((*lo)[k]);
    const float length = static_cast<float>((*hi)[k] - static_cast<double>(box.origin[k]));
    box.shape[k] = length > 0 ? length : 1;
  }
  return box;
}

/// A level's box is twice as large as that of the level before it.  Rounded so that nothing of a
/// coarse level lies beyond the half of its box, where readers cut it.
std::array<std::int32_t, 3> steps_of(const Position& p, const FloatBox& box, int level) {
  const int most = kMaxStep >> level;
  const double whole = std::ldexp(kMaxStep, -level);
  std::array<std::int32_t, 3> steps{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = (p[k] - static_cast<double>(box.origin[k])) / box.shape[k];
    const double step = std::round(std::clamp(share, 0.0, 1.0) * whole);
    steps[k] = std::min(static_cast<std::int32_t>(step), most);
  }
  return steps;
}

void add_positions(const std::vector<Position>& vertices, const FloatBox& box, int level,
                   draco::Mesh& mesh) {
  const auto count = static_cast<std::uint32_t>(vertices.size());
  mesh.set_num_points(count);
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_INT32, false,
                 3 * sizeof(std::int32_t), 0);
  const int id = mesh.AddAttribute(attribute, true, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::array<std::int32_t, 3> steps = steps_of(vertices[i], box, level);
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), steps.data());
  }
}

void add_faces(const std::vector<Triangle>& triangles, draco::Mesh& mesh) {
  mesh.SetNumFaces(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    draco::Mesh::Face face;
    for (std::size_t i = 0; i < 3; ++i) {
      face[i] = draco::PointIndex(static_cast<std::uint32_t>(triangles[t][i]));
    }
    mesh.SetFace(draco::FaceIndex(static_cast<std::uint32_t>(t)), face);
  }
}

void append_floats(AtomicFile& file, const std::array<float, 3>& numbers) {
  for (const float number : numbers) append_little(file, number);
}

/// What the manifest says of a level.
struct LevelFacts {
  float scale = 0;  ///< lengths below it do not show, nm
  std::uint32_t bytes = 0;
};

void write_manifest(const std::filesystem::path& path, const FloatBox& box,
                    const std::vector<LevelFacts>& levels) {
  AtomicFile file(path);
  append_floats(file, box.shape);
  append_floats(file, box.origin);
  append_little(file, static_cast<std::uint32_t>(levels.size()));
  for (const LevelFacts& level : levels) append_little(file, level.scale);
  for (std::size_t i = 0; i < levels.size(); ++i) append_floats(file, {0, 0, 0});  // offsets
  for (std::size_t i = 0; i < levels.size(); ++i) append_little(file, std::uint32_t{1});
  for (const LevelFacts& level : levels) {
    for (int k = 0; k < 3; ++k) append_little(file, std::uint32_t{0});  // place of the fragment
    append_little(file, level.bytes);
  }
  file.commit();
}

}  // namespace

void DracoSink::begin(const SurfaceHeader& header) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max() / 3;
  check_max(segment_.string(), "triangles", header.triangles(), kMax);
  surface_.vertices.reserve(header.vertices());
  surface_.triangles.reserve(header.triangles());
}

void DracoSink::write_vertices(std::span<const Position> positions) {
  for (const auto& [x, y, z] : positions) {
    surface_.vertices.push_back({x * nm_per_unit_, y * nm_per_unit_, z * nm_per_unit_});
  }
}

void DracoSink::write_triangles(std::span<const Triangle> triangles) {
  surface_.triangles.insert(surface_.triangles.end(), triangles.begin(), triangles.end());
}

std::uint32_t DracoSink::append_level(const TriangleSurface& surface, const FloatBox& box,
                                      int level, AtomicFile& file) const {
  draco::Mesh mesh;
  add_positions(surface.vertices, box, level, mesh);
  add_faces(surface.triangles, mesh);
  draco::Encoder encoder;
  // Triangles may go round the other way or in another order, but not away.
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(mesh, &buffer);
  if (!status.ok()) {
    throw Error(ErrorKind::kInternal,
                text(segment_.string(), ": Draco: ", status.error_msg_string()));
  }
  check_max(segment_.string(), "bytes", buffer.size(), std::numeric_limits<std::uint32_t>::max());
  file.append(std::string_view(buffer.data(), buffer.size()));
  return static_cast<std::uint32_t>(buffer.size());
}

/// Coarser levels are clustered in cubes of 2, 4, 8 mean edges, as long as that leaves a surface.
void DracoSink::finish() {
  const FloatBox box = box_of(surface_.vertices);
  const Position origin{box.origin[0], box.origin[1], box.origin[2]};
  double scale = mean_edge_length(surface_);
  AtomicFile file(segment_);
  std::vector<LevelFacts> levels{{static_cast<float>(scale), append_level(surface_, box, 0, file)}};
  std::size_t triangles = surface_.triangles.size();
  while (triangles > kFewTriangles && levels.size() < kMostLevels) {
    scale *= 2;
    const TriangleSurface level = clustered(surface_, origin, scale);
    triangles = level.triangles.size();
    if (triangles == 0) break;
    const int number = static_cast<int>(levels.size());
    levels.push_back({static_cast<float>(scale), append_level(level, box, number, file)});
  }
  file.commit();
  write_manifest(segment_.string() + ".index", box, levels);
}

}  // namespace mw::io
