// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where surfaces go: one file, one a label, or a folder of precomputed meshes.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "engine/cli/surface/surface_request.h"

namespace mw::cli {

/// What stands for the label in the path of --each.
inline constexpr const char* kLabelPlaceholder = "{label}";

/// Returns whether the format is "precomputed" or "draco".
[[nodiscard]] bool is_folder_format(std::string_view format);

class SurfaceOutput {
 public:
  virtual ~SurfaceOutput() = default;
  /// Must be called before all surfaces with the unit of their coordinates.
  virtual void begin(const std::string& /*unit*/) {}
  /// Returns the sink of the next surface, which is that of `label`, written with these digits.
  /// ERRORS: those of SurfaceSink.
  [[nodiscard]] virtual std::unique_ptr<io::SurfaceSink> sink(RawLabel label,
                                                              const std::string& digits) = 0;
  /// Must be called after all surfaces.
  virtual void finish(const io::LabelNames& names) = 0;
};

/// Opens what can be opened before anything is known of the mesh.  The output of kFile gives one
/// sink only, and does not look at the label.
[[nodiscard]] std::unique_ptr<SurfaceOutput> open_surface_output(const SurfaceRequest& request);

}  // namespace mw::cli
