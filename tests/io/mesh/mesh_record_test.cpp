// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Records come back to the bit, through text and through every format that keeps them.
#include "io/mesh/mesh_record.h"

#include <cmath>
#include <random>

#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/read_back.h"
#include "tests/io/mesh/sample_mesh.h"

namespace mw::io {
namespace {

/// Numbers of all sizes.
MeshRecord random_record(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto number = [&] {
    return std::ldexp(static_cast<double>(random()) - 0x1p63, static_cast<int>(random() % 80) - 90);
  };
  MeshRecord record;
  if (seed % 4 != 0) {
    record.box.emplace();
    for (double& x : record.box->origin) x = number();
    for (Position& edge : record.box->edges) {
      for (double& x : edge) x = number();
    }
  }
  record.frame = std::array{WorldFrame::kOwn, WorldFrame::kRas, WorldFrame::kLps}[seed / 3 % 3];
  const std::vector<RawLabel> labels{random(), random() % 9, ~RawLabel{0} - random() % 9};
  if (seed % 5 == 1) record.only_labels = labels;
  if (seed % 5 == 2) record.without_labels = labels;
  if (seed % 3 == 0) return record;
  record.promises = MeshPromises{.quality_floor = std::abs(number()),
                                 .interfaces = random() % 2 == 0,
                                 .smooth = random() % 2 == 0,
                                 .optimised = random() % 2 == 0};
  if (random() % 2 == 0) record.promises->max_distance = std::abs(number());
  return record;
}

TEST(MeshRecord, ComesBackThroughText) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const MeshRecord record = random_record(seed);
    const std::string text = record_text(record);
    EXPECT_EQ(parse_record(text, "m"), record) << text;
    EXPECT_EQ(text.empty(), record == MeshRecord{});
  }
}

TEST(MeshRecord, ComesBackThroughFilesAndIsNoPartOfTheDigest) {
  const TempDir dir;
  MeshData mesh = sample_mesh(20, false);
  const std::string digest = mesh_digest(mesh);
  for (unsigned seed = 1; seed < 6; ++seed) {
    mesh.record = random_record(seed);
    mesh.names = seed % 2 == 0 ? LabelNames() : LabelNames({{1, "a", {}}});
    for (const char* name : {"m.vtkhdf", "m.vtu", "m.mesh", "m.xdmf"}) {
      write_mesh(mesh, *open_mesh_sink(dir.path() / name));
      const MeshData back = read_back(dir.path() / name);
      EXPECT_EQ(back.record, mesh.record) << name;
      EXPECT_EQ(back.names.rows().size(), mesh.names.rows().size()) << name;
      EXPECT_EQ(mesh_digest(back), digest) << name;
    }
  }
}

TEST(MeshRecord, DamageIsTold) {
  for (const char* text :
       {"{", "[]", R"({"box": 3})", R"({"box": {"origin": [0, 0]}})",
        R"({"box": {"origin": [0, 0, 0], "x": [0, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}})",
        R"({"promises": {"quality_floor": -1}})", R"({"promises": {"quality_floor": "x"}})",
        R"({"promises": {"max_distance": -1, "quality_floor": 0.1}})",
        R"({"promises": {"quality_floor": 0.1, "topology": 5}})",
        R"({"promises": {"quality_floor": 0.1, "topology": "all", "surface": "voxel"}})",
        R"({"promises": {"quality_floor": 0.1, "topology": "labels", "surface": "none"}})",
        R"({"promises": {"quality_floor": 0.1, "topology": "labels", "surface": "voxel",
                         "optimizer": "local"}})",
        R"({"without_labels": [0.5]})", R"({"frame": "own"})", R"({"frame": 1})",
        R"({"only_labels": 0})", R"({"only_labels": [1], "without_labels": [2]})"}) {
    expect_error(ErrorKind::kInput, {"m.vtu"},
                 [&] { static_cast<void>(parse_record(text, "m.vtu")); });
  }
}

}  // namespace
}  // namespace mw::io
