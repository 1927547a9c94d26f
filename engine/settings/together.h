// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run, and the file that it writes, may not be asked for together.
#pragma once

namespace mw::engine {

/// What is asked for.  A caller fills in what it knows; what is false breaks no rule by itself.
struct Asked {
  bool keep = false;        ///< a folder for later runs
  bool keep_bytes = false;  ///< a limit of that folder
  bool update = false;      ///< the folder of an earlier run
  bool changed = false;     ///< boxes outside of which nothing changed since the earlier run
  bool delta = false;       ///< what an edit did
  bool colour = false;      ///< the order in which windows are visited
  bool periodic = false;
  bool whole_cell = false;  ///< periodic along all axes
  bool count = false;       ///< a number of tets
  bool many = false;        ///< several processes
  bool object = false;      ///< a box that is found around an object
  bool scores = false;      ///< labels that come from probabilities or distances
  bool merge = false;
  bool interpolate = false;  ///< labels between thick slices
  bool weld = false;
  bool curves = false;    ///< curved tets
  bool doubles = false;   ///< doubled vertices
  bool pairs = false;     ///< a file of the pairs of nodes
  bool cell_job = false;  ///< a job of a cell that repeats itself
};

/// ERRORS: mw::Error(kUsage) for the first row of the table that is broken.
void check_together(const Asked& asked);

}  // namespace mw::engine
