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
  /// wanted: by dense label.
  explicit InnerDemand(std::vector<bool> wanted) : wanted_(std::move(wanted)) {}

  [[nodiscard]] bool wants(Label label) const { return label < wanted_.size() && wanted_[label]; }

 private:
  std::vector<bool> wanted_;
};

/// False where some of a fixed vertex's labels may not be loaded.
[[nodiscard]] inline bool is_surely_inner(const TetMesh& mesh, LocalVertex v) {
  return mesh.is_free(v) && mesh.order(v) == 1;
}

/// Labels that are loaded tell it of a fixed vertex too.
[[nodiscard]] inline bool is_surely_on_boundary(const TetMesh& mesh, LocalVertex v) {
  return mesh.order(v) > 1;
}

/// Judges changes of a mesh.  Without a demand everything is allowed, at no cost.
class InnerFilter {
 public:
  /// demand: null: none.
  InnerFilter(const TetMesh& mesh, const InnerDemand* demand) : mesh_(mesh), demand_(demand) {}

  /// Contraction of (keep, drop): no tet loses its last inner vertex.  REQUIRES: both free.
  [[nodiscard]] bool allows_contraction(LocalVertex keep, LocalVertex drop) const {
    return demand_ == nullptr || keeps_inner(keep, drop);
  }
  /// New tets for old ones with the same vertices: no more of them are without an inner vertex.
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
  const SizeField* sizes = nullptr;    ///< edges keep to these limits; null: none
  const InnerDemand* inner = nullptr;  ///< inner vertices that tets keep; null: none
};

}  // namespace mw
