// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options and requests (engine/request/) and the words of reports, as commands call them.
#pragma once

#include "engine/report/figures.h"
#include "engine/request/finish_options.h"
#include "engine/request/mesh_request.h"
#include "engine/request/option_set.h"
#include "engine/request/shared_options.h"
#include "engine/request/values.h"
#include "engine/request/volume_options.h"

namespace mw::cli {

using report::format_bytes;
using report::format_figure;
using report::format_fixed;
using report::format_percent;
using report::format_volume;
using report::short_number;
using report::told;
using report::with_commas;
using namespace request;  // NOLINT(google-build-using-namespace): commands are made of its words

}  // namespace mw::cli
