// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Counts labels and interface triangles around edges.
#include "kernels/surface/line_edges.h"

#include "kernels/core/sort_distinct.h"

namespace mw {

std::span<const LocalVertex> LineEdges::at(const TetMesh& mesh, LocalVertex v) {
  around_.clear();
  ends_.clear();
  for (const LinkTriangle& t : mesh.star(v)) {
    for (const LocalVertex w : {t.a, t.b, t.c}) {
      if (w != mesh.infinity()) around_.push_back({w, without_side(t.label)});
    }
  }
  sort_distinct(around_);
  for (std::size_t i = 0; i + 2 < around_.size(); ++i) {
    const LocalVertex w = around_[i].end;
    if (around_[i + 2].end == w && (ends_.empty() || ends_.back() != w)) ends_.push_back(w);
  }
  return ends_;
}

bool LineEdges::is_touch(const TetMesh& mesh, LocalVertex v, LocalVertex w) {
  around_.clear();
  labels_.clear();
  for (const LinkTriangle& t : mesh.star(v)) {
    if (!t.has(w)) continue;
    const Label label = without_side(t.label);
    labels_.push_back(label);
    for (const LocalVertex x : {t.a, t.b, t.c}) {
      if (x != w) around_.push_back({x, label});
    }
  }
  // Of the two tets at a triangle inside a label one entry is left.
  sort_distinct(around_);
  sort_distinct(labels_);
  std::size_t sheets = 0;
  for (std::size_t i = 0; i + 1 < around_.size(); ++i) {
    if (around_[i].end == around_[i + 1].end) ++sheets;
  }
  return labels_.size() >= std::size_t{kLabelsOfLine} && sheets != labels_.size();
}

}  // namespace mw
