// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Values that tets get while the mesh is written, from a source beside the mesh.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/output/remembered.h"
#include "io/mesh/mesh_sink.h"

namespace mw::engine {

class CellValues {
 public:
  virtual ~CellValues() = default;
  [[nodiscard]] virtual const std::vector<std::string>& names() const = 0;
  /// Returns a row for each tet and a column for each name; NaN stands for unknown.  tets are rows
  /// of `positions`.  hold is told what the call takes beside buffer_bytes().
  /// ENSURES: the values of a tet depend on its corners alone.
  [[nodiscard]] virtual std::vector<double> of(std::span<const io::Position> positions,
                                               std::span<const io::TetRows> tets,
                                               const HoldMemory& hold) = 0;
  /// Returns the most that it, and a sink for its columns, hold from the first tet to the last.
  [[nodiscard]] virtual std::uint64_t buffer_bytes() const = 0;
};

}  // namespace mw::engine
