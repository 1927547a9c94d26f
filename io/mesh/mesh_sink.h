// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The one interface through which a finished mesh leaves the program, in bounded memory; and the
// sink that keeps nothing.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/file/errors.h"
#include "io/mesh/mesh_record.h"
#include "io/names/label_names.h"
#include "kernels/core/label.h"

namespace mw::io {

class ScratchMesh;

using TetRows = std::array<std::uint64_t, 4>;  ///< vertex rows; VTK-positive orientation

/// The wedges of a mesh, for sinks that write some.
struct WedgeHeader {
  std::uint64_t count = 0;
  /// By interface: the label under its wedges, and the one on top of them.
  std::vector<std::array<RawLabel, 2>> interfaces{};
};

/// Returns a place near another one where the interface of two labels is known to lie, or nothing.
using InterfacePlace =
    std::function<std::optional<Position>(const Position& near, RawLabel one, RawLabel other)>;

/// What is known before the first row.  The number of vertices is not, because a writer that merges
/// blocks learns it with the last of them.
struct MeshHeader {
  std::uint64_t tets = 0;
  bool labels_signed = false;         ///< labels are two's complement int64 and are written as such
  LabelNames names;                   ///< names of the labels that are written
  MeshRecord record;                  ///< record of the run that made it
  std::vector<std::string> values{};  ///< names of numbers that each tet has: letters, digits, '_'
  WedgeHeader wedges{};               ///< set by write_cells() alone (columns.h)
  /// Set by readers alone: the file's tets are curved, and come as kTetParts
  /// (kernels/core/tet_nodes.h), the eight of each tet one after the other.
  bool in_parts = false;
  /// Set by readers alone: tets of the file have nodes on straight edges, which are not passed on.
  bool ten_nodes = false;
  /// Set by runs of volumes that tell more than labels; may be called until finish() returns.
  InterfacePlace interface_place{};
};

/// Receives a mesh: begin(), then vertices and tets by turns, each in row order, then finish().  A
/// sink holds buffers whose size does not grow with the mesh.  Nothing appears under the final name
/// before finish() returns; a sink destroyed earlier leaves no file behind.
/// ERRORS: mw::Error(kResource) on a full disk, kUsage when the path cannot be written.
class MeshSink {
 public:
  virtual ~MeshSink() = default;
  virtual void begin(const MeshHeader& header) = 0;
  virtual void write_vertices(std::span<const Position> positions) = 0;
  /// REQUIRES: tets.size() == labels.size(); the vertices of these tets have been written.
  virtual void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) = 0;
  /// Takes the numbers of the tets that write_tets() was given last: a row for each tet, a column
  /// for each of header.values, NaN where unknown.  A sink whose format has no place for them
  /// ignores them (require_place_for_values() of open_mesh.h).
  /// REQUIRES: it follows each write_tets() if there are such names.
  virtual void write_values(std::span<const double> /*rows*/) {}
  virtual void finish() = 0;
  /// Takes a whole mesh, from begin() to finish(); between(), which may throw, is called often.
  /// A sink that needs the whole mesh looks at it where it lies.
  virtual void take(ScratchMesh& mesh, const std::function<void()>& between);
  /// Returns the most bytes that it holds between begin() and finish(); 0 if it is no file.
  [[nodiscard]] virtual std::uint64_t buffer_bytes() const { return 0; }
};

/// Makes the check that every sink makes before a file gets its name.
/// ERRORS: mw::Error(kInternal) when the tets written are not those the header promised.
inline void check_sink_counts(std::string_view file, const MeshHeader& header, std::uint64_t tets) {
  if (tets == header.tets) return;
  throw Error(ErrorKind::kInternal,
              text(file, ": ", tets, " tets were written, ", header.tets, " were announced"));
}

/// Takes a mesh and writes nothing; what derives from it looks at a part of the mesh.
class NoSink : public MeshSink {
 public:
  void begin(const MeshHeader& /*header*/) override {}
  void write_vertices(std::span<const Position> /*positions*/) override {}
  void write_tets(std::span<const TetRows> /*tets*/,
                  std::span<const RawLabel> /*labels*/) override {}
  void finish() override {}
};

}  // namespace mw::io
