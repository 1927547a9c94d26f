// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The verdict on a mesh that is looked at as a whole, as tiles together have to give it.
#pragma once

#include "kernels/audit/audit.h"

namespace mw::audit::test {

/// label_count: size of the label table; the volume's labels are below it.
/// Errors: kInput for an unusable volume; whatever is wrong with the mesh is a failed check.
[[nodiscard]] AuditReport audit(const VoxelLabels& volume, std::size_t label_count,
                                const AuditMesh& mesh, const Frame& frame,
                                const AuditOptions& options = {});

}  // namespace mw::audit::test
