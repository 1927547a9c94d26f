// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh of another tool, whose nodes have numbers of any kind.
#include "io/mesh/tagged_mesh.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/mesh/kept_rows.h"

namespace mw::io {
void TaggedMesh::add_tet(std::span<const std::uint64_t> tags, RawLabel mark) {
  mesh_.tets.push_back({tags[0], tags[1], tags[2], tags[3]});
  mesh_.labels.push_back(mark);
  middles_.insert(middles_.end(), tags.begin() + 4, tags.end());
}

MeshData TaggedMesh::finish() {
  sort_nodes();
  for (TetRows& tet : mesh_.tets) {
    for (std::uint64_t& corner : tet) corner = row_of(corner);
  }
  KeptRows middles(nodes_.size());
  for (const std::uint64_t tag : middles_) middles.middle(row_of(tag));
  middles_ = {};
  mesh_.vertices.reserve(nodes_.size());
  for (const Node& node : nodes_) mesh_.vertices.push_back(node.position);
  nodes_ = {};
  drop_middles(mesh_, middles);
  return std::move(mesh_);
}

void TaggedMesh::sort_nodes() {
  const auto comes_before = [](const Node& a, const Node& b) { return a.tag < b.tag; };
  std::sort(nodes_.begin(), nodes_.end(), comes_before);
  const auto twice = std::adjacent_find(
      nodes_.begin(), nodes_.end(), [](const Node& a, const Node& b) { return a.tag == b.tag; });
  if (twice == nodes_.end()) return;
  fail_input(file_, "nodes", text("number ", twice->tag, " is there twice"),
             "save the mesh as one part, each node with a number of its own");
}

std::uint64_t TaggedMesh::row_of(std::uint64_t tag) const {
  const auto found =
      std::lower_bound(nodes_.begin(), nodes_.end(), tag,
                       [](const Node& node, std::uint64_t wanted) { return node.tag < wanted; });
  if (found != nodes_.end() && found->tag == tag) {
    return static_cast<std::uint64_t>(found - nodes_.begin());
  }
  fail_input(file_, "elements", text("one names node ", tag, ", which is not in the file"),
             "write the mesh anew");
}

}  // namespace mw::io
