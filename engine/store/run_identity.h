// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the result of a run depends on, as text: a run goes on only from work with the same text.
#pragma once

#include <string>

#include "engine/settings.h"
#include "io/volume/label_volume.h"

namespace mw::engine {

/// A line "name = value" for shape, type and space of the volume and for each setting.
[[nodiscard]] std::string identity_text(const io::VolumeInfo& volume, const MeshSettings& settings);

}  // namespace mw::engine
