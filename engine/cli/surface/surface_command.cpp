// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh surface: where labels of a mesh, or of a volume that it meshes, meet, as triangles.
#include <iostream>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/options/file_names.h"
#include "engine/cli/options/mesh_options.h"
#include "engine/cli/requests.h"
#include "engine/cli/surface/surface_request.h"
#include "engine/cli/surface/surface_summary.h"
#include "engine/cli/surface/surface_volume.h"
#include "engine/report/mesh_facts.h"
#include "io/file/errors.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/open_mesh.h"
#include "io/surface/open_surface.h"
#include "io/surface/surface.h"

namespace mw::cli {
namespace {

/// A mesh, and what is asked about it.
class SurfaceJob {
 public:
  /// REQUIRES: all of them outlive it.
  SurfaceJob(const SurfaceRequest& request, io::GroupedMesh& mesh, SurfaceOutput& output)
      : request_(request),
        source_{mesh, io::scratch_folder(), request.shift},
        plans_(mesh, request.closed),
        labels_(io::surface_labels(mesh)),
        output_(output) {}

  void run() {
    output_.begin(unit());
    if (request_.target == SurfaceTarget::kFile) {
      write(plans_of_file(), *output_.sink(0, {}, {}), request_.output);
    } else {
      write_each();
    }
    output_.finish(labels_->names);
    print_frame();
    if (request_.target != SurfaceTarget::kFolder) summary_.print();
  }

 private:
  [[nodiscard]] std::string text_of(RawLabel label) const {
    return report::label_text(label, labels_->table.is_signed(), labels_->names);
  }

  [[nodiscard]] Label rank_of(RawLabel label) const {
    if (labels_->table.contains(label)) return labels_->table.dense(label);
    io::fail_usage(request_.input + ": the mesh has no label " +
                   io::label_text(label, labels_->table.is_signed()) + "; mwmesh info " +
                   request_.input + " lists those that it has");
  }

  /// Returns the ranks of the labels that were asked for, or of all.
  [[nodiscard]] std::vector<Label> ranks() const {
    std::vector<Label> out;
    for (const RawLabel label : request_.labels) out.push_back(rank_of(label));
    if (!out.empty()) return out;
    for (Label rank = 0; rank < labels_->table.size(); ++rank) out.push_back(rank);
    return out;
  }

  [[nodiscard]] std::vector<io::ShellPlan> plans_of_file() const {
    if (request_.pair) return plans_of_pair();
    std::vector<io::ShellPlan> plans;
    if (!request_.labels.empty()) {
      for (const Label rank : ranks()) {
        plans.push_back(plans_.of_label(rank));
        require_facets(plans.back(), "label " + text_of(labels_->table.raw(rank)));
      }
    } else if (request_.manifold) {
      plans = plans_.of_each_interface();
      require_facets(plans.empty() ? io::ShellPlan{} : plans.front(), "the mesh");
    } else {
      plans.push_back(plans_.of_interfaces());
      require_facets(plans.back(), "the mesh");
    }
    return plans;
  }

  [[nodiscard]] std::vector<io::ShellPlan> plans_of_pair() const {
    const auto& [one, other] = *request_.pair;
    io::ShellPlan plan = plans_.of_pair(rank_of(one), rank_of(other));
    if (plan.parts.empty()) {
      io::fail_usage(request_.input + ": labels " + text_of(one) + " and " + text_of(other) +
                     " share no triangle");
    }
    return {std::move(plan)};
  }

  /// Returns the unit of the mesh: what the user says, else what the mesh says, else nm.
  [[nodiscard]] std::string unit() const {
    if (!request_.unit.empty()) return request_.unit;
    const std::string& told = source_.mesh.header().record.unit;
    return told.empty() ? "nm" : told;
  }

  void print_frame() const {
    const io::MeshRecord& record = source_.mesh.header().record;
    const bool known = record.frame != io::WorldFrame::kOwn;
    std::cout << "coordinates "
              << (known ? name(record.frame) : "in a frame that the mesh does not name");
    if (request_.target == SurfaceTarget::kFolder) {
      std::cout << (unit() == record.unit ? ", in " : ", taken to be in ") << unit() << " (--unit)";
    }
    std::cout << "\n";
  }

