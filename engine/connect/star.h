// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How the tets around one vertex hang together.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kernels/core/label.h"

namespace mw::engine {

/// A tet at the vertex.
struct StarTet {
  std::array<std::uint64_t, 3> others{};  ///< its other vertices, ascending
  std::uint64_t tet = 0;                  ///< a number that the caller chooses
  RawLabel label = 0;
};

/// Two tets of a star, by their places in it.
using StarPair = std::array<std::size_t, 2>;

/// Visits the pairs of tets that share a face at the vertex, ascending by the face.
void each_star_face(std::span<const StarTet> star,
                    const std::function<void(const StarPair&)>& visit);

/// Sets of tets that were united, numbered from 0 by their first tets.
class StarSets {
 public:
  explicit StarSets(std::size_t tets);
  void unite(std::size_t one, std::size_t other);
  /// Returns the number of the set of each tet, and how many sets there are.
  [[nodiscard]] std::vector<std::size_t> numbers() const;
  [[nodiscard]] std::size_t count() const;

 private:
  [[nodiscard]] std::size_t root(std::size_t tet) const;
  std::vector<std::size_t> parent_;  ///< never larger than the tet
};

/// An edge at the vertex whose tets are several fans: two tets of different fans share no face that
/// has the edge, nor are they joined by tets that do.
struct SplitEdge {
  std::uint64_t other = 0;  ///< the end that is not the vertex
  std::vector<std::size_t> tets;
  StarPair fans{};  ///< a tet of the first fan, and one of the second
};

/// The edges of several fans, ascending by their other end.
[[nodiscard]] std::vector<SplitEdge> split_edges(std::span<const StarTet> star);

}  // namespace mw::engine
