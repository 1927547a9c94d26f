// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the labels of a surface are called, and their colours.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/labels/label_table.h"
#include "io/names/label_names.h"

namespace mw::io {

class GroupedMesh;
struct SurfaceHeader;

/// Shown where a label has no colour of its own: grey.
inline constexpr Colour kPlainColour{160, 160, 160, 255};

/// What the ranks of labels stand for.
struct SurfaceLabels {
  LabelTable table;
  LabelNames names;
  std::vector<std::string> titles;  ///< by rank: never empty, no two the same

  [[nodiscard]] Colour colour(Label rank) const;
};

/// All labels of a mesh; titles are those of GroupNames.
[[nodiscard]] std::shared_ptr<const SurfaceLabels> surface_labels(const GroupedMesh& mesh);

/// The labels that a surface's triangles are between, ascending.
[[nodiscard]] std::vector<Label> ranks_of(const SurfaceHeader& header);

/// What is known of these.
[[nodiscard]] LabelNames names_of(const SurfaceHeader& header);

/// Whether the colour of one of them is known.
[[nodiscard]] bool has_colours(const SurfaceHeader& header);

}  // namespace mw::io
