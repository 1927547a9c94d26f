// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which stars lie in boxes that other calls have seen, or will see.
#pragma once

#include <vector>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Returns whether all loaded tets at a vertex lie in one of the boxes; sides count as inside.
[[nodiscard]] bool star_is_in_one(const TetMesh& mesh, LocalVertex v,
                                  const std::vector<LatticeBox>& boxes);

/// The vertices that have nothing left to do: those whose stars lie in one of the boxes, which
/// earlier calls have finished, and that have not changed in this window.
class FinishedVertices {
 public:
  FinishedVertices(const TetMesh& mesh, const std::vector<LatticeBox>& boxes);

  [[nodiscard]] bool has(LocalVertex v) const { return !finished_.empty() && finished_[v] != 0; }

 private:
  std::vector<std::uint8_t> finished_;  ///< empty when there are no boxes
};

}  // namespace mw
