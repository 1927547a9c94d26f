// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the result of a run depends on, as text: a run goes on only from work with the same text.
#pragma once

#include <string>

#include "engine/settings/settings.h"
#include "io/volume/label_volume.h"

namespace mw::engine {

/// A line "name = value" for shape, type and space of the volume and for each entry of
/// setting_table().  The caller adds what it knows of the program and the labels (StoreOptions):
/// mwmesh its version, and a fingerprint of the labels after --crop, --merge and --drop-specks.
///
/// Not part of it, since the tets of the work folder are the same: which labels are written, how,
/// with which names and nodes; threads, memory and how often work is saved.  Nor is the program
/// that triangulates for Optimizer::kTetgen: it is built with this one and of its version, and
/// who names another (MW_CODT_WORKER) between two parts of a run gets the tets of both.
[[nodiscard]] std::string identity_text(const io::VolumeInfo& volume, const MeshSettings& settings);

}  // namespace mw::engine
