// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The one interface through which triangles leave the program, with the names of their labels.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_order.h"
#include "io/file/sink/atomic_file.h"
#include "io/labels/label_table.h"
#include "io/mesh/grouped/box_sides.h"
#include "io/names/label_names.h"
#include "io/volume/volume_space.h"

namespace mw::io {

class GroupedMesh;
struct SurfaceHeader;

/// Grey, which is shown where a label has no colour of its own.
inline constexpr Colour kPlainColour{160, 160, 160, 255};

/// What the ranks of labels stand for.
struct SurfaceLabels {
  LabelTable table;
  LabelNames names;
  std::vector<std::string> titles;  ///< by rank: never empty, no two the same

  [[nodiscard]] Colour colour(Label rank) const;
};

/// Returns all labels of a mesh; titles are those of GroupNames.
[[nodiscard]] std::shared_ptr<const SurfaceLabels> surface_labels(const GroupedMesh& mesh);

/// Returns the labels on both sides of a surface's triangles, ascending.
[[nodiscard]] std::vector<Label> ranks_of(const SurfaceHeader& header);

/// Returns the names and colours of these labels, as far as they are known.
[[nodiscard]] LabelNames names_of(const SurfaceHeader& header);

/// Whether the colour of one of these labels is known.
[[nodiscard]] bool has_colours(const SurfaceHeader& header);

using Triangle = std::array<std::uint64_t, 3>;  ///< vertices of a surface, from 0

/// Triangles one after the other that have the same side and labels.
struct SurfaceRun {
  Side side = Side::kInterface;
  Label inside = 0;           ///< normals point out of it
  Label outside = kExterior;  ///< what they point into, where side is kInterface
  std::uint64_t triangles = 0;
};

/// Runs that share vertices; no other shell has these vertices.
struct SurfaceShell {
  std::optional<Label> label;  ///< the label whose surface it is; empty for interfaces
  std::vector<SurfaceRun> runs;
  std::uint64_t vertices = 0;
};

/// What is known before the first vertex.
struct SurfaceHeader {
  std::shared_ptr<const SurfaceLabels> labels;
  std::vector<SurfaceShell> shells;
  WorldFrame frame = WorldFrame::kOwn;  ///< of coordinates
  Position shift{};                     ///< was taken off all coordinates
  double largest = 0;                   ///< coordinate of a vertex, without its sign and the shift
  double shortest_edge = 0;             ///< of the mesh

  [[nodiscard]] std::uint64_t vertices() const;
  [[nodiscard]] std::uint64_t triangles() const;
};

/// Receives a surface: first begin(), then all vertices, then all triangles, each in the order of
/// shells and runs, and last finish().  A sink holds buffers whose size does not grow with the
/// surface, unless it says otherwise.  Nothing appears under the final name before finish()
/// returns; a sink that is destroyed earlier leaves no file behind.
/// ERRORS: mw::Error(kResource) on a full disk, kUsage when the path cannot be written or the
/// surface has more vertices than the format has numbers for.
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

  /// Steps to the next triangle.  Returns true if another run begins with it.
  /// REQUIRES: there is a next triangle.
  bool next();
  /// Return the shell and the run of the triangle that next() came to.
  [[nodiscard]] const SurfaceShell& shell() const { return header_->shells[shell_]; }
  [[nodiscard]] const SurfaceRun& run() const { return shell().runs[run_]; }

 private:
  const SurfaceHeader* header_;
  std::size_t shell_ = 0;
  std::size_t run_ = 0;
  std::uint64_t seen_ = 0;  ///< triangles of the run
  bool begun_ = false;
};

/// Returns "SPACE=RAS" or "SPACE=LPS", which 3D Slicer looks for in comments of files; empty where
/// the frame is not known.
[[nodiscard]] std::string space_comment(const SurfaceHeader& header);

/// Returns "SHIFT=X,Y,Z", which is to be added to all coordinates; empty without a shift.
[[nodiscard]] std::string shift_comment(const SurfaceHeader& header);

/// Checks the rounding of coordinates that are written times a scale as 32-bit floats.
/// ERRORS: those of check_rounding().
void check_floats(std::string_view file, const SurfaceHeader& header, double scale,
                  const std::string& way_out);

/// ERRORS: mw::Error(kUsage) when there are more than `max` of `what`, which is all that a format
/// with numbers of 32 bits can hold.
void check_max(std::string_view file, std::string_view what, std::uint64_t count,
               std::uint64_t max);

}  // namespace mw::io
