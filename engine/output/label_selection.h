// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels a mesh holds (--labels, --background): the others are left out of what is written.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "io/labels/label_table.h"
#include "io/names/label_names.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// Which labels are written; empty means all.
using WantedLabel = std::function<bool(RawLabel)>;

class LabelSelection {
 public:
  LabelSelection(const WantedLabel& wanted, const io::LabelTable& table);

  /// True if a label is written.
  [[nodiscard]] bool keeps(Label label) const { return wanted_.empty() || wanted_[label]; }

  /// Drops the tets of other labels, and the vertices that no tet references any more.  Samples
  /// are dropped.  ENSURES: canonical when it was.
  void apply(BlockMesh& block) const;

 private:
  std::vector<bool> wanted_;  ///< by dense label; empty if all are written
};

struct LabelChoice {
  std::optional<std::vector<RawLabel>> labels;  ///< the only ones that are kept
  std::optional<RawLabel> background;           ///< the only one that is left out
  bool keeps_zero = false;                      ///< also where names say that 0 is nothing
  const char* labels_option = "--labels";       ///< what errors about `labels` name

  /// True if somebody said what is written.
  [[nodiscard]] bool any() const { return labels || background || keeps_zero; }
};

/// ERRORS: mw::Error(kUsage) when both are given.
void check_choice(const LabelChoice& choice);

/// Returns whether the names say that label 0 is nothing: it is called background or the like, or
/// it has no name and all other labels of the volume have one.  False where there is no other
/// label.
[[nodiscard]] bool is_zero_nothing(const io::LabelTable& table, const io::LabelNames& names);

/// Returns which labels are kept; empty when all are.
/// ERRORS: mw::Error(kUsage) for a label that the volume does not have, and when none is kept.
[[nodiscard]] WantedLabel wanted_labels(const LabelChoice& choice, const io::LabelTable& table);

}  // namespace mw::engine
