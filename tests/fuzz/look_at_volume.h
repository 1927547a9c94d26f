// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What holds of every volume that a reader opens.
#pragma once

#include "io/volume/label_volume.h"

namespace mw::fuzz {

/// Checks the facts, and reads two corners of the volume, as a whole and row by row.
/// ERRORS: Broken; those of the reader.
void look_at(const io::LabelVolume& volume);

}  // namespace mw::fuzz
