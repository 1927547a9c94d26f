// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The page of a run (--html): one file for a browser, which needs no network; its parts that come
// from the report, and files that are part of the program (CMakeLists.txt turns them into strings).
#pragma once

#include <string>

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

// Each takes the report of a run (run_report) and gives HTML.

/// Returns the title, the inputs, and the figures that matter first.
[[nodiscard]] std::string head_section(const io::Json& report);
/// Returns which of P1 to P8 the run itself has seen to hold or not, and how to check the others.
[[nodiscard]] std::string promise_section(const io::Json& report);
/// Returns where time and memory went.
[[nodiscard]] std::string engine_section(const io::Json& report);
/// Returns all settings and the digest.
[[nodiscard]] std::string settings_section(const io::Json& report);

/// Returns the command that checks the mesh, with the options of the run that the check needs.
[[nodiscard]] std::string verify_command(const io::Json& report);

extern const char* const kPageStyle;   ///< page.css
extern const char* const kPageScript;  ///< viewer.js

}  // namespace mw::cli
