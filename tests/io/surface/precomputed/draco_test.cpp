// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Segments of multi-resolution meshes, decoded by Draco.
#include <draco/compression/decode.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "io/file/byte_order.h"
#include "io/surface/precomputed/draco_sink.h"
#include "io/surface/precomputed/mesh_folder.h"
#include "io/surface/precomputed/octree_cells.h"
#include "io/volume/precomputed/sharding.h"
#include "tests/io/surface/collected_surface.h"
#include "tests/oracle/small_volumes.h"

namespace mw::io {
namespace {

/// A node of the octree.
struct Node {
  std::array<std::uint32_t, 3> cell{};
  std::uint32_t bytes = 0;
};

struct Manifest {
  std::array<float, 3> shape{};
  std::array<float, 3> origin{};
  std::vector<float> scales;
  std::vector<std::vector<Node>> levels;
};

/// Whether neuroglancer takes a to come before b: z counts most, then y, at the highest bit in
/// which they differ.
bool comes_before(const Node& a, const Node& b) {
  for (int bit = 31; bit >= 0; --bit) {
    for (const std::size_t k : {2U, 1U, 0U}) {
      const bool x = a.cell[k] >> static_cast<unsigned>(bit) & 1U;
      const bool y = b.cell[k] >> static_cast<unsigned>(bit) & 1U;
      if (x != y) return y;
    }
  }
  return false;
}

Manifest parse_manifest(const std::string& content) {
  const auto* bytes = reinterpret_cast<const std::byte*>(content.data());
  std::size_t at = 0;
  const auto number = [&] { return load<std::uint32_t>(bytes + 4 * at++, ByteOrder::kLittle); };
  const auto real = [&] { return load<float>(bytes + 4 * at++, ByteOrder::kLittle); };
  Manifest out;
  for (float& x : out.shape) x = real();
  for (float& x : out.origin) x = real();
  const std::size_t levels = number();
  for (std::size_t level = 0; level < levels; ++level) out.scales.push_back(real());
  for (std::size_t i = 0; i < 3 * levels; ++i) EXPECT_EQ(real(), 0) << "offset of the vertices";
  for (std::size_t level = 0; level < levels; ++level) out.levels.emplace_back(number());
  for (std::vector<Node>& nodes : out.levels) {
    for (const std::size_t k : {0U, 1U, 2U}) {
      for (Node& node : nodes) node.cell[k] = number();
    }
    for (Node& node : nodes) node.bytes = number();
    EXPECT_TRUE(std::is_sorted(nodes.begin(), nodes.end(), comes_before));
  }
  EXPECT_EQ(content.size(), 4 * at);
  return out;
}

/// What was read of a level.
struct Decoded {
  std::vector<std::array<Steps, 3>> steps;
  std::vector<std::array<Position, 3>> places;  ///< corners of triangles, the least first
};

constexpr std::int64_t kSteps = 65535;

/// Triangles of a level, as meshes.md of neuroglancer says that they are to be read.
Decoded decode(const std::string& fragments, const Manifest& manifest, std::size_t level = 0) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < level; ++i) {
    for (const Node& node : manifest.levels[i]) begin += node.bytes;
  }
  Decoded out;
  for (const Node& node : manifest.levels[level]) {
    if (node.bytes == 0) continue;
    draco::DecoderBuffer buffer;
    buffer.Init(fragments.data() + begin, node.bytes);
    begin += node.bytes;
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    EXPECT_TRUE(decoded.ok());
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    const draco::PointAttribute* attribute =
        mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION);
    EXPECT_EQ(attribute->size(), mesh->num_points());
    for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
      std::array<Steps, 3> steps{};
      std::array<Position, 3> corners{};
      std::array<bool, 3> has_low{}, has_high{};
      for (std::size_t i = 0; i < 3; ++i) {
        std::array<std::int32_t, 3> own{};
        const draco::PointIndex point = mesh->face(draco::FaceIndex(f))[i];
        EXPECT_TRUE(
            attribute->ConvertValue<std::int32_t>(attribute->mapped_index(point), own.data()));
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_TRUE(own[k] >= 0 && own[k] <= kSteps);
          has_low[k] = has_low[k] || own[k] < 32768;
          has_high[k] = has_high[k] || own[k] > 32768;
          steps[i][k] = node.cell[k] * kSteps + own[k];
          corners[i][k] =
              static_cast<double>(manifest.origin[k]) +
              std::ldexp(static_cast<double>(manifest.shape[k]), static_cast<int>(level)) *
                  (node.cell[k] + own[k] / static_cast<double>(kSteps));
        }
      }
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_TRUE(level == 0 || !has_low[k] || !has_high[k]) << "crosses the middle";
      }
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      out.steps.push_back(steps);
      out.places.push_back(corners);
    }
  }
  std::sort(out.places.begin(), out.places.end());
  return out;
}

