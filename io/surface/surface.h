// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facets of a mesh as a surface with vertices of its own.
#pragma once

#include "io/surface/shell_plan.h"

namespace mw::io {

/// Vertices and triangles of shells, in temporary files.
class Surface {
 public:
  /// Vertices of a shell ascend by their row in the mesh, triangles are as planned.
  /// With manifold, the vertices of each shell are those of each_sheet_corner().
  /// REQUIRES: with manifold, all parts of a shell have the same label inside.
  /// Memory: 32 MiB, and with manifold what each_sheet_corner() takes.
  /// Cost: two sorts of three numbers a corner.
  Surface(const SurfaceSource& source, std::shared_ptr<const SurfaceLabels> labels,
          const std::vector<ShellPlan>& plans, bool manifold);

  [[nodiscard]] const SurfaceHeader& header() const { return header_; }
  /// Writes all of the surface, from begin() to finish().
  void write(SurfaceSink& sink);

 private:
  void add_shell(const SurfaceSource& source, const ShellPlan& plan, bool manifold);

  SurfaceHeader header_;
  ScratchFile vertices_;
  ScratchFile triangles_;
};

}  // namespace mw::io
