// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh of another tool, whose nodes have numbers of any kind.
#include "io/mesh/tagged_mesh.h"

#include <algorithm>

#include "io/file/errors.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kDropped = ~std::uint64_t{0};

}  // namespace

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
  const std::vector<std::uint64_t> rows = kept_rows();
  for (TetRows& tet : mesh_.tets) {
    for (std::uint64_t& corner : tet) corner = rows[corner];
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (rows[i] != kDropped) mesh_.vertices.push_back(nodes_[i].position);
  }
  nodes_ = {};
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

/// By node: its row, or kDropped.  REQUIRES: nodes sorted, tets by place of nodes.
std::vector<std::uint64_t> TaggedMesh::kept_rows() {
  std::vector<std::uint64_t> rows(nodes_.size(), 0);
  for (const std::uint64_t tag : middles_) rows[row_of(tag)] = kDropped;
  middles_ = {};
  for (const TetRows& tet : mesh_.tets) {
    for (const std::uint64_t corner : tet) rows[corner] = 0;
  }
  std::uint64_t next = 0;
  for (std::uint64_t& row : rows) {
    if (row != kDropped) row = next++;
  }
  return rows;
}

}  // namespace mw::io
