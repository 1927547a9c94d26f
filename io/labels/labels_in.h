// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels a part of a volume has.
#pragma once

#include <vector>

#include "io/volume/label_volume.h"

namespace mw::io {

/// The labels of a box of the volume, in no particular order: one pass in the order of the file, in
/// slabs of bounded memory.
[[nodiscard]] std::vector<RawLabel> labels_in(const LabelVolume& volume, const Box3& box);

}  // namespace mw::io
