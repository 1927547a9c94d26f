// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The tets of a finished mesh get values from images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "engine/sample/image_sampler.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::engine {

/// Adds a value of each image of the sampler to each tet, behind those that it has.  Tets that lie
/// near one another are looked at together, in whichever order the mesh has them.  Calls
/// between(), which may throw, often.
/// Memory: bytes_to_sample().  Disk: 48 bytes a tet, and twice 8 for each value.
/// ERRORS: those of ImageSampler and ScratchMesh.
void sample(io::ScratchMesh& mesh, ImageSampler& sampler, std::size_t sort_bytes,
            const std::function<void()>& between);

/// Returns the most bytes that sample() holds beside the mesh.
[[nodiscard]] std::uint64_t bytes_to_sample(const ImageSampler& sampler, std::size_t sort_bytes);

}  // namespace mw::engine
