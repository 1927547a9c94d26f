// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Segments of multi-resolution meshes, decoded by Draco.
#include <draco/compression/decode.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "io/file/byte_order.h"
#include "io/surface/precomputed/coarser_surface.h"
#include "io/surface/precomputed/draco_sink.h"
#include "io/surface/precomputed/mesh_folder.h"
#include "tests/io/surface/collected_surface.h"
#include "tests/oracle/small_volumes.h"

namespace mw::io {
namespace {

/// What a manifest says whose levels have one fragment each.
struct Manifest {
  std::array<float, 3> shape{};
  std::array<float, 3> origin{};
  std::vector<float> scales;
  std::vector<std::uint32_t> bytes;
};

Manifest read_manifest(const std::filesystem::path& path) {
  const std::string content = content_of(path);
  const auto* bytes = reinterpret_cast<const std::byte*>(content.data());
  const auto number = [&](std::size_t at) {
    return load<std::uint32_t>(bytes + 4 * at, ByteOrder::kLittle);
  };
  const auto real = [&](std::size_t at) { return load<float>(bytes + 4 * at, ByteOrder::kLittle); };
  Manifest out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.shape[k] = real(k);
    out.origin[k] = real(3 + k);
  }
  const std::size_t levels = number(6);
  EXPECT_EQ(content.size(), 4 * (7 + 9 * levels));
  for (std::size_t level = 0; level < levels; ++level) {
    out.scales.push_back(real(7 + level));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(real(7 + levels + 3 * level + k), 0) << "offset of the vertices";
      EXPECT_EQ(number(7 + 5 * levels + 4 * level + k), 0U) << "place of the fragment";
    }
    EXPECT_EQ(number(7 + 4 * levels + level), 1U) << "fragments";
    out.bytes.push_back(number(7 + 5 * levels + 4 * level + 3));
  }
  return out;
}

/// Triangles of a level in the mesh's units, corners by place, the least first.
std::vector<std::array<Position, 3>> decode(const std::filesystem::path& segment,
                                            const Manifest& manifest, std::size_t level = 0) {
  const std::string content = content_of(segment);
  const auto first = manifest.bytes.begin(), end = manifest.bytes.end();
  EXPECT_EQ(content.size(), std::accumulate(first, end, std::size_t{0}));
  const auto begin =
      std::accumulate(first, first + static_cast<std::ptrdiff_t>(level), std::size_t{0});
  draco::DecoderBuffer buffer;
  buffer.Init(content.data() + begin, manifest.bytes[level]);
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  EXPECT_TRUE(decoded.ok());
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  const draco::PointAttribute* attribute =
      mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  std::vector<std::array<Position, 3>> out;
  for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
    std::array<Position, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<std::int32_t, 3> steps{};
      const draco::PointIndex point = mesh->face(draco::FaceIndex(f))[i];
      EXPECT_TRUE(
          attribute->ConvertValue<std::int32_t>(attribute->mapped_index(point), steps.data()));
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_TRUE(steps[k] >= 0 && steps[k] < 1 << kDracoBits);
        const bool is_within_half = 2 * steps[k] <= 65535;
        EXPECT_TRUE(level == 0 || is_within_half);
        corners[i][k] =
            static_cast<double>(manifest.origin[k]) +
            std::ldexp(static_cast<double>(manifest.shape[k]), static_cast<int>(level)) * steps[k] /
                65535.0;
      }
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    out.push_back(corners);
  }
  std::sort(out.begin(), out.end());
  return out;
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
    const TempDir dir;
    constexpr double kNmPerUnit = 1000;
    for (const bool manifold : {false, true}) {
      Surface surface = mesh.surface({plans.of_label(1)}, manifold);
      DracoSink sink(dir.path() / "1", kNmPerUnit);
      surface.write(sink);
      CollectSurface plain;
      surface.write(plain);
      std::vector<std::array<Position, 3>> expected;
      for (const Triangle& t : plain.triangles) {
        std::array<Position, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) corners[i] = plain.vertices[t[i]];
        expected.push_back(corners);
      }
      auto found = decode(dir.path() / "1", read_manifest(dir.path() / "1.index"));
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

