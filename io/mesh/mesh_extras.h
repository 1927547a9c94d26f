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

/// A job that a solver runs as it is, with placeholders for materials.
enum class Deck : std::uint8_t {
  kNone,
  kStatic,      ///< one end of the mesh is held, the other pulled (grouped/facet_nodes.h)
  kPeriodic,    ///< six unit strains of a cell that repeats itself (abaqus/periodic_job.h)
  kConduction,  ///< three unit gradients of temperature of such a cell
};

struct MeshExtras {
  Encoding encoding = Encoding::kUsual;
  std::optional<MaterialRule> materials{};
  Deck deck = Deck::kNone;
  /// The mesh is known to have wedges between the sides of interfaces (MeshRecord::cohesive) before
  /// it comes, so that MeshSink::buffer_bytes() counts what they take.
  bool wedges = false;
  /// The file for the pairs of nodes of a cell that repeats itself (grouped/periodic_pairs.h);
  /// where it is empty, they are not written.
  std::filesystem::path pairs{};
};

}  // namespace mw::io
