// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a file can have beside the mesh, if its format has room for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "io/mesh/grouped/material_sets.h"

namespace mw::io {

/// How numbers are written in a format that has both encodings.
enum class Encoding : std::uint8_t {
  kUsual,  ///< binary
  kText,
};

struct MeshExtras {
  Encoding encoding = Encoding::kUsual;
  std::optional<MaterialRule> materials{};
  /// A job that the solver runs as it is: placeholders for materials, and one static step that
  /// holds one end of the mesh and pulls the other (grouped/deck_ends.h).
  bool deck = false;
  /// The mesh is known to have wedges between the sides of interfaces (MeshRecord::cohesive) before
  /// it comes, so that MeshSink::buffer_bytes() counts what they take.
  bool wedges = false;
  /// The file for the pairs of nodes of a cell that repeats itself (grouped/periodic_pairs.h);
  /// where it is empty, they are not written.
  std::filesystem::path pairs{};
};

}  // namespace mw::io
