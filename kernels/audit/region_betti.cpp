// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh as one tile.
#include "kernels/audit/region_betti.h"

#include "kernels/audit/regions.h"

namespace mw::audit {

std::vector<RegionBetti> region_betti(const AuditMesh& mesh, std::size_t label_count) {
  RegionsUnion regions(label_count);
  regions.add(regions_of(MeshStars(mesh), label_count));
  return regions.betti();
}

}  // namespace mw::audit
