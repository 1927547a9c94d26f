// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels a mesh holds.
#include "engine/cli/label_choice.h"

#include "engine/cli/values.h"

namespace mw::cli {

void add_choice_options(OptionSet& options, LabelChoice& choice) {
  options.add({.name = "labels",
               .value = "LIST",
               .help = "labels of the mesh, e.g. 1,2,5; others are meshed but left out of it",
               .kind = ValueKind::kLabels,
               .assign = [&](const std::string& text) { choice.labels = parse_labels(text); }});
  options.add({.name = "background",
               .value = "L",
               .help = "label that is meshed but left out of the mesh",
               .kind = ValueKind::kLabels,
               .assign = [&](const std::string& text) { choice.background = parse_label(text); }});
}

}  // namespace mw::cli
