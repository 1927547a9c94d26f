// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an image of VTK's XML (.vti) as a volume.
// Format: https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html#imagedata
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "io/file/source/byte_source.h"
#include "io/volume/checks.h"
#include "io/volume/open_options.h"
#include "io/vtk_xml/vtk_document.h"

namespace mw::io {

/// Where the points of an image lie.
struct VtiGrid {
  std::array<std::int64_t, 3> points{};  ///< how many along each axis, not checked
  FileSpace space;                       ///< the steps between points, and where the first is
};

/// One number for each point or each cell.
struct VtiArray {
  pugi::xml_node node;
  std::string path;  ///< as "CellData/label"
  VoxelType type = VoxelType::kU8;
  bool is_cells = false;
};

[[nodiscard]] bool has_vti_magic(std::span<const std::byte> head);

/// ERRORS (also below): mw::Error(kInput) naming file and field.
[[nodiscard]] VtiGrid parse_vti_grid(const VtkDocument& document);

/// Returns the array called `dataset`, a name with or without "PointData/" or "CellData/" in front;
/// for an empty text the only one of integers, or of floats where there are none.  Arrays of
/// several components, and those that VTK uses itself ("vtkGhostType"), do not count.
/// ERRORS: also mw::Error(kUsage) where there is no such data set.
[[nodiscard]] VtiArray choose_vti_array(const VtkDocument& document, const std::string& dataset);

/// Opens the array that is meant.  Each point is the centre of a voxel; each cell is a voxel, and a
/// plane of cells one voxel thick.  Raw data that are not packed are read by region, all others are
/// unpacked first, into an unlinked temporary file.
[[nodiscard]] std::unique_ptr<LabelVolume> open_vti(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
