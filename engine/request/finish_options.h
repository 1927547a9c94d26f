// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options about what is done to a finished mesh, which mesh and convert share.
#pragma once

#include <vector>

#include "engine/connect/connect_options.h"
#include "engine/request/option_set.h"
#include "engine/sample/image_sampler.h"
#include "io/mesh/mesh_extras.h"

namespace mw::request {

/// Adds --parts, --split, --cohesive and --open-hinges.
/// REQUIRES (also below): what is written to outlives options.
void add_connect_options(OptionSet& options, engine::ConnectOptions& connect);

/// Adds --ascii, --materials, --deck and --pairs, for which only some formats have room.
void add_format_options(OptionSet& options, io::MeshExtras& extras, Listed listed);

/// Adds --sample.
void add_sample_option(OptionSet& options, std::vector<engine::SampleImage>& samples);

}  // namespace mw::request
