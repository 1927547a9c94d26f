// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// INRIMAGE-4 files, byte by byte.
#include "tests/io/volume/damaged_files.h"

namespace mw::io {
namespace {

constexpr Index3 kShape{5, 4, 3};

/// The header, filled with line feeds up to whole blocks.
std::string header(const std::string& type, int bits, const std::string& more,
                   std::size_t blocks = 1) {
  std::string out = "#INRIMAGE-4#{\nXDIM=5\nYDIM=4\nZDIM=3\nVDIM=1\nTYPE=" + type +
                    "\nPIXSIZE=" + std::to_string(bits) + " bits\nSCALE=2**0\n" + more;
  out.resize(256 * blocks - 4, '\n');
  return out + "##}\n";
}

TEST(Inr, EveryTypeByteOrderAndLengthOfHeader) {
  const TempDir dir;
  for (const VoxelType type : kAllTypes) {
    const auto labels = sample_labels(kShape, type);
    for (const char* cpu : {"pc", "decm", "sun", "sgi"}) {
      const bool big = cpu[0] == 's';
      for (const std::size_t blocks : {1U, 2U, 5U}) {
        const std::string file =
            header(is_signed(type) ? "signed fixed" : "unsigned fixed", 8 * byte_size(type),
                   std::string("CPU=") + cpu + "\n", blocks) +
            voxel_bytes(labels, type, big) + "behind";
        for (const bool packed : {false, true}) {
          const auto volume = open_volume(dir.file("a.inr", packed ? gzip(file) : file));
          EXPECT_EQ(volume->info().format, "inr");
          EXPECT_EQ(volume->info().type, type);
          expect_boxes(*volume, labels, 1, 5);
        }
      }
    }
  }
}

TEST(Inr, SpacingAndFirstCorner) {
  const TempDir dir;
  const auto path =
      dir.file("a.inr", header("unsigned fixed", 8, "VX=0.5\nVY=2\nVZ=3e0\nTX=-1\nTY=2.5\nTZ=7\n") +
                            std::string(60, 'a'));
  const VolumeSpace space = open_volume(path)->info().space;
  EXPECT_EQ(space.spacing, (Vector3{0.5, 2, 3}));
  EXPECT_EQ(space.origin, (Vector3{-1, 2.5, 7}));
}

TEST(Inr, WhatIsWrongIsNamed) {
  const TempDir dir;
  const auto refuse = [&](const std::string& content, std::vector<std::string> pieces) {
    const auto path = dir.file("a.inr", content);
    pieces.push_back(path.string());
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(open_volume(path)); });
  };
  const std::string data(60, 'a');
  refuse("something", {"inr magic"});
  refuse(header("unsigned fixed", 8, "").substr(0, 200), {"inr header", "##}"});
  refuse(header("unsigned fixed", 8, "") + "short", {"60 bytes", "holds 5"});
  refuse(header("unsigned fixed", 12, "") + data, {"PIXSIZE", "12 bits"});
  refuse(header("packed", 8, "") + data, {"TYPE", "packed"});
  refuse(header("float", 16, "") + data, {"TYPE", "float"});
  refuse(header("unsigned fixed", 16, "CPU=vax\n") + data, {"CPU", "vax"});
  refuse(header("unsigned fixed", 16, "") + data, {"CPU", "missing"});
  refuse(header("unsigned fixed", 8, "VDIM=3\n") + data, {"VDIM", "3 numbers"});
  refuse(header("unsigned fixed", 8, "SCALE=2**3\n") + data, {"SCALE"});
  refuse(header("unsigned fixed", 8, "ZDIM=0\n") + data, {"inr size", "(z)"});
  refuse(header("unsigned fixed", 8, "VY=nan\n") + data, {"VX", "(y)", "--spacing"});
  refuse(header("unsigned fixed", 8, "TX=inf\n") + data, {"TX", "--origin"});
  refuse(header("unsigned fixed", 8, "VX=one\n") + data, {"VX", "no number"});
}

TEST(Inr, DamagedFilesAreReadOrRefused) {
  const TempDir dir;
  damage_everywhere(dir, "a.inr",
                    header("signed fixed", 16, "CPU=sun\nVX=1\nTX=2\n") + std::string(120, '\1'));
}

}  // namespace
}  // namespace mw::io
