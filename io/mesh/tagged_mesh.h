// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh of another tool, whose nodes have numbers of any kind.
#pragma once

#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Nodes and tets in any order; then rows.
class TaggedMesh {
 public:
  /// file: what errors call it.
  explicit TaggedMesh(std::string file) : file_(std::move(file)) {}

  void add_node(std::uint64_t tag, const Position& position) { nodes_.push_back({tag, position}); }
  /// tags: four corners, behind them any number of nodes on edges, faces and inside.
  /// mark: of the caller; it becomes the label.  REQUIRES: tags.size() >= 4.
  void add_tet(std::span<const std::uint64_t> tags, RawLabel mark);

  [[nodiscard]] std::uint64_t node_count() const { return nodes_.size(); }
  [[nodiscard]] std::uint64_t tet_count() const { return mesh_.tets.size(); }
  /// By tet.
  [[nodiscard]] std::vector<RawLabel>& marks() { return mesh_.labels; }

  /// ENSURES: rows are nodes by number, without those that are in tets but are a corner of none;
  /// tets as they came.  Nothing is left here.
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
  std::vector<std::uint64_t> middles_;  ///< tags
  MeshData mesh_;                       ///< tets have tags for rows until finish()
};

}  // namespace mw::io
