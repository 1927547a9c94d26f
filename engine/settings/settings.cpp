// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which settings make sense.
#include "engine/settings/settings.h"

#include <string>

#include "engine/settings/setting_table.h"

namespace mw::engine {

int largest_cell_level(const MeshSettings& s) {
  constexpr int kMaxLevel = 4;
  if (s.start == StartMesh::kDense) return 0;
  const int block = s.window / 2;
  int level = 0;
  while (level < kMaxLevel && block % (2 << level) == 0) ++level;
  return level;
}

void check(const MeshSettings& settings) {
  for (const Setting& setting : setting_table()) {
    try {
      check(setting, settings);
    } catch (const Error& error) {
      throw Error(error.kind(),
                  setting.name + " = " + setting.text(settings) + ": " + error.what());
    }
  }
}

}  // namespace mw::engine
