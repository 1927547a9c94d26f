// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The masks of a volume as groups of the tets of its mesh; a tet can be in several.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// The beginning of what masks are called in files, since a label can have the name of a mask.
inline constexpr std::string_view kMaskNames = "mask_";

/// All tets of a mask.
struct MaskGroup {
  std::string name;
  std::vector<Label> ranks;  ///< of its labels in the mesh's table, ascending; at least one
};

/// Returns the masks of header().record that have tets.
[[nodiscard]] std::vector<MaskGroup> mask_groups(const GroupedMesh& mesh);

/// Returns the names of arrays that tell which cells are in each of the header's masks.
/// ENSURES: they are no paths ("mask_a/b" is "mask_a_b"), differ, and none is one of the header's
/// values.
[[nodiscard]] std::vector<std::string> mask_arrays(const MeshHeader& header);

}  // namespace mw::io
