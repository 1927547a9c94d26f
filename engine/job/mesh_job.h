// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The main job, from an opened volume to a mesh in a sink: what the program and the library share.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/connect/connect_options.h"
#include "engine/output/label_selection.h"
#include "engine/report/run_report.h"
#include "engine/run/run.h"
#include "engine/sample/image_sampler.h"
#include "io/labels/prepared_input.h"

namespace mw::engine {

enum class Certify {
  kAuto,  ///< certifies where memory allows it, unless divided or updating (KeepUse::kUpdate)
  kOn,
  kOff,
};

/// Whether to tell what changed since the run that is updated.
enum class Delta {
  kNo,
  kIfKnown,  ///< tells it unless no run was complete in the folder
  kOn,
};

struct MeshJob {
  io::InputSteps steps;
  MeshSettings settings;
  std::shared_ptr<const io::LabelVolume> size_image;  ///< SizeRules::image, opened
  std::vector<SampleImage> samples;                   ///< opened; their values go with the mesh
  bool leaves_values_out = false;  ///< whether they are looked for, and not written
  bool is_curved = false;          ///< whether it is written with curved tets
  LabelChoice choice;
  /// Whether the volume ends around an object (io::OpenOptions::object), so that an edit may change
  /// its box.
  bool ends_around_object = false;
  ConnectOptions connect;  ///< what is left out of the mesh, and doubled in it, when it is written
  bool finds_parts = false;  ///< whether parts and hinges are counted where the mesh stays as it is
  bool finds_volumes = false;  ///< whether tets and volumes of labels are measured
  bool finds_quality = false;  ///< whether shapes of tets are measured
  Certify certify = Certify::kAuto;
  bool is_measured = false;  ///< whether interfaces are measured, too, for a report
  Delta delta = Delta::kNo;
  std::filesystem::path folder;  ///< of temporary files
  /// Threads, memory, work folder, other processes and callbacks.  mesh() sets what is written and
  /// the identity of the run.
  RunHooks run{.threads = 0};
  bool takes_images = false;  ///< whether grey values are meshed as labels (TextureVolume)
  /// These five do not change the result.
  std::function<void()> stop = [] {};                    ///< called often, by any thread; may throw
  std::function<void(const std::string& line)> warn;     ///< optional; called before marches
  std::function<void(std::size_t labels)> labels_known;  ///< optional; called before marches
  std::function<void()> delivered;  ///< optional; called when all of the mesh is in the sinks
  /// Optional; given FinishedRun::delta while the folder still has the labels before, so that the
  /// same job tells it again where this throws.
  std::function<void(const io::Json& delta)> tell;
};

/// What a certificate takes of a run's memory budget, which is a quarter at most.
struct CertificatePlan {
  std::string why_not;  ///< empty if it is made
  int threads = 0;
  int readers = 1;                 ///< of each thread (VerifyTask::readers)
  std::uint64_t reader_bytes = 0;  ///< of each of them, if there are several; see reader_bytes()
  std::uint64_t memory_bytes = 0;  ///< of all together
};

/// reader_bytes is that of the volume.  ERRORS: mw::Error(kUsage) when it is asked for and cannot
/// be had.
[[nodiscard]] CertificatePlan plan_certificate(const MeshJob& job, std::uint64_t reader_bytes = 0);

/// Meshes a volume; once the mesh is finished, each sink gets it from begin to finish, one after
/// the other.  A certificate is made before, of the mesh before parts are left out and vertices
/// doubled.
/// ENSURES: promises P1 to P3 and P5 of the README.  The digest is the caller's to add.
/// ERRORS: those of the volume, its steps, mesh_volume() and the sinks; kUsage for a volume that
///         looks like an image, unless the job takes one; kCheckFailed when the
///         certificate does not hold; io::fail_input_changed() when that is because the labels
///         changed, or when a later reading finds labels that the first did not; what the job's
///         functions throw.
[[nodiscard]] report::FinishedRun mesh(const io::LabelVolume& opened, const MeshJob& job,
                                       std::span<io::MeshSink* const> sinks);

}  // namespace mw::engine
