// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh held against its volume, with what the user asks.
#pragma once

#include "engine/cli/verify_report.h"
#include "engine/verify/verify_mesh.h"

namespace mw::cli {

/// The labels that a mesh is to hold; empty when all are.
[[nodiscard]] audit::KeptLabels kept_labels(const LabelChoice& choice, const io::LabelTable& table);

/// What the bounds ask, without the labels that are kept.
[[nodiscard]] audit::AuditOptions audit_options(const io::MeshPromises& promises,
                                                const io::VolumeSpace& space);

}  // namespace mw::cli
