// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Leaves labels out of what is written (--labels, --background).
#pragma once

#include <functional>
#include <vector>

#include "io/labels/label_table.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// Which labels are written; empty means all.
using WantedLabel = std::function<bool(RawLabel)>;

class LabelSelection {
 public:
  LabelSelection(const WantedLabel& wanted, const io::LabelTable& table);

  /// Whether a label is written.
  [[nodiscard]] bool keeps(Label label) const { return wanted_.empty() || wanted_[label]; }

  /// Drops the tets of other labels, and the vertices that no tet references any more.  Samples
  /// are dropped.  ENSURES: canonical when it was.
  void apply(BlockMesh& block) const;

 private:
  std::vector<bool> wanted_;  ///< by dense label; empty: all
};

}  // namespace mw::engine
