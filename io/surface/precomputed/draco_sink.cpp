// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One segment of neuroglancer's multi-resolution meshes.
#include "io/surface/precomputed/draco_sink.h"

#include <draco/compression/encode.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/file/errors.h"
#include "io/surface/precomputed/octree_cells.h"
#include "io/volume/precomputed/sharding.h"
#include "kernels/decimate/surface_decimator.h"

namespace mw::io {
namespace {

/// The most levels of detail, and the most triangles of a level that needs no coarser one.
constexpr std::size_t kMostLevels = 8;
constexpr std::size_t kFewTriangles = 200;
/// A level is of use if it has at most this share of the triangles of the one before.
constexpr double kLeastGain = 0.8;

/// The length of a cell in mean edges, and the most cells along an axis, for which cells may be
/// longer.  No edge is longer than a cell, so that no triangle becomes many pieces.
constexpr double kCellEdges = 64;
constexpr double kMostCells = 1 << 13;

/// The grid of the first level, in the numbers that the manifest has.
struct Octree {
  std::array<float, 3> origin{};
  std::array<double, 3> extent{};  ///< of all vertices, from the origin
  float cell = 0;                  ///< the edge of a cube

  /// Returns the cells of a level, each twice as long as those of the level before it.
  [[nodiscard]] Index3 grid(int level) const {
    const auto along = [&](std::size_t k) {
      return std::max<std::int64_t>(1, std::llround(std::ceil(extent[k] / edge(level))));
    };
    return {along(0), along(1), along(2)};
  }
  [[nodiscard]] double edge(int level) const {
    return std::ldexp(static_cast<double>(cell), level);
  }
};

/// Returns a grid that holds all levels: to keep their volume, coarse ones reach out of the box of
/// the first.  Edges are those of the first level.
Octree octree_of(const std::vector<TriangleSurface>& levels, const EdgeLengths& edges) {
  Octree out;
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const TriangleSurface& level : levels) {
      for (const Position& p : level.vertices) {
        low = std::min(low, p[k]);
        high = std::max(high, p[k]);
      }
    }
    out.origin[k] = static_cast<float>(low);
    out.extent[k] = std::max(0.0, high - static_cast<double>(out.origin[k]));
    longest = std::max(longest, out.extent[k]);
  }
  const double cell = std::max({kCellEdges * edges.mean, edges.longest, longest / kMostCells});
  out.cell = cell > 0 ? static_cast<float>(cell) : 1;
  return out;
}

SteppedSurface stepped(const TriangleSurface& surface, const Octree& octree, int level) {
  const Index3 grid = octree.grid(level);
  const std::array<std::int64_t, 3> extents{grid.x, grid.y, grid.z};
  SteppedSurface out{.vertices = {}, .triangles = surface.triangles};
  out.vertices.reserve(surface.vertices.size());
  for (const Position& p : surface.vertices) {
    Steps& steps = out.vertices.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const double cells = (p[k] - static_cast<double>(octree.origin[k])) / octree.edge(level);
      steps[k] =
          std::clamp<std::int64_t>(std::llround(cells * kCellSteps), 0, extents[k] * kCellSteps);
    }
  }
  return out;
}

SurfaceDecimator decimator_of(const TriangleSurface& surface) {
  std::vector<Vec3> vertices;
  vertices.reserve(surface.vertices.size());
  for (const auto& [x, y, z] : surface.vertices) vertices.emplace_back(x, y, z);
  std::vector<SurfaceDecimator::Triangle> triangles;
  triangles.reserve(surface.triangles.size());
  const auto row = [](std::uint64_t v) { return static_cast<std::uint32_t>(v); };
  for (const auto& [a, b, c] : surface.triangles) triangles.push_back({row(a), row(b), row(c)});
  return {vertices, std::move(triangles)};
}

TriangleSurface surface_of(const SurfaceDecimator& decimator) {
  const SurfaceDecimator::Surface surface = decimator.surface();
  TriangleSurface out;
  for (const Vec3& p : surface.vertices) out.vertices.push_back({p[0], p[1], p[2]});
  for (const auto& [a, b, c] : surface.triangles) out.triangles.push_back({a, b, c});
  return out;
}

/// Returns the surface and coarser ones, which are within 2, 4, 8 times a length of it.
std::vector<TriangleSurface> levels_of(TriangleSurface surface, double length) {
  SurfaceDecimator decimator = decimator_of(surface);
  std::vector<TriangleSurface> out;
  out.push_back(std::move(surface));
  while (decimator.triangle_count() > kFewTriangles && out.size() < kMostLevels) {
    const auto before = static_cast<double>(decimator.triangle_count());
    decimator.decimate(std::ldexp(length, static_cast<int>(out.size())));
    if (static_cast<double>(decimator.triangle_count()) > kLeastGain * before) break;
    out.push_back(surface_of(decimator));
  }
  return out;
}

