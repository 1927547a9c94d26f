// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Counts cells and components of junctions where labels meet.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "kernels/audit/topology/junctions.h"
#include "kernels/audit/topology/part_graph.h"
#include "kernels/core/disjoint_sets.h"

namespace mw::audit {

/// The vertices that a tile has to do with, by row.
struct JunctionVertices {
  std::vector<bool> owned;
  std::vector<bool> shared;        ///< other tiles have it too; true for all not owned
  std::vector<std::uint64_t> ids;  ///< ids in the whole, ascending

  [[nodiscard]] std::size_t count() const { return ids.size(); }
};

/// Collects the cells of the junctions of one kind.  Labels are ascending and distinct.
class JunctionCounter {
 public:
  /// REQUIRES: vertices outlive this.
  explicit JunctionCounter(const JunctionVertices& vertices) : vertices_(vertices) {}

  /// Vertices and edges may be added again; faces, which have two labels, may not.
  /// REQUIRES: the tile owns v, and the face; v < w.
  void add_vertex(const JunctionLabels& junction, std::uint64_t v);
  void add_edge(const JunctionLabels& junction, std::uint64_t v, std::uint64_t w);
  void add_face(const JunctionLabels& pair);

  /// Adds all junctions to the piece, ascending.
  void take(JunctionKind kind, JunctionsPiece& out);

 private:
  static constexpr std::size_t kFirstLimit = std::size_t{1} << 16;

  struct Link {
    std::uint64_t a = 0;
    std::uint64_t b = 0;
    friend auto operator<=>(const Link&, const Link&) = default;
  };

  [[nodiscard]] std::uint64_t id(const JunctionLabels& junction);
  [[nodiscard]] std::uint64_t node(const JunctionLabels& junction, std::uint64_t v) {
    return id(junction) * vertices_.count() + v;
  }
  /// Finds the connected sets of all nodes, which ascend, and counts vertices and edges.
  [[nodiscard]] DisjointSets link(const std::vector<std::uint64_t>& nodes);

  const JunctionVertices& vertices_;
  std::map<JunctionLabels, std::uint64_t> ids_;
  JunctionLabels last_junction_{};  ///< what id() was asked for last
  std::uint64_t last_id_ = 0;
  DistinctList<std::uint64_t> nodes_{kFirstLimit};  ///< vertices in junctions
  DistinctList<Link> links_{kFirstLimit};
  std::vector<std::int64_t> euler_;  ///< by id
};

/// The two kinds of junctions of a tile, fed by cells with all labels around them.
class JunctionSweep {
 public:
  explicit JunctionSweep(JunctionVertices vertices) : vertices_(std::move(vertices)) {}
  JunctionSweep(const JunctionSweep&) = delete;
  JunctionSweep& operator=(const JunctionSweep&) = delete;

  [[nodiscard]] bool owns(std::uint64_t v) const { return vertices_.owned[v]; }

  /// Adds a vertex or an edge.  All whose smaller vertex the tile owns must be added.
  /// REQUIRES: labels are ascending and distinct; a single one adds nothing.
  void add_vertex(std::span<const Label> labels, std::uint64_t v);
  void add_edge(std::span<const Label> labels, std::uint64_t v, std::uint64_t w);
  /// Adds a face, by vertices in cyclic order.  All with a vertex that the tile owns must be added.
  void add_face(std::span<const Label> labels, std::span<const std::uint64_t> vertices);

  [[nodiscard]] JunctionsPiece take();

 private:
  JunctionVertices vertices_;
  JunctionCounter interfaces_{vertices_};
  JunctionCounter meetings_{vertices_};
};

}  // namespace mw::audit
