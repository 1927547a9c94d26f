// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces in every format there is.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "io/surface/surface_facts.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// Returns the extensions that are written, as ".stl, .ply, .obj, .vtp".
[[nodiscard]] std::string surface_extensions();
[[nodiscard]] bool is_surface_path(const std::filesystem::path& path);

/// What a format asks of surfaces.
struct SurfaceTraits {
  Joined joined = Joined::kByNumber;  ///< what readers take for one vertex
  bool is_printed = false;            ///< whether printers get it, so that it had best be manifold
};
/// REQUIRES: is_surface_path(path).
[[nodiscard]] SurfaceTraits surface_traits(const std::filesystem::path& path);

/// Opens the sink for a path's extension.
/// ERRORS: mw::Error(kUsage) for one that is not known, or a path that cannot be written.
[[nodiscard]] std::unique_ptr<SurfaceSink> open_surface_sink(const std::filesystem::path& path);

}  // namespace mw::io
