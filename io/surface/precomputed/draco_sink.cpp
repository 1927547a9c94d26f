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

constexpr double kMaxStep = (1 << kDracoBits) - 1;

/// What the file says, in the numbers that it has.
struct FloatBox {
  std::array<float, 3> origin{};
  std::array<float, 3> shape{};
};

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

std::array<std::int32_t, 3> steps_of(const Position& p, const FloatBox& box) {
  std::array<std::int32_t, 3> steps{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = (p[k] - static_cast<double>(box.origin[k])) / box.shape[k];
    steps[k] = static_cast<std::int32_t>(std::lround(std::clamp(share, 0.0, 1.0) * kMaxStep));
  }
  return steps;
}

void add_positions(const std::vector<Position>& vertices, const FloatBox& box, draco::Mesh& mesh) {
  const auto count = static_cast<std::uint32_t>(vertices.size());
  mesh.set_num_points(count);
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_INT32, false,
                 3 * sizeof(std::int32_t), 0);
  const int id = mesh.AddAttribute(attribute, true, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::array<std::int32_t, 3> steps = steps_of(vertices[i], box);
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

void write_manifest(const std::filesystem::path& path, const FloatBox& box, std::size_t bytes) {
  AtomicFile file(path);
  append_floats(file, box.shape);
  append_floats(file, box.origin);
  append_little(file, std::uint32_t{1});                              // levels of detail
  append_little(file, 1.0F);                                          // scale of the level
  append_floats(file, {0, 0, 0});                                     // its offset
  append_little(file, std::uint32_t{1});                              // its fragments
  for (int k = 0; k < 3; ++k) append_little(file, std::uint32_t{0});  // place of the fragment
  append_little(file, static_cast<std::uint32_t>(bytes));
  file.commit();
}

}  // namespace

void DracoSink::begin(const SurfaceHeader& header) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max() / 3;
  check_max(segment_.string(), "triangles", header.triangles(), kMax);
  vertices_.reserve(header.vertices());
  triangles_.reserve(header.triangles());
}

void DracoSink::write_vertices(std::span<const Position> positions) {
  for (const auto& [x, y, z] : positions) {
    vertices_.push_back({x * nm_per_unit_, y * nm_per_unit_, z * nm_per_unit_});
  }
}

void DracoSink::write_triangles(std::span<const Triangle> triangles) {
  triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
}

void DracoSink::finish() {
  const FloatBox box = box_of(vertices_);
  draco::Mesh mesh;
  add_positions(vertices_, box, mesh);
  add_faces(triangles_, mesh);
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
  AtomicFile file(segment_);
  file.append(std::string_view(buffer.data(), buffer.size()));
  file.commit();
  write_manifest(segment_.string() + ".index", box, buffer.size());
}

}  // namespace mw::io