void add_positions(const std::vector<Steps>& vertices, draco::Mesh& mesh) {
  const auto count = static_cast<std::uint32_t>(vertices.size());
  mesh.set_num_points(count);
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_INT32, false,
                 3 * sizeof(std::int32_t), 0);
  const int id = mesh.AddAttribute(attribute, true, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<std::int32_t, 3> steps{};
    for (std::size_t k = 0; k < 3; ++k) steps[k] = static_cast<std::int32_t>(vertices[i][k]);
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

/// Appends a Draco mesh; returns its bytes.
std::uint32_t append_mesh(const SteppedSurface& surface, std::string& fragments) {
  draco::Mesh mesh;
  add_positions(surface.vertices, mesh);
  add_faces(surface.triangles, mesh);
  draco::Encoder encoder;
  // This method may turn triangles around and reorder them, but drops none.
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(mesh, &buffer);
  if (!status.ok()) throw Error(ErrorKind::kInternal, "Draco: " + status.error_msg_string());
  check_max("Draco", "bytes", buffer.size(), std::numeric_limits<std::uint32_t>::max());
  fragments.append(buffer.data(), buffer.size());
  return static_cast<std::uint32_t>(buffer.size());
}

/// A node of the octree; one without bytes only holds those below it.
struct Node {
  Index3 cell;
  std::uint32_t bytes = 0;
};

/// A level, as the manifest describes it.
struct Level {
  float scale = 0;  ///< shorter lengths do not show, nm
  std::vector<Node> nodes;
};

/// Returns the nodes, without bytes, that hold those of a finer level.
std::vector<Node> parents_of(const std::vector<Node>& nodes) {
  std::vector<Node> out;
  for (const Node& node : nodes) {
    out.push_back({{node.cell.x / 2, node.cell.y / 2, node.cell.z / 2}, 0});
  }
  return out;
}

/// Adds a level's meshes.  Readers find a node by the one that holds it, so that each needs one.
Level add_level(const TriangleSurface& surface, const Octree& octree,
                const std::vector<Level>& finer, std::string& fragments) {
  const int level = static_cast<int>(finer.size());
  const Index3 grid = octree.grid(level);
  std::vector<Node> nodes;
  for (const CellPart& part : cut_into_cells(stepped(surface, octree, level), grid, level > 0)) {
    nodes.push_back({part.cell, append_mesh(part.surface, fragments)});
  }
  if (!finer.empty()) {
    const std::vector<Node> parents = parents_of(finer.back().nodes);
    nodes.insert(nodes.end(), parents.begin(), parents.end());
  }
  const auto code = [&](const Node& node) { return morton_code(node.cell, grid); };
  std::stable_sort(nodes.begin(), nodes.end(),
                   [&](const Node& a, const Node& b) { return code(a) < code(b); });
  nodes.erase(std::unique(nodes.begin(), nodes.end(),
                          [](const Node& a, const Node& b) { return a.cell == b.cell; }),
              nodes.end());
  return {.scale = 0, .nodes = std::move(nodes)};
}

std::string manifest_of(const Octree& octree, const std::vector<Level>& levels) {
  std::string out;
  for (int k = 0; k < 3; ++k) append_little(out, octree.cell);
  for (const float x : octree.origin) append_little(out, x);
  append_little(out, static_cast<std::uint32_t>(levels.size()));
  for (const Level& level : levels) append_little(out, level.scale);
  for (std::size_t i = 0; i < 3 * levels.size(); ++i) append_little(out, 0.0F);  // offsets
  const auto number = [&](auto value) { append_little(out, static_cast<std::uint32_t>(value)); };
  for (const Level& level : levels) number(level.nodes.size());
  for (const Level& level : levels) {
    for (const Node& node : level.nodes) number(node.cell.x);
    for (const Node& node : level.nodes) number(node.cell.y);
    for (const Node& node : level.nodes) number(node.cell.z);
    for (const Node& node : level.nodes) number(node.bytes);
  }
  return out;
}

}  // namespace

void DracoSink::begin(const SurfaceHeader& header) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max() / 3;
  check_max(text("segment ", segment_), "triangles", header.triangles(), kMax);
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

void DracoSink::finish() {
  const EdgeLengths edges = edge_lengths(surface_);
  const std::vector<TriangleSurface> surfaces = levels_of(std::exchange(surface_, {}), edges.mean);
  const Octree octree = octree_of(surfaces, edges);
  std::string fragments;
  std::vector<Level> levels;
  for (const TriangleSurface& surface : surfaces) {
    const double scale = std::ldexp(edges.mean, static_cast<int>(levels.size()));
    levels.push_back(add_level(surface, octree, levels, fragments));
    levels.back().scale = static_cast<float>(scale);
  }
  segments_.add(segment_, fragments, manifest_of(octree, levels));
}

EdgeLengths edge_lengths(const TriangleSurface& surface) {
  EdgeLengths out;
  double sum = 0;
  for (const Triangle& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Position& a = surface.vertices[t[i]];
      const Position& b = surface.vertices[t[(i + 1) % 3]];
      const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      sum += length;
      out.longest = std::max(out.longest, length);
    }
  }
  const auto edges = 3.0 * static_cast<double>(surface.triangles.size());
  if (edges > 0) out.mean = sum / edges;
  return out;
}

}  // namespace mw::io
