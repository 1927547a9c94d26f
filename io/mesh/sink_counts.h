// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What every mesh sink checks before a file gets its name.
#pragma once

#include <string_view>

#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// ERRORS: mw::Error(kInternal) when the tets written are not those the header promised.
void check_sink_counts(std::string_view file, const MeshHeader& header, std::uint64_t tets);

}  // namespace mw::io
