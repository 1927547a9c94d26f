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
    List& list = lists_[pack(key)];
    list.side = side;
    list.samples.push_back(sample);
  }

  /// The list of a triangle; null when it carries none.
  [[nodiscard]] const List* find(const TriangleKey& key) const {
    const auto found = lists_.find(pack(key));
    return found == lists_.end() ? nullptr : &found->second;
  }

  void erase(const TriangleKey& key) { lists_.erase(pack(key)); }

 private:
  /// Three local vertices of 21 bits each.
  [[nodiscard]] static std::uint64_t pack(const TriangleKey& key) {
    return std::uint64_t{key[0]} << 42 | std::uint64_t{key[1]} << 21 | key[2];
  }
  struct Mix {
    std::size_t operator()(std::uint64_t key) const {
      key *= 0x9E3779B97F4A7C15ULL;
      return static_cast<std::size_t>(key ^ key >> 29);
    }
  };

  std::unordered_map<std::uint64_t, List, Mix> lists_;
};

}  // namespace mw
