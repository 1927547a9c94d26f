// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a caller's options are for the engine.
#pragma once

#include "engine/job/mesh_job.h"
#include "engine/mwmesh.h"
#include "engine/settings/settings.h"
#include "io/json/json.h"

namespace mw::api {

/// ERRORS: mw::Error(kUsage).
[[nodiscard]] engine::MeshSettings mesh_settings(const mwmesh::Settings& settings);
/// has_signed_labels tells of the volume.  ERRORS: mw::Error(kUsage).
[[nodiscard]] io::InputSteps input_steps(const mwmesh::Options& options, bool has_signed_labels);
/// ERRORS: mw::Error(kUsage).
[[nodiscard]] engine::LabelChoice label_choice(const mwmesh::Options& options);
/// ERRORS: mw::Error(kUsage).
[[nodiscard]] int threads_of(const mwmesh::Options& options);
/// Returns the memory budget in bytes, which is the default unless the options give one.
[[nodiscard]] std::uint64_t memory_of(const mwmesh::Options& options);
/// Returns what to do with a volume of such labels.  hooks outlives the result.
/// ERRORS: mw::Error(kUsage).
[[nodiscard]] engine::MeshJob mesh_job(const io::VolumeInfo& labels,
                                       const mwmesh::Settings& settings,
                                       const mwmesh::Options& options, const mwmesh::Hooks& hooks);
/// Throws mwmesh::Error(kCancelled) when the caller cancels.  hooks outlives the result.
[[nodiscard]] std::function<void()> stop_function(const mwmesh::Hooks& hooks);
/// Returns settings and options as reports tell them.
[[nodiscard]] io::Json settings_json(const engine::MeshJob& job);

}  // namespace mw::api
