// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where volumes of callers lie.
#pragma once

#include "engine/mwmesh_c.h"
#include "io/volume/volume_space.h"

namespace mw::api {

/// space may be null: edges of 1 from 0 on.
/// ERRORS: mw::Error(kUsage) for lengths and angles that make no sense.
[[nodiscard]] io::VolumeSpace io_space(const mw_space* space);
/// Fills *out, whose texts are those of space, which must stay.
void tell_space(const io::VolumeSpace& space, mw_space* out);

}  // namespace mw::api
