// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What mwmesh surface is asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/cli/options/option_set.h"
#include "io/surface/precomputed/mesh_folder.h"
#include "kernels/core/label.h"

namespace mw::cli {

/// What was asked for; empty where it was not given.
struct SurfaceFlags {
  std::filesystem::path mesh;
  std::string output;
  std::vector<RawLabel> labels;
  std::optional<std::array<RawLabel, 2>> pair;
  std::string format;
  std::string unit;
  bool each = false;
  bool manifold = false;
  bool open = false;
};

enum class SurfaceTarget {
  kFile,      ///< all surfaces in one file
  kEachFile,  ///< one file for each label, with `{label}` in the path
  kFolder,    ///< precomputed meshes
};

struct SurfaceRequest {
  std::string mesh;
  std::string output;
  SurfaceTarget target = SurfaceTarget::kFile;
  io::MeshFolderOptions folder;  ///< with kFolder; its unit is not known before the mesh is
  std::string unit;              ///< with kFolder: of the mesh; empty: as the mesh says
  std::vector<RawLabel> labels;  ///< labels with a surface each; if empty, all, or the interfaces
  std::optional<std::array<RawLabel, 2>> pair;
  bool manifold = false;
  bool closed = true;
};

/// REQUIRES: flags outlives options.
void add_surface_options(OptionSet& options, SurfaceFlags& flags);

/// ERRORS: mw::Error(kUsage) for values that contradict each other, or that cannot be written.
[[nodiscard]] SurfaceRequest parse_surface_request(const SurfaceFlags& flags);

}  // namespace mw::cli
