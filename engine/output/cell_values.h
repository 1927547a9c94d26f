// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers that tets get on their way out, from beside the mesh.
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
  /// Returns a row for each tet, a column for each name; NaN: unknown.  tets: rows of `positions`.
  /// ENSURES: what a tet gets depends on its corners alone.
  /// hold: is told what it takes beside buffer_bytes().
  [[nodiscard]] virtual std::vector<double> of(std::span<const io::Position> positions,
                                               std::span<const io::TetRows> tets,
                                               const HoldMemory& hold) = 0;
  /// The most that it, and a sink for its columns, hold from the first tet to the last.
  [[nodiscard]] virtual std::uint64_t buffer_bytes() const = 0;
};

}  // namespace mw::engine
