// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/output/block_figures.h"

#include <utility>

namespace mw::engine {
namespace {

Int128 volume6_of(const BlockMesh& block, const BlockTet& tet) {
  const auto at = [&](std::size_t i) { return block.vertices[tet.vertices[i]].position; };
  const Int128 volume = volume6(at(0), at(1), at(2), at(3));
  return volume < 0 ? -volume : volume;
}

}  // namespace

BlockFigures::BlockFigures(const OutputOptions& options, std::size_t labels)
    : has_volumes(options.measure_shape) {
  if (options.measure_quality) quality.emplace();
  if (options.measure_edges) edges.emplace(labels, options.edge_sizes);
  if (has_volumes) volumes6.resize(labels);
}

void BlockFigures::add(const WrittenBlock& block, const audit::QualityMeter& shape,
                       std::uint64_t first_tet) {
  if (quality) quality->add(shape, first_tet);
  if (edges) edges->add(block.block.tets, block.positions);
  if (!has_volumes) return;
  for (const BlockTet& tet : block.block.tets) volumes6[tet.label] += volume6_of(block.block, tet);
}

void BlockFigures::report(FinishedMesh& out) {
  if (quality) out.quality = quality->report();
  if (edges) {
    out.longest_edges = edges->lengths();
    out.edge_ratios = edges->ratios();
  }
  out.label_volumes6 = std::move(volumes6);
}

}  // namespace mw::engine
