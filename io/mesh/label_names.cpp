// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which cell array of another tool's file is the label.
#include "io/mesh/label_names.h"

#include <algorithm>

namespace mw::io {

const std::string* choose_label(const std::vector<std::string>& names) {
  for (const char* known : {"label", "Label", "labels", "material", "medit:ref"}) {
    const auto found = std::find(names.begin(), names.end(), known);
    if (found != names.end()) return &*found;
  }
  return names.size() == 1 ? &names.front() : nullptr;
}

}  // namespace mw::io
