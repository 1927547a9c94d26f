// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Input to output: the samples of the input's interface, each carried by one interface triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "kernels/core/face_sample.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Local vertices of a triangle, ascending.
using TriangleKey = std::array<LocalVertex, 3>;

[[nodiscard]] inline TriangleKey triangle_key(LocalVertex a, LocalVertex b, LocalVertex c) {
  TriangleKey key{a, b, c};
  std::sort(key.begin(), key.end());
  return key;
}

/// The samples of a window by triangle.  The table behind it is looked up, never iterated.
class CarriedSamples {
 public:
  struct List {
    Label side = 0;  ///< the smaller label at the triangle
    std::vector<FaceSample> samples;
  };

  [[nodiscard]] bool empty() const { return lists_.empty(); }

  void add(const TriangleKey& key, Label side, FaceSample sample) {
    List& list = lists_[key];
    list.side = side;
    list.samples.push_back(sample);
  }

  /// The list of a triangle; null when it carries none.
  [[nodiscard]] const List* find(const TriangleKey& key) const {
    const auto found = lists_.find(key);
    return found == lists_.end() ? nullptr : &found->second;
  }

  void erase(const TriangleKey& key) { lists_.erase(key); }

 private:
  struct Hash {
    std::size_t operator()(const TriangleKey& key) const {
      constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ULL;
      std::uint64_t h = (std::uint64_t{key[0]} << 32 | key[1]) * kOdd;
      h = (h ^ h >> 29 ^ key[2]) * kOdd;
      return static_cast<std::size_t>(h ^ h >> 32);
    }
  };

  std::unordered_map<TriangleKey, List, Hash> lists_;
};

}  // namespace mw
