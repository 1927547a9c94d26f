// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The one interface through which triangles leave the program.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "io/mesh/grouped/box_sides.h"
#include "io/surface/surface_labels.h"

namespace mw::io {

using Triangle = std::array<std::uint64_t, 3>;  ///< vertices of a surface, from 0

/// Triangles one after the other that bound the same.
struct SurfaceRun {
  Side side = Side::kInterface;
  Label inside = 0;           ///< normals point out of it
  Label outside = kExterior;  ///< where side is kInterface: what they point into
  std::uint64_t triangles = 0;
};

/// Runs that share vertices; no other shell has these vertices.
struct SurfaceShell {
  std::optional<Label> label;  ///< it is the surface of this one; empty: interfaces of two
  std::vector<SurfaceRun> runs;
  std::uint64_t vertices = 0;
};

/// What is known before the first vertex.
struct SurfaceHeader {
  std::shared_ptr<const SurfaceLabels> labels;
  std::vector<SurfaceShell> shells;

  [[nodiscard]] std::uint64_t vertices() const;
  [[nodiscard]] std::uint64_t triangles() const;
};

/// Receives a surface: begin, then all vertices, then all triangles, each in the order of shells
/// and runs, finish.  A sink holds buffers whose size does not grow with the surface.  Nothing
/// appears under the final name before finish() returns; a sink destroyed earlier leaves no file
/// behind. ERRORS: mw::Error(kResource) on a full disk, kUsage when the path cannot be written or
/// the format has no numbers for so many vertices.
class SurfaceSink {
 public:
  virtual ~SurfaceSink() = default;
  virtual void begin(const SurfaceHeader& header) = 0;
  virtual void write_vertices(std::span<const Position> positions) = 0;
  virtual void write_triangles(std::span<const Triangle> triangles) = 0;
  virtual void finish() = 0;
};

/// Goes along the triangles of a header, from run to run.
class RunCursor {
 public:
  /// REQUIRES: header outlives it.
  explicit RunCursor(const SurfaceHeader& header) : header_(&header) {}

  /// Steps to the next triangle.  ENSURES: returns whether another run begins with it.
  /// REQUIRES: there is one.
  bool next();
  /// Of the triangle that next() came to.
  [[nodiscard]] const SurfaceShell& shell() const { return header_->shells[shell_]; }
  [[nodiscard]] const SurfaceRun& run() const { return shell().runs[run_]; }

 private:
  const SurfaceHeader* header_;
  std::size_t shell_ = 0;
  std::size_t run_ = 0;
  std::uint64_t seen_ = 0;  ///< triangles of the run
  bool begun_ = false;
};

}  // namespace mw::io
