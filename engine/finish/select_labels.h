// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels of a finished mesh are left out.
#pragma once

#include <functional>

#include "engine/output/label_selection.h"
#include "io/labels/label_table.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::engine {

/// Returns the labels of the tets.
[[nodiscard]] io::LabelTable labels_of(io::ScratchMesh& mesh);

/// Leaves the tets of the other labels out, and then the vertices that no tet has.  What stays
/// keeps its order, and the record tells what is gone.  Calls between(), which may throw, often.
/// Memory: a mesh's buffers, a quarter of a byte a vertex, and that of LabelSet.
/// Disk: that of the mesh once more.
/// ERRORS: those of wanted_labels() and ScratchMesh.
void select_labels(io::ScratchMesh& mesh, const LabelChoice& choice,
                   const std::function<void()>& between);

}  // namespace mw::engine
