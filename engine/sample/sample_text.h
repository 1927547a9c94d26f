// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text by which users ask for values of images.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/sample/image_sampler.h"

namespace mw::engine {

/// Parses "NAME=FILE" or "NAME=FILE:mean", :min, :max, :mode; several are joined by ';'.  FILE may
/// end in "#PATH", a data set in it.  A name is a letter and up to 30 letters, digits and '_'.  The
/// images are not opened.  ERRORS: mw::Error(kUsage) for another form, and for a name that is there
/// twice or is "label" or "cohesive", in small or capital letters.
[[nodiscard]] std::vector<SampleImage> parse_samples(std::string_view text);

[[nodiscard]] const char* name(Statistic statistic);

}  // namespace mw::engine
