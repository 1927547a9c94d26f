// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh of another tool, whose nodes have numbers of any kind.
#pragma once

#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Takes nodes and tets in any order, and then turns the numbers of nodes into rows.
class TaggedMesh {
 public:
  /// file is what errors call the mesh.
  explicit TaggedMesh(std::string file) : file_(std::move(file)) {}

  void add_node(std::uint64_t tag, const Position& position) { nodes_.push_back({tag, position}); }
  /// tags holds four corners, and behind them any number of nodes on edges, faces and inside.
  /// mark is the caller's, and becomes the label.  REQUIRES: tags.size() >= 4.
  void add_tet(std::span<const std::uint64_t> tags, RawLabel mark);

  [[nodiscard]] std::uint64_t node_count() const { return nodes_.size(); }
  [[nodiscard]] std::uint64_t tet_count() const { return mesh_.tets.size(); }
  /// Returns the marks, by tet.
  [[nodiscard]] std::vector<RawLabel>& marks() { return mesh_.labels; }

  /// ENSURES: rows are nodes by ascending number, without those that are in tets but are a corner
  /// of none; tets have the order in which they came.  Nothing is left here.
  /// ERRORS: mw::Error(kInput) when a tet names a node that never came, or two have one number.
  [[nodiscard]] MeshData finish();

 private:
  struct Node {
    std::uint64_t tag = 0;
    Position position{};
  };

  void sort_nodes();
  [[nodiscard]] std::uint64_t row_of(std::uint64_t tag) const;

  std::string file_;
  std::vector<Node> nodes_;
  std::vector<std::uint64_t> middles_;  ///< tags of nodes that are no corner of their tet
  MeshData mesh_;                       ///< its tets hold tags, which finish() turns into rows
};

}  // namespace mw::io
