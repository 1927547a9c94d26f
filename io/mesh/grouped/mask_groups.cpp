// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The masks of a volume as groups of the tets of its mesh.
#include "io/mesh/grouped/mask_groups.h"

#include <algorithm>
#include <set>

namespace mw::io {

std::vector<MaskGroup> mask_groups(const GroupedMesh& mesh) {
  std::vector<MaskGroup> out;
  for (const MaskLabels& mask : mesh.header().record.masks) {
    MaskGroup group{.name = mask.name, .ranks = {}};
    for (const RawLabel label : mask.labels) {
      if (mesh.table().contains(label)) group.ranks.push_back(mesh.table().dense(label));
    }
    std::sort(group.ranks.begin(), group.ranks.end());
    if (!group.ranks.empty()) out.push_back(std::move(group));
  }
  return out;
}

std::vector<std::string> mask_arrays(const MeshHeader& header) {
  std::set<std::string> taken(header.values.begin(), header.values.end());
  std::vector<std::string> out;
  for (const MaskLabels& mask : header.record.masks) {
    std::string name = std::string(kMaskNames) + mask.name;
    std::replace(name.begin(), name.end(), '/', '_');
    while (!taken.insert(name).second) name += '_';
    out.push_back(std::move(name));
  }
  return out;
}

}  // namespace mw::io