/// A segment in files of its own.
struct Segment {
  std::string fragments;
  std::string index;
};

/// fill(sink): begin to finish.
template <class Fill>
Segment write_segment(double nm_per_unit, Fill fill) {
  const TempDir dir;
  DracoSegments segments(dir.path());
  DracoSink sink(segments, 1, nm_per_unit);
  fill(sink);
  EXPECT_TRUE(segments.finish(1).is_null());
  return {content_of(dir.path() / "1"), content_of(dir.path() / "1.index")};
}

Segment write_segment(const TriangleSurface& surface) {
  return write_segment(1, [&](SurfaceSink& sink) {
    sink.write_vertices(surface.vertices);
    sink.write_triangles(surface.triangles);
    sink.finish();
  });
}

/// The corners of the mesh are whole numbers.
void round_off(std::vector<std::array<Position, 3>>& triangles) {
  for (std::array<Position, 3>& corners : triangles) {
    for (Position& p : corners) {
      for (double& x : p) {
        EXPECT_NEAR(x, std::round(x), 1e-3);
        x = std::round(x) + 0.0;
      }
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  }
  std::sort(triangles.begin(), triangles.end());
}

TEST(DracoMeshes, SegmentsComeBackTriangleByTriangle) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SurfaceMesh mesh(touching_mesh(seed));
    const ShellPlans plans(mesh.mesh(), true);
    constexpr double kNmPerUnit = 1000;
    for (const bool manifold : {false, true}) {
      Surface surface = mesh.surface({plans.of_label(1)}, manifold);
      const Segment segment =
          write_segment(kNmPerUnit, [&](SurfaceSink& sink) { surface.write(sink); });
      CollectSurface plain;
      surface.write(plain);
      std::vector<std::array<Position, 3>> expected;
      for (const Triangle& t : plain.triangles) {
        std::array<Position, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) corners[i] = plain.vertices[t[i]];
        expected.push_back(corners);
      }
      auto found = decode(segment.fragments, parse_manifest(segment.index)).places;
      for (auto& corners : found) {
        for (Position& p : corners) {
          for (double& x : p) x /= kNmPerUnit;
        }
      }
      round_off(found);
      round_off(expected);
      EXPECT_EQ(found, expected) << seed << " " << manifold;
    }
  }
}

/// A torus of 2 n^2 triangles: closed, not convex.
TriangleSurface torus(std::uint64_t n) {
  TriangleSurface out;
  const auto row = [n](std::uint64_t i, std::uint64_t j) { return i % n * n + j % n; };
  const double step = 2 * std::numbers::pi / static_cast<double>(n);
  for (std::uint64_t i = 0; i < n; ++i) {
    for (std::uint64_t j = 0; j < n; ++j) {
      const double a = step * static_cast<double>(i), b = step * static_cast<double>(j);
      const double r = 40 + 15 * std::cos(b);
      out.vertices.push_back({r * std::cos(a), r * std::sin(a), 15 * std::sin(b)});
      out.triangles.push_back({row(i, j), row(i + 1, j), row(i + 1, j + 1)});
      out.triangles.push_back({row(i, j), row(i + 1, j + 1), row(i, j + 1)});
    }
  }
  return out;
}

double distance_to(const Position& p, const std::vector<Position>& others) {
  double least = std::numeric_limits<double>::infinity();
  for (const Position& q : others) {
    least = std::min(least, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
  }
  return least;
}

/// The volume that triangles enclose.
double volume_of(const std::vector<std::array<Position, 3>>& triangles) {
  double out = 0;
  for (const auto& [a, b, c] : triangles) {
    out += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
            a[2] * (b[0] * c[1] - b[1] * c[0])) /
           6;
  }
  return out;
}

