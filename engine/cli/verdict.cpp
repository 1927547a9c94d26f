// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From choices to what an audit takes.
#include "engine/cli/verdict.h"

#include <algorithm>

#include "kernels/core/layers.h"

namespace mw::cli {

audit::KeptLabels kept_labels(const LabelChoice& choice, const io::LabelTable& table) {
  const engine::WantedLabel wanted = wanted_labels(choice, table);
  audit::KeptLabels kept;
  for (Label label = 0; wanted && label < table.size(); ++label) {
    kept.push_back(wanted(table.raw(label)));
  }
  const bool leaves_out = std::find(kept.begin(), kept.end(), false) != kept.end();
  return leaves_out ? kept : audit::KeptLabels{};
}

audit::AuditOptions audit_options(const io::MeshPromises& promises, const io::VolumeSpace& space) {
  return {.radius_ratio_floor = promises.quality_floor,
          .count_places = promises.interfaces,
          .max_distance = promises.max_distance,
          .layers = promises.smooth ? layers_of(space.spacing) : Index3{1, 1, 1}};
}

}  // namespace mw::cli
