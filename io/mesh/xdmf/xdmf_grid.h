// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The grids of an XDMF file, and where their numbers are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/mesh/mesh_record.h"

namespace mw::io {

/// A data set of an HDF5 file.
struct XdmfItem {
  std::filesystem::path file;
  std::string path;
};

struct XdmfAttribute {
  std::string name;
  XdmfItem item;
};

/// One grid of tetrahedra.
struct XdmfGrid {
  XdmfItem topology;
  XdmfItem geometry;
  std::vector<XdmfAttribute> cells;  ///< attributes of cells
};

struct XdmfContent {
  std::vector<XdmfGrid> grids;  ///< those of tetrahedra, in the file's order
  MeshRecord record;
};

/// ERRORS: mw::Error(kInput) with file and place when it is no XDMF, when a grid has no nodes, or
/// when numbers are not in an HDF5 file beside it.
[[nodiscard]] XdmfContent read_xdmf_xml(const std::filesystem::path& path);

}  // namespace mw::io
