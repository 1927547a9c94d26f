// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Blocks become one.
#pragma once

#include <vector>

#include "kernels/mesh/block_mesh.h"

namespace mw {

/// Merges blocks into one, canonically.
/// REQUIRES: canonical blocks; copies of a vertex are equal.
/// ENSURES: a function of the content alone, not of the order of the blocks.
/// Memory: the result, and once more its longest list.
[[nodiscard]] BlockMesh merge_blocks(std::vector<BlockMesh> blocks);

/// The canonical order of a block's samples, with those of one face on one triangle joined.
/// vertices: the number of the block's vertices, which the samples' triangles are rows of.
void make_canonical(std::vector<BlockSample>& samples, std::size_t vertices);

}  // namespace mw
