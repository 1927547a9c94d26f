// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces in every format there is.
// Format: https://www.loc.gov/preservation/digital/formats/fdd/fdd000505.shtml (.stl)
// Format: https://www.loc.gov/preservation/digital/formats/fdd/fdd000501.shtml (.ply)
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "io/surface/surface_sink.h"

namespace mw::io {

/// Returns the extensions that are written, as ".stl, .ply".
[[nodiscard]] std::string surface_extensions();
[[nodiscard]] bool is_surface_path(const std::filesystem::path& path);

/// Opens the sink for a path's extension.
/// ERRORS: mw::Error(kUsage) for one that is not known, or a path that cannot be written.
[[nodiscard]] std::unique_ptr<SurfaceSink> open_surface_sink(const std::filesystem::path& path);

}  // namespace mw::io
