// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Leaves labels out of what is written.
#include "engine/output/label_selection.h"

namespace mw::engine {

LabelSelection::LabelSelection(const WantedLabel& wanted, const io::LabelTable& table) {
  if (!wanted) return;
  for (std::size_t label = 0; label < table.size(); ++label) {
    wanted_.push_back(wanted(table.raw(static_cast<Label>(label))));
  }
}

void LabelSelection::apply(BlockMesh& block) const {
  if (wanted_.empty()) return;
  block.samples.clear();
  std::erase_if(block.tets, [&](const BlockTet& t) { return !wanted_[t.label]; });
  std::vector<bool> used(block.vertices.size());
  for (const BlockTet& t : block.tets) {
    for (const std::uint32_t v : t.vertices) used[v] = true;
  }
  std::vector<std::uint32_t> row(used.size());
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    row[v] = kept;
    if (used[v]) block.vertices[kept++] = block.vertices[v];
  }
  block.vertices.resize(kept);
  for (BlockTet& t : block.tets) {
    for (std::uint32_t& v : t.vertices) v = row[v];
  }
}

}  // namespace mw::engine