TEST(DracoMeshes, EachLevelIsCoarserAndWithinItsBound) {
  const TriangleSurface surface = torus(90);
  const TempDir dir;
  DracoSink sink(dir.path() / "1", 1);
  sink.write_vertices(surface.vertices);
  sink.write_triangles(surface.triangles);
  sink.finish();
  const Manifest manifest = read_manifest(dir.path() / "1.index");
  ASSERT_GE(manifest.bytes.size(), 4U);
  EXPECT_LE(manifest.bytes.size(), 8U);
  EXPECT_NEAR(manifest.scales[0], mean_edge_length(surface), 1e-4);
  std::size_t triangles = 0;
  for (std::size_t level = 0; level < manifest.bytes.size(); ++level) {
    const auto found = decode(dir.path() / "1", manifest, level);
    if (level == 0) {
      EXPECT_EQ(found.size(), surface.triangles.size());
    } else {
      EXPECT_LT(3 * found.size(), 2 * triangles) << level;
      EXPECT_FLOAT_EQ(manifest.scales[level], 2 * manifest.scales[level - 1]);
    }
    triangles = found.size();
    std::vector<Position> corners;
    for (const auto& t : found) corners.insert(corners.end(), t.begin(), t.end());
    const double bound = 1.01 * std::sqrt(3.0) * static_cast<double>(manifest.scales[level]);
    for (std::size_t i = 0; i < corners.size(); i += 97) {
      EXPECT_LT(distance_to(corners[i], surface.vertices), bound) << level;
    }
    for (std::size_t i = 0; i < surface.vertices.size(); i += 97) {
      EXPECT_LT(distance_to(surface.vertices[i], corners), bound) << level;
    }
  }
  EXPECT_LE(triangles, 200U);
}

/// By maps over whole cubes.
TEST(CoarserSurface, IsWhatItsRuleSays) {
  std::mt19937 random(811);
  for (int i = 0; i < 60; ++i) {
    TriangleSurface fine;
    const std::uint32_t vertices = 3 + audit::test::below(random, 60);
    const auto row = [&] { return std::uint64_t{audit::test::below(random, vertices)}; };
    for (std::uint32_t v = 0; v < vertices; ++v) {
      Position& p = fine.vertices.emplace_back();
      for (double& x : p) x = audit::test::below(random, 1000) / 100.0 - 2.0;
    }
    for (int t = 0; t < 100; ++t) fine.triangles.push_back({row(), row(), row()});
    const double cell = 0.5 + audit::test::below(random, 300) / 100.0;
    const Position origin{-2, -2, -2};
    std::map<std::array<int, 3>, std::vector<Position>> cubes;
    const auto cube_of = [&](const Position& p) {
      std::array<int, 3> out{};
      for (std::size_t k = 0; k < 3; ++k) {
        out[k] = static_cast<int>(std::floor((p[k] - origin[k]) / cell));
      }
      return out;
    };
    for (const Position& p : fine.vertices) cubes[cube_of(p)].push_back(p);
    std::set<std::set<std::array<int, 3>>> expected;
    for (const Triangle& t : fine.triangles) {
      std::set<std::array<int, 3>> corners;
      for (const std::uint64_t v : t) corners.insert(cube_of(fine.vertices[v]));
      if (corners.size() == 3) expected.insert(corners);
    }
    const TriangleSurface coarse = clustered(fine, origin, cell);
    std::set<std::set<std::array<int, 3>>> found;
    for (const Triangle& t : coarse.triangles) {
      std::set<std::array<int, 3>> corners;
      for (const std::uint64_t v : t) corners.insert(cube_of(coarse.vertices[v]));
      found.insert(corners);
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(coarse.triangles.size(), expected.size());
    for (const Position& p : coarse.vertices) {
      Position mean{};
      const std::vector<Position>& all = cubes[cube_of(p)];
      for (std::size_t k = 0; k < 3; ++k) {
        for (const Position& q : all) mean[k] += q[k] / static_cast<double>(all.size());
        EXPECT_NEAR(p[k], mean[k], 1e-9);
      }
    }
  }
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

}  // namespace
}  // namespace mw::io
