// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The XML of an XDMF file.
#pragma once

#include <string>
#include <vector>

#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// A group of cells: what it is called and its number.
struct XdmfTag {
  std::string name;
  std::int64_t number = 0;
};

/// What the file says of a mesh.
struct XdmfFacts {
  std::string numbers;  ///< name of the HDF5 file
  Element element = Element::kTet4;
  bool labels_signed = false;
  std::uint64_t nodes = 0;
  std::uint64_t tets = 0;
  std::uint64_t facets = 0;
  std::vector<XdmfTag> labels{};
  std::string record{};          ///< of the run, a line (mesh_record.h); empty: none
  std::vector<XdmfTag> sides{};  ///< groups of facets
};

/// All grids, or the first alone; see XdmfWriter.
[[nodiscard]] std::string xdmf_text(const XdmfFacts& facts);
[[nodiscard]] std::string xdmf_cells_text(const XdmfFacts& facts);

}  // namespace mw::io
