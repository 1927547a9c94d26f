// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh file that several processes write together.
#pragma once

#include <string>

#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// The next rows to be written.
struct RowPlace {
  std::uint64_t vertex = 0;
  std::uint64_t tet = 0;
};

/// One process's part in a mesh file that several write, each of them rows of its own.  One process
/// is the maker, which calls create() before any work, lay_out() when all is counted, and finish()
/// when all others have synced; the others call join() instead.  Each process calls begin() once
/// the file is laid out, writes, and calls sync().
/// ENSURES: equal meshes are equal bytes, those of the format's sink, for any division of the rows.
///          Nothing has the final name before finish() returns; the maker's destructor removes what
///          was not finished.
/// ERRORS (all members): mw::Error(kResource) on a full disk, kUsage when the path cannot be
/// written.  Thread safety: none.
class SharedMesh {
 public:
  virtual ~SharedMesh() = default;

  /// Makes the file, still without its name.
  virtual void create() = 0;
  /// Returns what the others need to find the file.  REQUIRES: create().
  [[nodiscard]] virtual std::string place() const = 0;
  /// Makes sure that the file of that place() is within reach of this process.
  virtual void join(const std::string& place) = 0;

  /// Gives each row its place.  REQUIRES: the mesh has no values and no wedges.
  virtual void lay_out(const MeshHeader& header, std::uint64_t vertices) = 0;
  /// REQUIRES: the file is laid out with this header.
  virtual void begin(const MeshHeader& header) = 0;
  /// Makes the next rows go to this place, one behind the other.  REQUIRES: one of the processes
  /// begins at the first row, even of an empty mesh, and rows that are written do not overlap.
  virtual void go_to(const RowPlace& rows) = 0;
  virtual void write_vertices(std::span<const Position> positions) = 0;
  /// REQUIRES: tets.size() == labels.size().
  virtual void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) = 0;
  /// ENSURES: what this process wrote is on the disk.  REQUIRES: it writes nothing afterwards.
  virtual void sync() = 0;
  virtual void finish() = 0;

  /// Returns the most bytes that it holds in memory.
  [[nodiscard]] virtual std::uint64_t buffer_bytes() const = 0;
};

}  // namespace mw::io
