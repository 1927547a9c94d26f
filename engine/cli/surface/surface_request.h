// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What mwmesh surface is asked for, and where its surfaces go: one file, one a label, or a folder
// of precomputed meshes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/cli/requests.h"
#include "io/surface/precomputed/mesh_folder.h"
#include "io/surface/surface.h"
#include "io/surface/surface_facts.h"
#include "kernels/core/label.h"

namespace mw::cli {

/// What was asked for; empty where it was not given.
struct SurfaceFlags {
  std::filesystem::path input;
  MeshRequest meshing;  ///< of an input that is a volume
  std::string output;
  std::vector<RawLabel> labels;
  std::optional<std::array<RawLabel, 2>> pair;
  std::string format;
  std::string unit;
  bool each = false;
  std::optional<io::Position> shift;
  std::optional<bool> manifold;
  bool open = false;
  bool force = false;
};

enum class SurfaceTarget {
  kFile,      ///< all surfaces in one file
  kEachFile,  ///< one file for each label, with `{label}` or `{name}` in the path
  kFolder,    ///< precomputed meshes
};

struct SurfaceRequest {
  std::string input;  ///< a mesh, or a volume
  std::string output;
  SurfaceTarget target = SurfaceTarget::kFile;
  io::MeshFolderOptions folder;  ///< with kFolder; its unit is not known before the mesh is
  std::string unit;              ///< with kFolder: of the mesh; empty: as the mesh says
  std::vector<RawLabel> labels;  ///< labels with a surface each; if empty, all, or the interfaces
  std::optional<std::array<RawLabel, 2>> pair;
  io::Position shift{};  ///< is taken off all coordinates
  bool force = false;    ///< whether it may replace files of others
  bool manifold = false;
  io::Touching touching = io::Touching::kJoined;
  io::Joined joined = io::Joined::kByNumber;  ///< with files: what their readers join
  bool closed = true;
};

/// REQUIRES: flags outlives options.
void add_surface_options(OptionSet& options, SurfaceFlags& flags);

/// ERRORS: mw::Error(kUsage) for values that contradict each other, or that cannot be written.
[[nodiscard]] SurfaceRequest parse_surface_request(const SurfaceFlags& flags);

/// What stands for the label, and for its name, in the path of --each.
inline constexpr std::string_view kLabelPlaceholder = "{label}";
inline constexpr std::string_view kNamePlaceholder = "{name}";

/// Returns whether the format is "precomputed" or "draco".
[[nodiscard]] bool is_folder_format(std::string_view format);

class SurfaceOutput {
 public:
  virtual ~SurfaceOutput() = default;
  /// Must be called before all surfaces with the unit of their coordinates.
  virtual void begin(const std::string& /*unit*/) {}
  /// Returns the sink of the next surface, which is that of `label`, written with these digits and
  /// called `title`.  ERRORS: those of SurfaceSink.
  [[nodiscard]] virtual std::unique_ptr<io::SurfaceSink> sink(RawLabel label,
                                                              const std::string& digits,
                                                              const std::string& title) = 0;
  /// Must be called after all surfaces.
  virtual void finish(const io::LabelNames& names) = 0;
};

/// Opens what can be opened before anything is known of the mesh.  The output of kFile gives one
/// sink only, and does not look at the label.
[[nodiscard]] std::unique_ptr<SurfaceOutput> open_surface_output(const SurfaceRequest& request);

}  // namespace mw::cli
