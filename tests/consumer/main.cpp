// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A program of somebody else: writes its voxels to a file and prints the digest of their mesh.
#include <mwmesh.h>

#include <fstream>
#include <iostream>

namespace {

constexpr mwmesh::Index kShape{24, 20, 16};

/// Two balls that touch, one of them in a slab.
std::vector<std::uint8_t> voxels() {
  std::vector<std::uint8_t> out;
  for (int z = 0; z < kShape[2]; ++z) {
    for (int y = 0; y < kShape[1]; ++y) {
      for (int x = 0; x < kShape[0]; ++x) {
        const auto is_near = [&](int cx, int r) {
          return (x - cx) * (x - cx) + (y - 10) * (y - 10) + (z - 8) * (z - 8) < r * r;
        };
        const int outside = z < 6 ? 3 : 0;
        out.push_back(static_cast<std::uint8_t>(is_near(7, 5) ? 1 : is_near(16, 5) ? 2 : outside));
      }
    }
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::vector<std::uint8_t> labels = voxels();
  std::ofstream file(argv[1], std::ios::binary);
  file.write(reinterpret_cast<const char*>(labels.data()),
             static_cast<std::streamsize>(labels.size()));
  try {
    const auto volume = mwmesh::Volume::of(mwmesh::ArrayVolume{
        .data = labels.data(), .type = mwmesh::VoxelType::kU8, .shape = kShape});
    std::cout << mwmesh::mesh(volume, {{"optimizer", argv[2]}}).digest() << '\n';
  } catch (const mwmesh::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.kind());
  }
}
