// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The report of a run of `mwmesh mesh` (--report); the documentation fixes its keys.
#pragma once

#include <filesystem>
#include <functional>

#include "engine/connect/connect_options.h"
#include "engine/report/mesh_facts.h"
#include "engine/report/resource_meter.h"
#include "engine/run/run.h"
#include "engine/sample/sample_text.h"
#include "io/file/sink/atomic_file.h"
#include "io/json/json.h"
#include "io/labels/despeckled_volume.h"
#include "io/labels/welded_volume.h"
#include "kernels/audit/audit.h"
#include "kernels/audit/shape/volumes.h"

namespace mw::report {

/// What was done for SizeSettings::count.
struct CountFacts {
  std::uint64_t asked = 0;
  double scale = 1.0;          ///< of all sizes
  std::uint64_t expected = 0;  ///< tets that the pilot found at that scale; 0: an earlier run did
  bool is_least = false;       ///< fewer cannot be had
  bool is_most = false;        ///< more cannot be had
  int trials = 0;              ///< meshes that the pilot made; 0: an earlier run made them
  std::int64_t voxels = 0;     ///< that they had in all
  double seconds = 0.0;        ///< wall
};

/// What a run knows when its mesh has been written.
struct FinishedRun {
  io::VolumeInfo volume;
  io::LabelTable labels;
  engine::SizeSettings sizes;  ///< as they were kept to, after scaling
  std::optional<CountFacts> count;
  std::optional<io::SpeckFacts> specks;
  std::optional<io::WeldFacts> welds;
  std::vector<engine::SampleFacts> samples;
  engine::RunReport engine;
  double labels_seconds = 0;  ///< reading the volume once for its labels
  Resources resources;        ///< times until the mesh was written, memory until its digest
  std::string digest;         ///< empty: it was not made
  std::string fingerprint;    ///< of the labels
  std::optional<audit::AuditReport> certificate;  ///< empty: none was made
  std::optional<io::Json> delta;                  ///< delta_json() (engine/job/volume_delta.h)
  std::optional<engine::ConnectFacts> connected;  ///< empty: nobody counted, or nobody could
  double radius_ratio_floor = 0;                  ///< of the tets that were written
  std::string why_no_certificate;
  std::string why_no_volumes;  ///< empty: the run promises volumes of labels (P8)
};

/// Vertices of a mesh per corner of the volume's voxels.
[[nodiscard]] double vertex_fraction(std::uint64_t vertices, Index3 shape);

/// The report without its rows of labels (kRows stands for them).
/// REQUIRES: run.engine.quality and volumes.
[[nodiscard]] io::Json run_report(const FinishedRun& run, const std::filesystem::path& mesh,
                                  io::Json settings);

/// Calls visit on each label that was written, ascending.  REQUIRES: run.engine's volumes.
void for_each_volume(const FinishedRun& run,
                     const std::function<void(const audit::VolumeRow&)>& visit);

/// Figures that were not measured are null.  Memory: it does not grow with the labels.
/// REQUIRES: run.engine.quality and volumes.
void append_run_report(const FinishedRun& run, const std::filesystem::path& mesh, io::Json settings,
                       const AppendText& append);

/// Writes that report into a file, which then gets its name.
void write_run_report(io::AtomicFile& file, const FinishedRun& run,
                      const std::filesystem::path& mesh, io::Json settings);

}  // namespace mw::report
