// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Area and bends of interfaces by the definition: maps of all triangles and edges.
#pragma once

#include <vector>

#include "kernels/audit/subject.h"

namespace mw::audit::test {

struct Bend {
  double degrees = 0;
  double length = 0;
};

/// Interfaces of a mesh of positive tets.
struct InterfaceBends {
  std::size_t triangles = 0;
  double area = 0;
  std::vector<Bend> bends;  ///< ascending

  /// The least bend up to which this share of the length lies.
  [[nodiscard]] double percentile(double share) const;
  /// The share of the length that bends by more than this.
  [[nodiscard]] double share_above(double degrees) const;
};

[[nodiscard]] InterfaceBends interface_bends(const AuditMesh& mesh);

}  // namespace mw::audit::test
