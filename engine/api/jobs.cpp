// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a caller's options are for the engine.
#include "engine/api/jobs.h"

#include <algorithm>

#include "engine/api/guarded.h"
#include "engine/api/types.h"
#include "engine/sample/sample_text.h"
#include "engine/settings/number_text.h"
#include "engine/settings/setting_table.h"
#include "engine/system/memory.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/labels/merged_volume.h"
#include "io/volume/open_volume.h"
#include "kernels/core/error.h"

namespace mw::api {
namespace {

engine::Certify certify_of(mwmesh::Certify certify) {
  switch (certify) {
    case mwmesh::Certify::kAuto:
      return engine::Certify::kAuto;
    case mwmesh::Certify::kOn:
      return engine::Certify::kOn;
    case mwmesh::Certify::kOff:
      return engine::Certify::kOff;
  }
  io::fail_usage("certify: is none of Certify");
}

io::Json value_json(const engine::Setting& setting, const std::string& text) {
  using Kind = engine::SettingKind;
  if (setting.kind == Kind::kChoice || setting.kind == Kind::kSizes) return text;
  if (text == "none") return nullptr;
  if (text == "auto") return text;
  return io::parse_json(text, setting.name);
}

/// Returns the images that tets get values from, which are not opened yet.
std::vector<engine::SampleImage> samples_of(const mwmesh::Options& options) {
  if (options.sample.empty()) return {};
  return naming("sample", [&] { return engine::parse_samples(options.sample); });
}

engine::ConnectOptions connect_options(const mwmesh::Options& options) {
  engine::ConnectOptions out{.open_hinges = options.open_hinges};
  out.parts = naming("parts", [&] { return engine::parse_parts(options.parts); });
  if (!options.split.empty()) {
    out.split = naming("split", [&] { return engine::parse_split(options.split); });
  }
  if (!options.cohesive.empty()) {
    out.cohesive = naming("cohesive", [&] { return engine::parse_cohesive(options.cohesive); });
  }
  return out;
}

/// Returns which labels the mesh is to have; those of an object are what its steps make of them.
engine::LabelChoice choice_of(const mwmesh::Options& options, const io::InputSteps& steps) {
  engine::LabelChoice choice = label_choice(options);
  if (!options.object.empty() && !choice.labels && !choice.background) {
    choice.labels = io::merged_labels(options.object, steps.merge);
    choice.labels_option = "--object";
  }
  return choice;
}

engine::RunHooks run_hooks(const io::VolumeInfo& labels, const mwmesh::Options& options,
                           const mwmesh::Hooks& hooks) {
  engine::RunHooks out{.threads = threads_of(options)};
  out.store.memory = memory_of(options);
  out.store.workdir = checked_path(options.workdir, "workdir");
  out.store.resume = options.resume;
  out.keep.folder = checked_path(options.keep, "keep");
  out.keep.use = options.from_kept ? engine::KeepUse::kUpdate
                 : options.resume  ? engine::KeepUse::kGoOn
                                   : engine::KeepUse::kBegin;
  if (options.keep_bytes > 0) out.keep.bytes = options.keep_bytes;
  for (const mwmesh::Box& box : options.changed) {
    const Box3 voxels = io_box(box);
    const Index3 first = io::first_number(labels);
    out.keep.changed.push_back({voxels.lo - first, voxels.hi - first});
  }
  if (hooks.progress) {
    out.progress = [&hooks](const engine::RunProgress& at) {
      hooks.progress({.done = at.done, .total = at.total, .seconds_left = at.seconds_left});
    };
  }
  return out;
}

}  // namespace

io::InputSteps input_steps(const mwmesh::Options& options, bool has_signed_labels) {
  io::InputSteps steps;
  for (const auto& [from, to] : options.merge) {
    // Signed labels come in two's complement, so the sign is that of the bits.
    const bool is_negative = has_signed_labels && static_cast<std::int64_t>(to) < 0;
    steps.merge.push_back({.from = {from}, .to = to, .to_is_negative = is_negative});
  }
  if (options.drop_specks > io::SpeckRule::kMax) {
    io::fail_usage("--drop-specks: too many voxels");
  }
  if (options.drop_specks > 0) {
    steps.specks = {.min = options.drop_specks, .diagonal = options.specks_joined_by_corners};
  }
  steps.weld = options.weld;
  return steps;
}

engine::LabelChoice label_choice(const mwmesh::Options& options) {
  engine::LabelChoice choice{.background = options.background};
  if (!options.labels.empty()) choice.labels = options.labels;
  engine::check_choice(choice);
  return choice;
}

int threads_of(const mwmesh::Options& options) {
  engine::check_threads(options.threads);
  return options.threads;
}

std::uint64_t memory_of(const mwmesh::Options& options) {
  return options.memory > 0 ? options.memory : engine::default_memory_budget();
}

engine::MeshJob mesh_job(const io::VolumeInfo& labels, const mwmesh::Settings& settings,
                         const mwmesh::Options& options, const mwmesh::Hooks& hooks) {
  if (options.resume && options.workdir.empty() && options.keep.empty()) {
    io::fail_usage("--resume: needs the --workdir or the --keep of the run that ended early");
  }
  if (options.keep.empty() && (options.from_kept || !options.changed.empty())) {
    io::fail_usage(std::string(options.from_kept ? "--from" : "--changed") +
                   ": needs the folder that a run has kept something in, name "
                   "it with --keep");
  }
  engine::MeshSettings values = mesh_settings(settings);
  std::shared_ptr<const io::LabelVolume> sizes;
  if (const std::string& image = values.sizes.rules.image; !image.empty()) {
    sizes = io::open_volume(image);
  }
  io::InputSteps steps = input_steps(options, io::has_signed_labels(labels));
  engine::LabelChoice choice = choice_of(options, steps);
  return {
      .steps = std::move(steps),
      .settings = std::move(values),
      .size_image = std::move(sizes),
      .samples = samples_of(options),
      .choice = std::move(choice),
      .ends_around_object = !options.object.empty(),
      .connect = connect_options(options),
      .finds_parts = options.report,
      .certify = certify_of(options.certify),
      .is_measured = options.report,
      .delta = options.from_kept && options.report ? engine::Delta::kIfKnown : engine::Delta::kNo,
      .folder = io::scratch_folder(),
      .run = run_hooks(labels, options, hooks),
      .takes_images = options.force,
      .stop = stop_function(hooks),
      .warn = [&hooks](const std::string& line) {
        if (hooks.warn) hooks.warn(library_words(line));
      }};
}

std::function<void()> stop_function(const mwmesh::Hooks& hooks) {
  if (!hooks.cancel) return [] {};
  return [&hooks] {
    if (!hooks.cancel()) return;
    throw mwmesh::Error(mwmesh::ErrorKind::kCancelled, "the run was cancelled");
  };
}

io::Json settings_json(const engine::MeshJob& job) {
  io::Json out = io::Json::object();
  for (const engine::Setting& setting : engine::setting_table()) {
    std::string key = setting.name;
    std::replace(key.begin(), key.end(), '-', '_');
    out[key] = value_json(setting, setting.text(job.settings));
  }
  out["threads"] = job.run.threads;
  out["memory"] = job.run.store.memory;
  out["workdir"] = job.run.store.workdir.string();
  return out;
}

}  // namespace mw::api

namespace mwmesh {

std::uint64_t bytes_of_text(std::string_view text) {
  return mw::api::guarded([&] { return mw::engine::parse_bytes(text); });
}

}  // namespace mwmesh
