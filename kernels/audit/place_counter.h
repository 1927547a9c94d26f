// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Counts cells and components of places where labels meet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "kernels/audit/part_graph.h"
#include "kernels/audit/places.h"

namespace mw::audit {

/// Cavities (b2) by pair of labels, where there are any.
using Cavities = std::map<PlaceLabels, std::int64_t>;

/// b2 of every interface: by Alexander duality in the 3-sphere, the components of the part graph
/// without the pairs of parts that bear these two labels, less one.
[[nodiscard]] Cavities cavities_of_interfaces(std::span<const Label> part_class,
                                              const std::vector<PartPair>& face_pairs);

/// A list that is given the same values again and again.  Memory: at most twice the distinct ones,
/// or kFirstLimit if that is more.
template <class T>
class DistinctList {
 public:
  void add(const T& value) {
    if (values_.size() == limit_) compact();
    values_.push_back(value);
  }
  /// Ascending.
  [[nodiscard]] const std::vector<T>& sorted() {
    compact();
    return values_;
  }

 private:
  static constexpr std::size_t kFirstLimit = std::size_t{1} << 20;

  void compact() {
    std::sort(values_.begin(), values_.end());
    values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
    limit_ = std::max(kFirstLimit, 2 * values_.size());
  }

  std::vector<T> values_;
  std::size_t limit_ = kFirstLimit;
};

/// Collects the cells of the places of one kind.  Labels are ascending and distinct.
class PlaceCounter {
 public:
  /// Vertices are below vertex_count.
  explicit PlaceCounter(std::uint64_t vertex_count) : vertex_count_(vertex_count) {}

  /// Vertices and edges may come again; faces, of two labels, may not.
  void add_vertex(const PlaceLabels& place, std::uint64_t v);
  void add_edge(const PlaceLabels& place, std::uint64_t v, std::uint64_t w);
  void add_face(const PlaceLabels& pair);

  /// Betti numbers of all places; with b2 given, b1 follows from the Euler characteristic.
  [[nodiscard]] std::vector<PlaceBetti> take(const Cavities& cavities);

 private:
  struct Link {
    std::uint64_t a = 0;
    std::uint64_t b = 0;
    friend auto operator<=>(const Link&, const Link&) = default;
  };

  [[nodiscard]] std::uint64_t id(const PlaceLabels& place);
  [[nodiscard]] std::uint64_t node(const PlaceLabels& place, std::uint64_t v) {
    return id(place) * vertex_count_ + v;
  }
  void count_cells();

  std::uint64_t vertex_count_;
  std::map<PlaceLabels, std::uint64_t> ids_;
  PlaceLabels last_place_{};  ///< what id() was asked for last
  std::uint64_t last_id_ = 0;
  DistinctList<std::uint64_t> nodes_;  ///< a vertex in a place
  DistinctList<Link> links_;
  std::vector<std::int64_t> euler_, components_;  ///< by id
};

/// The two kinds of places, fed by cells with all labels around them.
class PlaceSweep {
 public:
  explicit PlaceSweep(std::uint64_t vertex_count)
      : interfaces_(vertex_count), meetings_(vertex_count) {}

  /// Labels ascending, distinct; nothing happens for a single one.
  void add_vertex(std::span<const Label> labels, std::uint64_t v);
  void add_edge(std::span<const Label> labels, std::uint64_t v, std::uint64_t w);
  /// A face with its vertices in cyclic order.
  void add_face(std::span<const Label> labels, std::span<const std::uint64_t> vertices);

  [[nodiscard]] Places take(const Cavities& cavities);

 private:
  PlaceCounter interfaces_;
  PlaceCounter meetings_;
};

}  // namespace mw::audit