TEST(DracoMeshes, EachLevelIsCoarserAndWithinItsBound) {
  const TriangleSurface surface = torus(90);
  const Segment segment = write_segment(surface);
  const Manifest manifest = parse_manifest(segment.index);
  const auto fine = decode(segment.fragments, manifest).places;
  ASSERT_GE(manifest.levels.size(), 3U);
  EXPECT_LE(manifest.levels.size(), 8U);
  EXPECT_NEAR(manifest.scales[0], edge_lengths(surface).mean, 1e-4);
  std::size_t triangles = 0;
  for (std::size_t level = 0; level < manifest.levels.size(); ++level) {
    const auto found = decode(segment.fragments, manifest, level).places;
    if (level > 0) {
      EXPECT_LT(3 * found.size(), 2 * triangles) << level;
      EXPECT_FLOAT_EQ(manifest.scales[level], 2 * manifest.scales[level - 1]);
    }
    triangles = found.size();
    std::vector<Position> corners;
    for (const auto& t : found) corners.insert(corners.end(), t.begin(), t.end());
    const double bound = 1.01 * static_cast<double>(manifest.scales[level] + manifest.scales[0]);
    for (std::size_t i = 0; i < corners.size(); i += 97) {
      EXPECT_LT(distance_to(corners[i], surface.vertices), bound) << level;
    }
    EXPECT_NEAR(volume_of(found) / volume_of(fine), 1, 0.01) << level;
  }
  EXPECT_LE(triangles, 200U);
}

/// A closed surface that goes through many cells stays closed: each edge is that of two triangles,
/// one each way round, whichever cells they are in.  It encloses what it did.
TEST(DracoMeshes, CellsFitTogether) {
  const TriangleSurface surface = torus(400);
  const Segment segment = write_segment(surface);
  const Manifest manifest = parse_manifest(segment.index);
  ASSERT_GT(manifest.levels[0].size(), 10U);
  const Decoded found = decode(segment.fragments, manifest);
  std::map<std::array<Steps, 2>, int> edges;
  for (const auto& t : found.steps) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Steps &a = t[i], &b = t[(i + 1) % 3];
      if (a < b) ++edges[{a, b}];
      if (b < a) --edges[{b, a}];
    }
  }
  for (const auto& [edge, balance] : edges) ASSERT_EQ(balance, 0);
  const double torus_volume = 2 * std::numbers::pi * std::numbers::pi * 40 * 15 * 15;
  EXPECT_NEAR(volume_of(found.places), torus_volume, 1e-3 * torus_volume);
  for (std::size_t level = 1; level < manifest.levels.size(); ++level) {
    const std::vector<Node>& parents = manifest.levels[level];
    for (const Node& node : manifest.levels[level - 1]) {
      const auto holds = [&](const Node& parent) {
        return parent.cell == std::array{node.cell[0] / 2, node.cell[1] / 2, node.cell[2] / 2};
      };
      EXPECT_TRUE(std::any_of(parents.begin(), parents.end(), holds)) << level;
    }
  }
}

/// A triangle that is far longer than the others would cross some hundred cells of 64 mean edges.
TEST(DracoMeshes, LongTrianglesAreNotCutIntoMany) {
  TriangleSurface surface = torus(60);
  const std::uint64_t first = surface.vertices.size();
  surface.vertices.insert(surface.vertices.end(), {{0, 0, 0}, {1e7, 0, 3}, {2, 1e7, 1e7}});
  surface.triangles.push_back({first, first + 1, first + 2});
  const Segment segment = write_segment(surface);
  const Manifest manifest = parse_manifest(segment.index);
  for (std::size_t level = 0; level < manifest.levels.size(); ++level) {
    EXPECT_LE(decode(segment.fragments, manifest, level).places.size(),
              surface.triangles.size() + 20);
  }
}