  void require_facets(const io::ShellPlan& plan, const std::string& what) const {
    if (!plan.parts.empty()) return;
    io::fail_usage(request_.input + ": " + what +
                   " has no interfaces, as no other label is there; --labels "
                   "without --open gives a surface that closes at the box");
  }

  void write(const std::vector<io::ShellPlan>& plans, io::SurfaceSink& sink,
             const std::string& name) {
    io::Surface surface(source_, labels_, plans, request_.touching);
    if (request_.target == SurfaceTarget::kFolder) {
      surface.write(sink);
      return;
    }
    io::SurfaceFactsSink facts(sink, request_.joined, source_.folder);
    surface.write(facts);
    const bool of_labels = plans.front().label.has_value();
    summary_.add({.name = name, .facts = facts.facts(), .of_labels = of_labels});
    if (!request_.pair && request_.labels.empty() && !of_labels) summary_.note_all();
    if (plans.size() > 1 && request_.joined == io::Joined::kByPlace) summary_.note_joined();
  }

  void write_each() {
    bool any = false;
    for (const Label rank : ranks()) {
      const io::ShellPlan plan = plans_.of_label(rank);
      const RawLabel label = labels_->table.raw(rank);
      if (!request_.labels.empty()) require_facets(plan, "label " + text_of(label));
      if (plan.parts.empty()) continue;
      const std::string digits = io::label_text(label, labels_->table.is_signed());
      write({plan}, *output_.sink(label, digits, labels_->titles[rank]), text_of(label));
      any = true;
    }
    if (!any) require_facets({}, "the mesh");
  }

  const SurfaceRequest& request_;
  io::SurfaceSource source_;
  io::ShellPlans plans_;
  std::shared_ptr<const io::SurfaceLabels> labels_;
  SurfaceOutput& output_;
  SurfaceSummary summary_{source_.mesh.header().record.unit};
};

/// Returns the labels that a surface is asked of; none where it is asked of all.
std::vector<RawLabel> labels_asked(const SurfaceRequest& request) {
  if (!request.pair) return request.labels;
  return {request.pair->begin(), request.pair->end()};
}

/// Reads or makes the mesh.
void take_mesh(SurfaceFlags& flags, const SurfaceRequest& request, io::MeshSink& sink) {
  if (is_volume(flags.input)) {
    mesh_volume(flags.meshing, labels_asked(request), sink);
  } else {
    io::copy_mesh(flags.input, sink);
  }
}

void check_files(const SurfaceFlags& flags, const SurfaceRequest& request) {
  if (request.target != SurfaceTarget::kFile) return;
  FileNames files;
  if (is_volume(flags.input)) {
    files.read_volume(flags.meshing.volume);
  } else {
    files.read_mesh(flags.input);
  }
  files.write("-o", request.output);
  files.require_apart();
  if (!request.force) files.require_own();
}

int run_surface(SurfaceFlags& flags, const OptionSet& options) {
  const SurfaceRequest request = parse_surface_request(flags);
  flags.meshing.volume.path = flags.input;
  if (!is_volume(flags.input)) refuse_flags_of_volumes(options, flags.input);
  check_files(flags, request);
  const std::unique_ptr<SurfaceOutput> output = open_surface_output(request);
  io::GroupedSink grouped(io::scratch_folder(), nullptr);
  take_mesh(flags, request, grouped);
  SurfaceJob(request, grouped.mesh(), *output).run();
  return kExitDone;
}

io::LabelNames names_of_input(SurfaceFlags& flags) {
  if (!is_volume(flags.input)) return names_of(flags.input);
  flags.meshing.volume.path = flags.input;
  return request::names_of(flags.meshing.volume);
}

}  // namespace

Command surface_command() {
  const auto flags = std::make_shared<SurfaceFlags>();
  Command command{.name = "surface",
                  .about = "writes surfaces of labels, or where two of them meet",
                  .options = {},
                  .run = [flags](const OptionSet& options) { return run_surface(*flags, options); },
                  .note = mesh_note() + volume_note(),
                  .names = [flags] { return names_of_input(*flags); }};
  add_surface_options(command.options, *flags);
  return command;
}

}  // namespace mw::cli
