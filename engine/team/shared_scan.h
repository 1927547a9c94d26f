// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The first pass over a volume, shared by the processes of a run.
#pragma once

#include "engine/labels/fingerprint.h"
#include "engine/team/team.h"
#include "io/labels/label_table.h"

namespace mw::engine {

/// collect_labels() by all ranks, each its part; the volume then has the fingerprint of all of it.
/// No rank sees all labels, so two of them look at a piece of each part: the volumes of a run must
/// be one.  It guards against mistakes.
/// ERRORS: kUsage when they differ there; what the volume throws; of several ranks every one tells
/// that of the first, so that of
///         voxels that are no labels it is the first in the file.
[[nodiscard]] io::LabelTable collect_together(Team& team, FingerprintVolume& volume, int threads);

}  // namespace mw::engine