/// Triangles of any size, place and multiplicity: pieces lie in their cells, none crosses a plane,
/// and they cover what the triangle did.
TEST(OctreeCells, PiecesAreTheTriangleCellByCell) {
  std::mt19937 random(86);
  for (int i = 0; i < 300; ++i) {
    const Index3 grid{1 + audit::test::below(random, 5), 1 + audit::test::below(random, 5),
                      1 + audit::test::below(random, 3)};
    const std::array<std::int64_t, 3> extents{grid.x, grid.y, grid.z};
    SteppedSurface surface;
    for (int v = 0; v < 5; ++v) {
      Steps& p = surface.vertices.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t most = static_cast<std::uint32_t>(extents[k] * kSteps);
        p[k] = audit::test::below(random, most + 1);
        if (audit::test::below(random, 3) == 0) p[k] = p[k] / kSteps * kSteps;  // in a plane
      }
    }
    surface.triangles = {{0, 1, 2}, {2, 1, 3}, {0, 2, 4}};
    const bool halves = i % 2 == 0;
    const auto parts = cut_into_cells(surface, grid, halves);
    const auto area = [](const Steps& a, const Steps& b, const Steps& c) {
      std::array<double, 3> n{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t p = (k + 1) % 3, q = (k + 2) % 3;
        n[k] = static_cast<double>(b[p] - a[p]) * static_cast<double>(c[q] - a[q]) -
               static_cast<double>(b[q] - a[q]) * static_cast<double>(c[p] - a[p]);
      }
      return std::hypot(n[0], n[1], n[2]) / 2;
    };
    double before = 0, after = 0;
    for (const auto& [a, b, c] : surface.triangles) {
      before += area(surface.vertices[a], surface.vertices[b], surface.vertices[c]);
    }
    for (const auto& [cell, part] : parts) {
      EXPECT_FALSE(part.triangles.empty());
      for (const auto& [a, b, c] : part.triangles) {
        after += area(part.vertices[a], part.vertices[b], part.vertices[c]);
        for (std::size_t k = 0; k < 3; ++k) {
          const auto [low, high] =
              std::minmax({part.vertices[a][k], part.vertices[b][k], part.vertices[c][k]});
          EXPECT_TRUE(low >= 0 && high <= kSteps);
          EXPECT_TRUE(!halves || low >= 32768 || high <= 32768);
        }
      }
    }
    EXPECT_NEAR(after, before, 2e-4 * before + 4e6) << i;
  }
}

/// Writes the surface of label 1 of a mesh once for each segment.
void fill_folder(MeshFolder& folder, SurfaceMesh& mesh, std::size_t segments) {
  const ShellPlans plans(mesh.mesh(), true);
  for (std::size_t i = 0; i < segments; ++i) {
    mesh.surface({plans.of_label(1)}, false).write(*folder.sink(i * i * 77));
  }
}

/// In shards each segment is what it is in files of its own.
TEST(DracoMeshes, ShardsHoldTheSameSegments) {
  SurfaceMesh mesh(touching_mesh(2));
  const TempDir dir;
  constexpr std::size_t kSegments = 1500;
  MeshFolder single(dir.path() / "single", {.kind = FragmentKind::kDraco});
  fill_folder(single, mesh, kSegments);
  single.finish({});
  MeshFolder sharded(dir.path() / "sharded",
                     {.kind = FragmentKind::kDraco, .most_single = kSegments - 1});
  fill_folder(sharded, mesh, kSegments);
  sharded.finish({});
  EXPECT_FALSE(nlohmann::json::parse(content_of(dir.path() / "single/info")).contains("sharding"));
  const auto info = nlohmann::json::parse(content_of(dir.path() / "sharded/info"))["sharding"];
  EXPECT_EQ(info["@type"], "neuroglancer_uint64_sharded_v1");
  EXPECT_EQ(info["hash"], "murmurhash3_x86_128");
  const Sharding sharding{.hashed = true,
                          .preshift_bits = info["preshift_bits"],
                          .minishard_bits = info["minishard_bits"],
                          .shard_bits = info["shard_bits"]};
  EXPECT_GT(sharding.minishard_bits, 0);
  std::size_t found = 0;
  for (std::size_t i = 0; i < kSegments; ++i) {
    const std::uint64_t segment = i * i * 77;
    const ShardPosition at = position_of(sharding, segment);
    const std::string shard =
        content_of(dir.path() / "sharded" / shard_file_name(sharding, at.shard));
    const std::span<const std::byte> bytes = std::as_bytes(std::span(shard));
    const std::uint64_t data = shard_index_bytes(sharding);
    const auto bound = [&](std::size_t end) {
      return load<std::uint64_t>(bytes.data() + 16 * at.minishard + 8 * end, ByteOrder::kLittle);
    };
    const auto index = bytes.subspan(data + bound(0), bound(1) - bound(0));
    for (const ShardEntry& entry : parse_minishard_index(index, bytes.size() - data, "shard")) {
      if (entry.chunk != segment) continue;
      ++found;
      const std::string name = text(segment);
      const std::string fragments = content_of(dir.path() / "single" / name);
      EXPECT_EQ(shard.substr(data + entry.offset, entry.size),
                content_of(dir.path() / "single" / (name + ".index")));
      EXPECT_EQ(shard.substr(data + entry.offset - fragments.size(), fragments.size()), fragments);
    }
  }
  EXPECT_EQ(found, kSegments);
}

