// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What --drop-specks did.
#include "engine/report/speck_facts.h"

#include <iostream>

namespace mw::report {

io::Json specks_json(const std::optional<io::SpeckFacts>& specks) {
  if (!specks) return nullptr;
  return {
      {"components", specks->components}, {"voxels", specks->voxels}, {"rounds", specks->rounds}};
}

void print_specks(const std::optional<io::SpeckFacts>& specks) {
  if (!specks) return;
  std::cout << "specks      " << specks->components << " components of " << specks->voxels
            << " voxels took the labels around them, in " << specks->rounds << " rounds\n";
}

}  // namespace mw::report
