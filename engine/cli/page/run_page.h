// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The page of a run (--html): one file for a browser, which needs no network.
#pragma once

#include "engine/report/run_report.h"
#include "io/json/json.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::cli {

/// Writes the page and gives the file its name.  The page holds figures, charts, pictures, and the
/// surfaces of the largest labels (ViewData), and says what it leaves out.  It takes 20 MB at most,
/// and nothing in it asks a network.
/// REQUIRES: report is run_report(run); mesh is the one that the run wrote.
/// Memory: beside the mesh's lists 80 MiB (samples of a picture, then the triangles of the view),
/// and 40 bytes a label.  ERRORS: those of file and mesh.
void write_run_page(io::AtomicFile& file, const report::FinishedRun& run, io::GroupedMesh& mesh,
                    const io::Json& report);

}  // namespace mw::cli