TEST(DracoMeshes, FolderSaysWhatItIs) {
  MeshData data = touching_mesh(2);
  data.names = LabelNames({{1, "one \"1\"", {}}});
  SurfaceMesh mesh(data);
  const ShellPlans plans(mesh.mesh(), true);
  const TempDir dir;
  std::array<std::string, 2> bytes;
  for (const std::string name : {"a", "b"}) {
    MeshFolder folder(dir.path() / name, {.kind = FragmentKind::kDraco});
    mesh.surface({plans.of_label(1)}, false).write(*folder.sink(1));
    folder.finish(data.names);
    bytes[name == "a" ? 0 : 1] = content_of(dir.path() / name / "1");
  }
  EXPECT_EQ(bytes[0], bytes[1]);
  const auto info = nlohmann::json::parse(content_of(dir.path() / "a/info"));
  EXPECT_EQ(info["@type"], "neuroglancer_multilod_draco");
  EXPECT_EQ(info["vertex_quantization_bits"], kDracoBits);
  EXPECT_EQ(info["transform"], (std::vector<int>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}));
  const auto names =
      nlohmann::json::parse(content_of(dir.path() / "a/segment_properties/info"))["inline"];
  EXPECT_EQ(names["ids"], std::vector<std::string>{"1"});
  EXPECT_EQ(names["properties"][0]["values"], std::vector<std::string>{"one \"1\""});
}

/// Plain meshes have coordinates as 32-bit floats in nm; Draco's have steps from a corner.
TEST(PrecomputedMeshes, PlainFloatsThatAreTooCoarseAreRefused) {
  MeshData data = grid_mesh({2, 2, 2}, 1);
  for (Position& p : data.vertices) p[0] += 400'000;
  SurfaceMesh mesh(data);
  const ShellPlans plans(mesh.mesh(), true);
  const TempDir dir;
  for (const FragmentKind kind : {FragmentKind::kLegacy, FragmentKind::kDraco}) {
    MeshFolder folder(dir.path() / "far", {.kind = kind});
    folder.use_unit("um");
    const auto write = [&] { mesh.surface({plans.of_label(0)}, false).write(*folder.sink(1)); };
    if (kind == FragmentKind::kDraco) {
      write();
    } else {
      expect_error(ErrorKind::kUsage, {"24 bits", "coordinates of 40000", "--format draco"}, write);
    }
  }
}

/// A box of 2 x 3 x 3 cubes beside others of the same mesh.
TEST(PrecomputedMeshes, SegmentsHaveFigures) {
  MeshData data = grid_mesh({4, 3, 3}, 0);
  for (std::size_t i = 0; i < data.tets.size(); ++i) {
    double x = 0;
    for (const auto v : data.tets[i]) x += data.vertices[v][0] / 4;
    data.labels[i] = x < 2 ? 1 : x < 3 ? 2 : 3;
  }
  SurfaceMesh mesh(data);
  const ShellPlans plans(mesh.mesh(), true);
  const TempDir dir;
  for (const bool closed : {true, false}) {
    const std::string name = closed ? "closed" : "open";
    MeshFolder folder(dir.path() / name, {.closed = closed});
    folder.use_unit("um");
    for (const RawLabel label : {1U, 2U}) {
      const Label rank = static_cast<Label>(label - 1);
      mesh.surface({plans.of_label(rank)}, false).write(*folder.sink(label));
    }
    folder.finish({});
    const auto properties = nlohmann::json::parse(
        content_of(dir.path() / name / "segment_properties/info"))["inline"]["properties"];
    std::map<std::string, std::vector<double>> numbers;
    for (const auto& property : properties) {
      if (property["type"] == "number")
        numbers[property["id"]] = property["values"].get<std::vector<double>>();
    }
    EXPECT_EQ(numbers.count("volume"), closed ? 1U : 0U);
    if (closed) {
      EXPECT_NEAR(numbers["volume"][0], 18, 1e-9);
      EXPECT_NEAR(numbers["volume"][1], 9, 1e-9);
    }
    EXPECT_NEAR(numbers["area"][0], 42, 1e-9);
    EXPECT_NEAR(numbers["area"][1], 30, 1e-9);
    EXPECT_EQ(numbers["neighbours"], (std::vector<double>{1, 2}));
  }
}

}  // namespace
}  // namespace mw::io
