// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The longest edge of each label's tets, block by block.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "io/mesh/mesh_sink.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// Memory: 8 bytes a label.  Cost: about 10 ns a tet.
class LongestEdges {
 public:
  explicit LongestEdges(std::size_t labels) : squared_(labels, 0.0) {}

  /// positions: of the block's rows.
  void add(std::span<const BlockTet> tets, std::span<const io::Position> positions) {
    for (const BlockTet& t : tets) {
      double& longest = squared_[t.label];
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
          longest = std::max(longest, squared(positions[t.vertices[i]], positions[t.vertices[j]]));
        }
      }
    }
  }

  /// Squares of lengths(), so far.
  [[nodiscard]] std::vector<double>& squares() { return squared_; }
  /// By dense label; 0 where there is no tet.
  [[nodiscard]] std::vector<double> lengths() const {
    std::vector<double> out = squared_;
    for (double& length : out) length = std::sqrt(length);
    return out;
  }

 private:
  static double squared(const io::Position& a, const io::Position& b) {
    const double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2];
    return x * x + y * y + z * z;
  }

  std::vector<double> squared_;
};

}  // namespace mw::engine
