// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets that should have a vertex inside their label, and changes that would take it from them.
#pragma once

#include <span>
#include <vector>

#include "kernels/mesh/tet_mesh.h"
#include "kernels/size/size_field.h"

namespace mw {

/// Labels whose tets should each have an inner vertex: one on no interface and not on the box.
/// (Linear tets without one lock when such a label is bent.)
class InnerDemand {
 public:
  /// wanted has an entry for each dense label.
  explicit InnerDemand(std::vector<bool> wanted) : wanted_(std::move(wanted)) {}

  [[nodiscard]] bool wants(Label sided) const {
    const Label label = without_side(sided);
    return label < wanted_.size() && wanted_[label];
  }

 private:
  std::vector<bool> wanted_;
};

/// True if v is known to be inner; not known of a fixed vertex, whose labels may not all be loaded.
[[nodiscard]] inline bool is_surely_inner(const TetMesh& mesh, LocalVertex v) {
  return mesh.is_free(v) && mesh.order(v) == 1;
}

/// True if v is known to be on a boundary; loaded labels can tell it of a fixed vertex too.
[[nodiscard]] inline bool is_surely_on_boundary(const TetMesh& mesh, LocalVertex v) {
  return mesh.order(v) > 1;
}

/// Judges changes of a mesh.  Without a demand everything is allowed, at no cost.
class InnerFilter {
 public:
  /// demand may be null, which means none.
  InnerFilter(const TetMesh& mesh, const InnerDemand* demand) : mesh_(mesh), demand_(demand) {}

  /// True if contracting (keep, drop) takes no tet's last inner vertex.  REQUIRES: both free.
  [[nodiscard]] bool allows_contraction(LocalVertex keep, LocalVertex drop) const {
    return demand_ == nullptr || keeps_inner(keep, drop);
  }
  /// True if no more new tets lack an inner vertex than old ones, whose vertices they have.
  [[nodiscard]] bool allows_replacement(std::span<const LocalTet> old_tets,
                                        std::span<const LocalTet> new_tets) const {
    return demand_ == nullptr || lacks_no_more(old_tets, new_tets);
  }

 private:
  [[nodiscard]] bool keeps_inner(LocalVertex keep, LocalVertex drop) const;
  [[nodiscard]] bool lacks_no_more(std::span<const LocalTet> old_tets,
                                   std::span<const LocalTet> new_tets) const;

  const TetMesh& mesh_;
  const InnerDemand* demand_;
};

struct TetDemands {
  const SizeField* sizes = nullptr;    ///< limits that edges keep to; null means none
  const InnerDemand* inner = nullptr;  ///< inner vertices that tets keep; null means none
};

}  // namespace mw
