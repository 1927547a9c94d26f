// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The report of a run of `mwmesh mesh` (--report); the documentation fixes its keys.
#pragma once

#include <filesystem>
#include <functional>

#include "engine/connect/connect_options.h"
#include "engine/finish/finish_task.h"
#include "engine/report/mesh_facts.h"
#include "engine/run/run.h"
#include "engine/sample/sample_text.h"
#include "engine/system/stages.h"
#include "engine/system/stopwatch.h"
#include "io/file/sink/atomic_file.h"
#include "io/json/json.h"
#include "io/labels/specks.h"
#include "io/labels/welded_volume.h"
#include "kernels/audit/audit.h"
#include "kernels/audit/shape/volumes.h"

namespace mw::report {

/// What was done for SizeSettings::count.
struct CountFacts {
  std::uint64_t asked = 0;
  double scale = 1.0;          ///< the factor on all sizes
  std::uint64_t expected = 0;  ///< tets that the pilot found at that scale; 0: an earlier run did
  bool is_least = false;       ///< fewer cannot be had
  bool is_most = false;        ///< more cannot be had
  /// Whether a mesh that misses the number is made again: the factor was found on parts of the
  /// volume, and not yet by two meshes of the whole.
  bool may_be_off = false;
  double earlier_scale = 0;        ///< of the mesh that missed last; 0: none did
  std::uint64_t earlier_tets = 0;  ///< of that mesh
  /// Labels that are written and have no size, while others or interfaces have one.  An image
  /// of sizes is taken to reach all labels.
  std::uint64_t labels_without_size = 0;
  /// Meshes that the pilot made, and one that missed the number; 0 if an earlier run made them.
  int trials = 0;
  std::int64_t voxels = 0;  ///< voxels of these meshes in all
  double seconds = 0.0;     ///< on the clock
};

/// Voxels of an image of sizes that ask for less than can be had, and got the least instead.
struct RaisedSizes {
  std::uint64_t voxels = 0;
  double least = 0.0;
};

/// What a run knows when its mesh has been written.
struct FinishedRun {
  io::VolumeInfo volume;
  io::LabelTable labels;
  engine::MeshSettings settings;  ///< as they were asked for, sizes in physical units
  engine::LabelChoice choice;     ///< which labels are written
  bool leaves_out_zero = false;   ///< since names say that label 0 is nothing
  bool has_scores = false;        ///< whether labels come from probabilities or distances
  engine::SizeSettings sizes;     ///< those that the run kept to, after scaling
  std::optional<CountFacts> count;
  RaisedSizes raised;
  std::optional<io::SpeckFacts> specks;
  std::optional<io::SliceFacts> slices;
  std::optional<io::WeldFacts> welds;
  std::vector<engine::SampleFacts> samples;
  engine::RunReport engine;
  double labels_seconds = 0;              ///< reading the volume once for its labels
  std::vector<engine::StageCost> stages;  ///< empty where the process is not the run's own
  engine::Resources resources;  ///< times until the mesh was written, memory until its digest
  std::string digest;           ///< empty if it was not made
  std::string fingerprint;      ///< of the labels
  std::optional<audit::AuditReport> certificate;  ///< empty if none was made
  std::optional<engine::EdgeFigures> edges;       ///< empty if no size was asked for
  std::optional<engine::LabelAmounts> amounts;    ///< empty if not measured
  std::optional<engine::MeshFigures> figures;     ///< empty if not measured
  std::optional<io::Json> delta;                  ///< delta_json() (engine/job/volume_delta.h)
  std::optional<engine::ConnectFacts> connected;  ///< empty if not counted
  double radius_ratio_floor = 0;                  ///< of the tets that were written
  std::string why_no_certificate;
  std::string why_no_volumes;  ///< empty if the run promises volumes of labels (P8)

  /// Takes what passes found over to where it belongs.
  void take(const engine::FinishFacts& facts);
};

/// The most labels that are listed beside their number.
inline constexpr std::uint64_t kMostFirstLabels = 6;

/// Returns the vertices of a mesh per corner of the volume's voxels.
[[nodiscard]] double vertex_fraction(std::uint64_t vertices, Index3 shape);

/// Returns the report without its rows of labels (kRows stands for them).  Figures that were not
/// measured are null.
[[nodiscard]] io::Json run_report(const FinishedRun& run, const std::filesystem::path& mesh,
                                  io::Json settings);

/// Calls visit on each label that was written, ascending.  REQUIRES: run.amounts.
void for_each_volume(const FinishedRun& run,
                     const std::function<void(const audit::VolumeRow&)>& visit);

/// Appends the report.  Memory does not grow with labels.
/// REQUIRES: run.amounts and run.figures, with the shape.
void append_run_report(const FinishedRun& run, const std::filesystem::path& mesh, io::Json settings,
                       const AppendText& append);

/// Writes that report into a file, which then gets its name.
void write_run_report(io::AtomicFile& file, const FinishedRun& run,
                      const std::filesystem::path& mesh, io::Json settings);

}  // namespace mw::report
