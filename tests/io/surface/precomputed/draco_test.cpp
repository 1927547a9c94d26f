// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Segments of multi-resolution meshes, decoded by Draco.
#include <draco/compression/decode.h>

#include <nlohmann/json.hpp>

#include "io/file/byte_order.h"
#include "io/surface/precomputed/draco_sink.h"
#include "io/surface/precomputed/mesh_folder.h"
#include "tests/io/surface/collected_surface.h"

namespace mw::io {
namespace {

/// What a manifest of one fragment says.
struct Manifest {
  std::array<float, 3> shape{};
  std::array<float, 3> origin{};
  std::uint32_t bytes = 0;
};

Manifest read_manifest(const std::filesystem::path& path) {
  const std::string content = content_of(path);
  EXPECT_EQ(content.size(), 64U);
  const auto* bytes = reinterpret_cast<const std::byte*>(content.data());
  const auto number = [&](std::size_t at) {
    return load<std::uint32_t>(bytes + 4 * at, ByteOrder::kLittle);
  };
  const auto real = [&](std::size_t at) { return load<float>(bytes + 4 * at, ByteOrder::kLittle); };
  Manifest out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.shape[k] = real(k);
    out.origin[k] = real(3 + k);
    EXPECT_EQ(real(8 + k), 0) << "offset of the vertices";
    EXPECT_EQ(number(12 + k), 0U) << "place of the fragment";
  }
  EXPECT_EQ(number(6), 1U) << "levels";
  EXPECT_EQ(real(7), 1) << "scale";
  EXPECT_EQ(number(11), 1U) << "fragments";
  out.bytes = number(15);
  return out;
}

/// Triangles of the segment in the mesh's units, corners by place, the least first.
std::vector<std::array<Position, 3>> decode(const std::filesystem::path& segment,
                                            const Manifest& manifest) {
  const std::string content = content_of(segment);
  EXPECT_EQ(content.size(), manifest.bytes);
  draco::DecoderBuffer buffer;
  buffer.Init(content.data(), content.size());
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
        corners[i][k] = static_cast<double>(manifest.origin[k]) +
                        static_cast<double>(manifest.shape[k]) * steps[k] / 65535.0;
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
