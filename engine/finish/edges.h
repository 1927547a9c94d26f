// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How long the edges of a finished mesh are, beside the sizes that were asked of labels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/finish/tet_ranges.h"
#include "io/labels/label_table.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::engine {

/// Counts edges of tets by length, as a share of the size that is asked for their label.  An edge
/// counts for each tet that has it.
struct EdgeRatios {
  static constexpr std::array<double, 7> kBounds{0.2, 0.4, 0.6, 0.8, 1.0, 1.25, 1.5};
  std::vector<std::uint64_t> counts = std::vector<std::uint64_t>(kBounds.size() + 1);
  /// Those between two vertices at each of which labels meet.
  std::vector<std::uint64_t> at_interfaces = std::vector<std::uint64_t>(kBounds.size() + 1);

  /// A ratio that equals a bound counts below that bound.
  void add(double ratio, bool is_at_interface);
  void add(const EdgeRatios& other);
};

struct EdgesTask {
  const io::LabelTable& table;  ///< labels of the volume; outlives the task
  std::vector<double> sizes{};  ///< by dense label, 0 where none was asked for
};

struct EdgeFigures {
  std::vector<double> longest;  ///< by dense label, in physical units; 0 where there is no tet
  EdgeRatios ratios;
};

/// Measures the edges of all tets.
/// Memory: bytes_of_edges(), then the work on ranges; and 8 bytes a label.
/// Disk: 9 bytes a vertex.  ERRORS: those of ScratchMesh.
[[nodiscard]] EdgeFigures measure_edges(io::ScratchMesh& mesh, const EdgesTask& task,
                                        const TetWork& work = {});

/// Returns the most bytes that measure_edges() holds beside the mesh, except for those of labels.
[[nodiscard]] std::uint64_t bytes_of_edges();

}  // namespace mw::engine
