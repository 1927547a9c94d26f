// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels a mesh holds (--labels, --background).
#pragma once

#include "engine/cli/option_set.h"
#include "engine/output/label_choice.h"

namespace mw::cli {

using engine::LabelChoice;

/// --labels and --background.
void add_choice_options(OptionSet& options, LabelChoice& choice);

}  // namespace mw::cli
