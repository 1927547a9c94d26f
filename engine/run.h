// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The library's face: a volume and settings in, a mesh and a report out.
#pragma once

#include <functional>

#include "engine/finish.h"
#include "engine/march.h"
#include "engine/settings.h"
#include "io/labels/label_table.h"
#include "io/mesh/mesh_sink.h"
#include "kernels/optimise/optimise.h"
#include "kernels/simplify/simplify.h"

namespace mw::engine {

/// What a run did.  Times are wall seconds.
struct RunReport {
  std::uint64_t windows = 0;
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  SimplifyStats simplify;
  OptimiseStats optimise;
  double prepare_seconds = 0.0;  ///< labels: reading, coarsening, large cells
  double start_seconds = 0.0;
  double simplify_seconds = 0.0;
  double optimise_seconds = 0.0;
  double exchange_seconds = 0.0;  ///< gather and scatter
  double output_seconds = 0.0;
  std::optional<audit::QualityReport> quality;  ///< when the hooks ask for it
};

/// Called after each window with the number done and the total; may throw to stop the run.
using OnProgress = std::function<void(std::uint64_t done, std::uint64_t total)>;

struct RunHooks {
  OnProgress progress;  ///< optional
  PickReady pick;       ///< order among ready windows; empty: raster (the result is the same)
  OutputOptions output;
};

/// Meshes the whole box of the volume into `sink`.
/// ENSURES: promises P1 to P3 and P5 of the README.
/// ERRORS: whatever volume and sink throw; kUsage for bad settings.
RunReport mesh_volume(const io::DenseVolume& volume, const MeshSettings& settings,
                      io::MeshSink& sink, const RunHooks& hooks = {});

}  // namespace mw::engine
