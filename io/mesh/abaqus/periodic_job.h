// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Jobs for CalculiX whose results are the effective properties of a cell that repeats itself.
#pragma once

#include <string>
#include <string_view>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/mesh_extras.h"

namespace mw::io {

/// The set of all elements, which a job prints.
inline constexpr std::string_view kAllElements = "CELL_ELEMENTS";

/// Writes the equations between opposite faces (write_equations()), a node that is held, and a step
/// for each unit load: Deck::kPeriodic the strains xx, yy, zz, yz, xz and xy (shears by the angle,
/// so that 2 exy = 1), Deck::kConduction the gradients of temperature along x, y and z.  Each step
/// prints the stresses or the fluxes of all elements into the .dat file, whose averages over the
/// cell are a column of the effective tensor: reactions of reference nodes are no use, because
/// CalculiX has none at nodes of equations.  A comment "** CELL" has the box: its first corner and
/// its three edges.
/// ERRORS: mw::Error(kUsage) for a mesh that does not repeat itself along all axes, and those of
/// recorded_pairs(); `name` is that of the file.
void write_periodic_job(AtomicFile& file, GroupedMesh& mesh, const std::string& name, Deck deck);

}  // namespace mw::io
