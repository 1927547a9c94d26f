// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The steps one over the other.
#include "io/labels/prepared_input.h"

namespace mw::io {

PreparedInput::PreparedInput(const LabelVolume& opened, const InputSteps& steps,
                             const SpeckLimits& limits)
    : volume_(&opened) {
  if (!steps.merge.empty()) volume_ = &merged_.emplace(*volume_, steps.merge);
  if (steps.specks) volume_ = &despeckled_.emplace(*volume_, *steps.specks, limits);
}

}  // namespace mw::io
