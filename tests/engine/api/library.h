// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Small volumes for tests of the library, and what it throws.
#pragma once

#include "engine/mwmesh.h"
#include "tests/testing.h"

namespace mwmesh::test {

inline constexpr Index kShape{22, 18, 20};

inline std::vector<std::uint64_t> grains() {
  return synth("voronoi", kShape, 6, 3);
}

inline Volume volume_of(const std::vector<std::uint64_t>& labels, const Index& shape = kShape) {
  return Volume::of(ArrayVolume{.data = labels.data(), .type = VoxelType::kU64, .shape = shape});
}

/// Checks the kind of what work() throws; returns the message.
template <class Work>
std::string failure(ErrorKind kind, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    EXPECT_EQ(std::string(error.what()).find("--"), std::string::npos) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace mwmesh::test
