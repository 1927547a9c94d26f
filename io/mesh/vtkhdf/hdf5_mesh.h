// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What readers of meshes in HDF5 files share.
#pragma once

#include <filesystem>
#include <functional>

#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/kept_rows.h"
#include "io/mesh/vtkhdf/hdf5_array.h"

namespace mw::io {

/// ERRORS: mw::Error(kInput) when it is missing, damaged or no HDF5 file.
[[nodiscard]] Hdf5Handle open_hdf5(const std::string& file);

/// Runs read in a child, since damage makes the library crash, and passes on to sink what it
/// writes.  bytes: of all files that it reads, by which its time is bounded.
/// ERRORS: those of read and of sink; mw::Error(kInput) naming the file when the child died.
void read_hdf5_apart(const std::string& file, std::uint64_t bytes,
                     const std::function<void(MeshSink&)>& read, MeshSink& sink);

/// Writes points in batches; those that stay.  kept: null when all do.
/// REQUIRES: 3 components.  ERRORS: mw::Error(kInput) when there are fewer, or one is not finite.
void stream_points(const Hdf5Array& points, RowRange range, const KeptRows* kept, MeshSink& sink);

/// Fills out with labels from row `first` on.  REQUIRES: integers of 1 component.
void read_labels(const Hdf5Array& labels, std::uint64_t first, std::vector<RawLabel>& out);

}  // namespace mw::io
