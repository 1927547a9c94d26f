// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The few labels of a tile under numbers of their own.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "kernels/audit/regions/regions.h"
#include "kernels/audit/subject.h"
#include "kernels/audit/topology/junctions.h"
#include "kernels/audit/topology/part_graph.h"
#include "kernels/core/sort_distinct.h"

namespace mw::engine {

/// The dense labels of the whole volume that a tile has, ascending; the tile's own label is the
/// rank.  What a tile keeps by label then has its size, not that of the volume's table.
class TileLabels {
 public:
  /// label_count is that of the whole; numbers from there on in `seen` are no labels.
  TileLabels(std::vector<Label> seen, std::size_t label_count) : whole_(std::move(seen)) {
    sort_distinct(whole_);
    whole_.erase(std::lower_bound(whole_.begin(), whole_.end(), label_count), whole_.end());
    exterior_ = static_cast<Label>(label_count);
  }

  [[nodiscard]] std::size_t size() const { return whole_.size(); }
  [[nodiscard]] const std::vector<Label>& whole() const { return whole_; }

  /// Returns the tile's own label; audit::kUnknown for what is no label.  REQUIRES: it was seen.
  [[nodiscard]] Label own(Label label) const {
    if (label >= exterior_) return audit::kUnknown;
    return static_cast<Label>(std::lower_bound(whole_.begin(), whole_.end(), label) -
                              whole_.begin());
  }
  /// Makes labels the tile's own, in place; neighbours mostly have the same.
  void make_own(std::span<Label> labels) const {
    Label last = audit::kUnknown, rank = audit::kUnknown;
    for (Label& label : labels) {
      if (label != last) rank = own(last = label);
      label = rank;
    }
  }
  /// Returns by own label what is given by label of the whole; an empty list stays empty.
  [[nodiscard]] std::vector<bool> own(const std::vector<bool>& by_label) const {
    std::vector<bool> out;
    for (const Label label : whole_) {
      if (!by_label.empty()) out.push_back(by_label[label]);
    }
    return out;
  }
  /// Returns the label of the whole; the two numbers behind the last label (the exterior, and what
  /// is no label) become the two behind the last label of the whole.
  [[nodiscard]] Label of_whole(Label own) const {
    return own < whole_.size() ? whole_[own] : exterior_ + (own - static_cast<Label>(size()));
  }
  void to_whole(audit::PartsPiece& piece) const {
    for (Label& label : piece.part_class) label = of_whole(label);
    for (audit::ClassCells& cells : piece.cells) cells.label = of_whole(cells.label);
  }
  void to_whole(audit::RegionsPiece& piece) const {
    for (audit::RegionTally& tally : piece.tallies) tally.label = of_whole(tally.label);
    for (audit::OpenSet& set : piece.open) set.label = of_whole(set.label);
  }
  void to_whole(audit::JunctionsPiece& piece) const {
    for (audit::JunctionTally& tally : piece.tallies) {
      for (Label& label : tally.labels) {
        if (label != audit::kNoLabel) label = of_whole(label);
      }
    }
  }

 private:
  std::vector<Label> whole_;
  Label exterior_ = 0;
};

/// Appends every label of a list, once for each run of equal entries.
inline void append_labels(std::span<const Label> labels, std::vector<Label>& seen) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (i == 0 || labels[i] != labels[i - 1]) seen.push_back(labels[i]);
  }
}

}  // namespace mw::engine
