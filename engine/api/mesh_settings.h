// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a caller's settings are for the engine.
#pragma once

#include "engine/mwmesh.h"
#include "engine/settings/settings.h"

namespace mw::api {

/// ERRORS: mw::Error(kUsage).
[[nodiscard]] engine::MeshSettings mesh_settings(const mwmesh::Settings& settings);

}  // namespace mw::api
