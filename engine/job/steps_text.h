// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run did with the labels of its volume, as text for the folder of --keep.
#pragma once

#include <string>

#include "io/labels/prepared_input.h"

namespace mw::engine {

/// Returns a line for each rule of a merge, for specks and for what is welded.
[[nodiscard]] std::string text_of(const io::InputSteps& steps);
/// Returns the steps that text_of() made these lines of.  ERRORS: DamagedWork.
[[nodiscard]] io::InputSteps steps_of(const std::string& text);

}  // namespace mw::engine
