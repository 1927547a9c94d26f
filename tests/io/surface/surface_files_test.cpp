// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files of surfaces: the same bytes each time, whole or not there, in memory that does not grow.
#include <gmock/gmock.h>

#include "io/file/sink/atomic_file.h"
#include "io/surface/open_surface.h"
#include "tests/io/surface/collected_surface.h"
#include "tests/peak_growth.h"
#include "tests/sanitizers.h"

namespace mw::io {
namespace {

constexpr std::array<const char*, 4> kExtensions{".stl", ".ply", ".obj", ".vtp"};

MeshData named_mesh(unsigned seed) {
  MeshData mesh = touching_mesh(seed);
  mesh.names = LabelNames({{0, "", Colour{1, 2, 3, 4}}, {1, "one # 1", {}}});
  return mesh;
}

void write_file(const MeshData& data, const std::filesystem::path& path) {
  SurfaceMesh mesh(data);
  const ShellPlans plans(mesh.mesh(), true);
  const std::unique_ptr<SurfaceSink> sink = open_surface_sink(path);
  mesh.surface({plans.of_label(1), plans.of_label(0)}, true).write(*sink);
}

TEST(SurfaceFiles, SameBytesEachTime) {
  for (const char* extension : kExtensions) {
    const TempDir one, other;
    const std::string name = std::string("s") + extension;
    write_file(named_mesh(3), one.path() / name);
    write_file(named_mesh(3), other.path() / name);
    EXPECT_EQ(content_of(one.path() / name), content_of(other.path() / name));
  }
}

/// What 3D Slicer looks for: a word in the 80 bytes of an STL and in comments at the beginning of
/// others, an array of one string in a VTP.
std::string told_space(const std::string& space, const std::string& extension) {
  if (extension == ".stl") return space;
  if (extension == ".ply") return "comment " + space + "\n";
  if (extension == ".obj") return "# " + space + "\n";
  std::string codes;
  for (const char c : space.substr(space.find('=') + 1)) codes += text(int{c}, " ");
  return "<Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">" + codes +
         "0 </Array>";
}

TEST(SurfaceFiles, SayWhichFrameTheyAreInAsSlicerLooksForIt) {
  const TempDir dir;
  for (const auto& [frame, space] :
       {std::pair(WorldFrame::kRas, "SPACE=RAS"), std::pair(WorldFrame::kLps, "SPACE=LPS"),
        std::pair(WorldFrame::kOwn, "")}) {
    MeshData data = named_mesh(2);
    data.record.frame = frame;
    for (const char* extension : kExtensions) {
      const auto path = dir.path() / (std::string("s") + extension);
      write_file(data, path);
      const std::string content = content_of(path);
      if (frame == WorldFrame::kOwn) {
        EXPECT_EQ(content.find("SPACE"), content.npos) << extension;
      } else {
        const std::size_t place = content.find(told_space(space, extension));
        EXPECT_LT(place, content.size()) << extension;
        EXPECT_TRUE(place < 80 || path.extension() != ".stl");
      }
    }
  }
}

/// Edges have a length of 1 at least, and a 64th of that are 2^18 steps of a 32-bit float.
TEST(SurfaceFiles, FloatsThatAreTooCoarseAreRefusedUnlessTheyAreShifted) {
  const TempDir dir;
  for (const double place : {-200'000.0, 200'000.0, 300'000.0, -300'000.0, 4'512'345.25}) {
    MeshData data = grid_mesh({2, 2, 2}, 1);
    for (Position& p : data.vertices) p[1] += place;
    SurfaceMesh mesh(data);
    const auto write = [&](const char* name, const Position& shift) {
      const ShellPlans plans(mesh.mesh(), true);
      const auto sink = open_surface_sink(dir.path() / name);
      Surface({mesh.mesh(), dir.path(), shift}, surface_labels(mesh.mesh()), {plans.of_label(0)},
              Touching::kJoined)
          .write(*sink);
      return content_of(dir.path() / name);
    };
    const std::string near = write("near.stl", {0, place, 0});
    EXPECT_THAT(near.substr(0, 80), testing::HasSubstr(text("; SHIFT=0,", place, ",0")));
    EXPECT_THAT(write("s.ply", {0, place, 0}),
                testing::HasSubstr(text("comment SHIFT=0,", place, ",0\n")));
    EXPECT_THAT(write("s.ply", {}), testing::Not(testing::HasSubstr("SHIFT")));
    if (std::abs(place) < 250'000) {
      EXPECT_EQ(write("far.stl", {}).size(), near.size());
      continue;
    }
    expect_error(ErrorKind::kUsage, {"far2.stl", "24 bits", "--shift X,Y,Z", ".ply"},
                 [&] { static_cast<void>(write("far2.stl", {})); });
  }
  MeshData flat = grid_mesh({2, 2, 2}, 1);
  flat.vertices[1] = flat.vertices[0];  // an edge without a length, as other programs write them
  write_file(flat, dir.path() / "flat.stl");
  expect_error(ErrorKind::kUsage, {"long.stl", "fewer digits"}, [&] {
    SurfaceMesh mesh(grid_mesh({2, 2, 2}, 1));
    const ShellPlans plans(mesh.mesh(), true);
    const Position shift{1.0 / 3, 1.0 / 7, -1e5 / 9};
    const auto sink = open_surface_sink(dir.path() / "long.stl");
    Surface({mesh.mesh(), dir.path(), shift}, surface_labels(mesh.mesh()), {plans.of_label(0)},
            Touching::kJoined)
        .write(*sink);
  });
}

TEST(SurfaceFiles, NothingIsLeftOfOneThatWasNotFinished) {
  SurfaceMesh mesh(named_mesh(2));
  const ShellPlans plans(mesh.mesh(), true);
  const TempDir dir;
  for (const char* extension : kExtensions) {
    const auto path = dir.path() / (std::string("s") + extension);
    const std::unique_ptr<SurfaceSink> sink = open_surface_sink(path);
    sink->begin(mesh.surface({plans.of_label(0)}, Touching::kJoined).header());
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_EQ(dir.entries(), 0U);
}

TEST(SurfaceFiles, LabelsThatAPlyCannotHoldGetNumbers) {
  MeshData data = grid_mesh({2, 1, 1}, 4);
  for (std::size_t t = 0; t < data.tets.size(); ++t) {
    data.labels[t] = t < 6 ? 5 : (1ULL << 40) + 7;
  }
  SurfaceMesh mesh(data);
  const ShellPlans plans(mesh.mesh(), true);
  const TempDir dir;
  const auto path = dir.path() / "s.ply";
  mesh.surface({plans.of_interfaces()}, false).write(*open_surface_sink(path));
  const std::string content = content_of(path);
  EXPECT_THAT(content, testing::HasSubstr("comment number 6 is label 1099511627783\n"));
  // The last face: 3, three vertices, label_in, label_out, side.
  const std::string face = content.substr(content.size() - 9);
  EXPECT_EQ(face, number_bytes(5, 4, false) + number_bytes(6, 4, false) + std::string(1, '\0'));
}

/// The header of a surface of this size, of which no vertices were ever written.
SurfaceHeader large_header(std::uint64_t vertices, std::uint64_t triangles) {
  auto labels = std::make_shared<SurfaceLabels>();
  labels->table = LabelTable({1, 2}, false);
  labels->titles = {"a", "b"};
  SurfaceShell shell{.label = 0, .runs = {{.outside = 1, .triangles = triangles}}};
  shell.vertices = vertices;
  return {.labels = labels, .shells = {shell}};
}

TEST(SurfaceFiles, MoreThanTheFormatHoldsIsRefused) {
  const TempDir dir;
  const SurfaceHeader header = large_header(1ULL << 32, 1ULL << 32);
  for (const char* extension : {".stl", ".ply"}) {
    const auto sink = open_surface_sink(dir.path() / (std::string("s") + extension));
    expect_error(ErrorKind::kUsage, {"s.", "4294967296", "each label apart"},
                 [&] { sink->begin(header); });
  }
  expect_error(ErrorKind::kUsage, {".foo", ".stl, .ply, .obj, .vtp"},
               [&] { static_cast<void>(open_surface_sink(dir.path() / "s.foo")); });
}

TEST(SurfaceFiles, MemoryDoesNotGrow) {
  if (!test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  constexpr std::uint64_t kBatch = 1000;
  constexpr std::uint64_t kBatches = 1500;
  constexpr long kRoomKib = 20 * 1024;
  const TempDir dir;
  for (const char* extension : kExtensions) {
    const auto path = dir.path() / (std::string("s") + extension);
    const long growth = test::growth_of([&] {
      const std::unique_ptr<SurfaceSink> sink = open_surface_sink(path);
      sink->begin(large_header(kBatch * kBatches / 2, kBatch * kBatches));
      const std::vector<Position> positions(kBatch / 2, {1.0 / 3, 2.0 / 3, 1e3 / 7});
      for (std::uint64_t b = 0; b < kBatches; ++b) sink->write_vertices(positions);
      std::vector<Triangle> triangles(kBatch);
      for (std::uint64_t b = 0; b < kBatches; ++b) {
        for (std::uint64_t t = 0; t < kBatch; ++t) {
          const std::uint64_t v = (b * kBatch + t) / 2;
          triangles[t] = {v, v / 2, v / 3};
        }
        sink->write_triangles(triangles);
      }
      sink->finish();
    });
    EXPECT_GE(growth, 0) << extension;
    EXPECT_LE(growth, kRoomKib) << extension;
    EXPECT_GT(std::filesystem::file_size(path), 30U << 20) << extension;
    std::filesystem::remove(path);
  }
}

TEST(AtomicFolder, AppearsWholeOrNotAtAll) {
  const TempDir dir;
  const auto target = dir.path() / "out";
  {
    const AtomicFolder folder(target);
    std::ofstream(folder.path() / "file") << "x";
    EXPECT_FALSE(std::filesystem::exists(target));
  }
  EXPECT_EQ(dir.entries(), 0U);
  for (const char* name : {"out", "slash/"}) {  // the second time over an empty folder
    std::filesystem::create_directory(dir.path() / "slash");
    AtomicFolder folder(dir.path() / name);
    std::ofstream(folder.path() / "file") << "x";
    folder.commit();
    EXPECT_EQ(content_of(dir.path() / name / "file"), "x");
  }
  EXPECT_EQ(dir.entries(), 2U);
}

TEST(AtomicFolder, RefusesWhatIsThere) {
  const TempDir dir;
  std::filesystem::create_directory(dir.path() / "full");
  dir.file("full/x", "kept");
  dir.file("file", "kept");
  for (const char* name : {"full", "file", "full/", "missing/out"}) {
    expect_error(ErrorKind::kUsage, {name}, [&] { AtomicFolder folder(dir.path() / name); });
  }
  EXPECT_EQ(content_of(dir.path() / "full/x"), "kept");
  EXPECT_EQ(dir.entries(), 2U);
}

}  // namespace
}  // namespace mw::io
